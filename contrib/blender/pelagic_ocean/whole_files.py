"""Files that are there whole or not at all: written under another name, synced, renamed."""
import os


def write_whole(path, content):
    part = path + ".part"
    with open(part, "wb") as file:
        file.write(content)
        file.flush()
        os.fsync(file.fileno())
    os.replace(part, path)
