"""Writes point caches (PC2) for Blender's modifier Mesh Cache, frame by frame into NAME.part, which
is renamed to NAME when it is complete.

The file has a header of 32 bytes, little-endian: "POINTCACHE2", version 1, points, first frame,
frames per sample, samples. Then each sample has three 32-bit floats per point."""
import os
import struct

header = struct.Struct("<12siiffi")


class Pc2Writer:
    def __init__(self, path, points, first_frame, frames, done):
        """done: number of frames in NAME.part of an earlier run to keep."""
        self.path, self.part, self.frame_bytes = path, path + ".part", 12 * points
        if done:
            self.file = open(self.part, "r+b")
            self.file.truncate(header.size + done * self.frame_bytes)  # drops an incomplete frame
            self.file.seek(0, os.SEEK_END)
        else:
            self.file = open(self.part, "wb")
            self.file.write(header.pack(b"POINTCACHE2\0", 1, points, first_frame, 1, frames))

    def add(self, vertices):
        self.file.write(vertices.astype("<f4").tobytes())
        self.sync()

    def sync(self):
        self.file.flush()
        os.fsync(self.file.fileno())

    def finish(self):
        self.sync()
        self.file.close()
        os.replace(self.part, self.path)

    def stop(self):
        """Closes NAME.part, which a later run can continue."""
        self.file.close()


def complete_frames(path, points):
    """Returns the number of complete frames in NAME.part."""
    part = path + ".part"
    return max(0, (os.path.getsize(part) - header.size) // (12 * points)) if os.path.exists(part) else 0
