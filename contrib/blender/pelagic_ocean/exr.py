"""Encodes images of one channel of 32-bit floats as OpenEXR, uncompressed."""
import struct


def exr(values):
    """Returns an OpenEXR file. values: float32, the upper row first."""
    rows, columns = values.shape

    def attribute(name, kind, content):
        return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<I", len(content)) + content

    box = struct.pack("<4i", 0, 0, columns - 1, rows - 1)
    # 2: 32-bit floats; 1, 1: sampled at each pixel.
    channel = b"Y\0" + struct.pack("<iB3xii", 2, 0, 1, 1) + b"\0"
    header = b"".join([
        struct.pack("<II", 20000630, 2),  # magic number, version
        attribute("channels", "chlist", channel),
        attribute("compression", "compression", b"\0"),
        attribute("dataWindow", "box2i", box),
        attribute("displayWindow", "box2i", box),
        attribute("lineOrder", "lineOrder", b"\0"),
        attribute("pixelAspectRatio", "float", struct.pack("<f", 1)),
        attribute("screenWindowCenter", "v2f", struct.pack("<2f", 0, 0)),
        attribute("screenWindowWidth", "float", struct.pack("<f", 1)),
        b"\0"])
    line_bytes, first = 8 + 4 * columns, len(header) + 8 * rows
    offsets = struct.pack(f"<{rows}Q", *(first + row * line_bytes for row in range(rows)))
    pixels = values.astype("<f4")
    lines = [struct.pack("<2I", row, 4 * columns) + pixels[row].tobytes() for row in range(rows)]
    return header + offsets + b"".join(lines)
