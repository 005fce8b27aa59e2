# A sea floor as a grey PNG file for --floor, and as the heights that `pelagic` reads from it.
import struct
import zlib

LOWEST_M, HIGHEST_M = -20.0, 10.0  # defaults of --floor-heights


def write_png(file, rows):
    """Writes rows of bytes."""

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", len(rows[0]), len(rows), 8, 0, 0, 0, 0)
    lines = b"".join(b"\0" + bytes(row) for row in rows)
    file.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(lines))
                     + chunk(b"IEND", b""))


def as_float(number):
    return struct.unpack("<f", struct.pack("<f", number))[0]


def heights_of(rows):
    """Returns the heights row by row, as little-endian floats."""
    parts = [as_float(byte * as_float(1 / 255)) for row in rows for byte in row]
    return struct.pack(f"<{len(parts)}f", *(LOWEST_M + part * (HIGHEST_M - LOWEST_M) for part in parts))


def properties_of(rows, width_m):
    """Returns the node's properties for an image of this width around the origin."""
    columns, count = len(rows[0]), len(rows)
    metres = width_m / columns
    return {"shore_columns": columns, "shore_rows": count, "shore_metres_per_sample": metres,
            "shore_corner_x_m": -0.5 * metres * (columns - 1), "shore_corner_z_m": -0.5 * metres * (count - 1)}
