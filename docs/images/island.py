#!/usr/bin/env python3
"""Writes heights of an island with a lagoon side, or of a beach, 16-bit grey, for the images of
render.sh.

usage: island.py FILE.png [beach]
"""
import math
import random
import struct
import sys
import zlib

SIDE = 256
random.seed(3)
GRID = [[random.random() for _ in range(64)] for _ in range(64)]


def noise(x, y):
    """Returns value noise in [0, 1], smooth between a grid of random values."""
    i, j = int(x), int(y)
    fx, fy = x - i, y - j
    fx, fy = fx * fx * (3 - 2 * fx), fy * fy * (3 - 2 * fy)
    at = lambda p, q: GRID[q % 64][p % 64]
    upper = at(i, j) * (1 - fx) + at(i + 1, j) * fx
    lower = at(i, j + 1) * (1 - fx) + at(i + 1, j + 1) * fx
    return upper * (1 - fy) + lower * fy


def height(column, row):
    """Returns the height of an island: 0 in deep water, 1 on the highest dune; two thirds are the
    waterline at --floor-heights -20,10."""
    u, v = (column + 0.5) / SIDE * 2 - 1, (row + 0.5) / SIDE * 2 - 1
    x, y = column * 256 / SIDE, row * 256 / SIDE
    n = noise(x / 40, y / 40) * 0.5 + noise(x / 20 + 7, y / 20) * 0.25 + noise(x / 9, y / 9 + 5) * 0.12 + noise(x / 4, y / 4) * 0.05
    hill = max(0.0, min(1.0, (1 - math.hypot(u - 0.1, v) - (0.45 - n) * 0.9) / 0.95)) ** 0.9
    edge = max(0.0, min(1.0, (1 - max(abs(u), abs(v))) / 0.15))
    return hill * edge


def beach(column, row):
    """Returns the height of a beach that rises along the rows, with a bar in front of it."""
    x, y = column * 256 / SIDE, row * 256 / SIDE
    u = (column + 0.5) / SIDE + 0.05 * (noise(x / 50 + 3, y / 23) - 0.5) + 0.012 * (noise(x / 30, y / 7 + 9) - 0.5)
    metres = -14 + 18.7 * u if u < 0.8 else 0.96 + 22 * (u - 0.8) - 30 * (u - 0.8) ** 2
    metres += 0.7 * math.exp(-((u - 0.6) / 0.03) ** 2) + 0.5 * max(0.0, u - 0.84) * 8 * noise(x / 6, y / 6)
    return max(0.0, min(1.0, (metres + 20) / 30))


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


heights = beach if sys.argv[2:] == ["beach"] else height
rows = b"".join(b"\0" + b"".join(struct.pack(">H", int(65535 * heights(i, j))) for i in range(SIDE)) for j in range(SIDE))
with open(sys.argv[1], "wb") as file:
    file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", SIDE, SIDE, 16, 0, 0, 0, 0)) +
               chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))
