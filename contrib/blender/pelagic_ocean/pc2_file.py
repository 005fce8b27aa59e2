"""A point cache for Blender's Mesh Cache modifier (PC2), written frame by frame into NAME.part, which becomes NAME when it is whole.

A header of 32 bytes (the word POINTCACHE2, version 1, points, first frame, frames a sample, samples; little-endian), then the
points of each sample as three 32-bit floats."""
import os
import struct

header = struct.Struct("<12siiffi")


class Pc2Writer:
    def __init__(self, path, points, first_frame, frames, done):
        """done: frames that an earlier run left in NAME.part and that are kept."""
        self.path, self.part, self.frame_bytes = path, path + ".part", 12 * points
        if done:
            self.file = open(self.part, "r+b")
            self.file.truncate(header.size + done * self.frame_bytes)  # a frame that was cut off begins again
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
        """What is written stays for a run that goes on."""
        self.file.close()


def whole_frames(path, points):
    """How many frames an earlier run left."""
    part = path + ".part"
    return max(0, (os.path.getsize(part) - header.size) // (12 * points)) if os.path.exists(part) else 0
