"""A PNG file of grey bytes."""
import struct
import zlib

import numpy


def grey_png(greys):
    """greys: rows from the upper edge, bytes."""
    height, width = greys.shape

    def chunk(kind, content):
        return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))

    rows = numpy.zeros((height, width + 1), numpy.uint8)  # each begins with a byte that says: not filtered
    rows[:, 1:] = greys
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(rows.tobytes(), 6)) + chunk(b"IEND", b""))
