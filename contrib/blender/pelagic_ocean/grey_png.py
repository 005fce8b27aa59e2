"""Encodes 8-bit grey images as PNG."""
import struct
import zlib

import numpy


def grey_png(greys):
    """Returns a PNG file. greys: uint8, the upper row first."""
    height, width = greys.shape

    def chunk(kind, content):
        return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))

    rows = numpy.zeros((height, width + 1), numpy.uint8)  # each begins with filter type 0, none
    rows[:, 1:] = greys
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(rows.tobytes(), 6)) + chunk(b"IEND", b""))
