# The sea of `pelagic export` as one mesh around a viewer: square rings, each twice as coarse as the
# one inside it, with vertices at the summed displacements of the cascades. Waves too short for a
# ring are removed by box averages of texels, and their mean square slope is the ring's roughness.
import json
import math
from array import array
from pathlib import Path


class Cascade:
    """A cascade's displacements, level by level: box averages of 2^level texels a side. \\param
    pixels RGBA, row 0 first"""

    def __init__(self, layout, pixels):
        self.side = layout["side_m"]
        self.n = layout["resolution"]
        self.cosine, self.sine = layout["rotation"]["cosine"], layout["rotation"]["sine"]
        self.texel = self.side / self.n
        self.levels = [[(pixels[4 * i], pixels[4 * i + 1], pixels[4 * i + 2]) for i in range(self.n * self.n)]]
        n = self.n
        while n > 1:
            finer, n = self.levels[-1], n // 2
            self.levels.append([
                tuple(0.25 * (a + b + c + d) for a, b, c, d in zip(
                    finer[4 * n * j + 2 * i], finer[4 * n * j + 2 * i + 1],
                    finer[4 * n * j + 2 * n + 2 * i], finer[4 * n * j + 2 * n + 2 * i + 1]))
                for j in range(n) for i in range(n)])

    def level_for(self, spacing):
        """Returns the finest level whose texels are not finer than the vertex spacing, or None if
        the cascade has no such level."""
        level = max(0, math.ceil(math.log2(spacing / self.texel)))
        return level if level < len(self.levels) - 2 else None


def displacement(cascades, x, z):
    """Returns the sum of the cascades, bilinear on each cascade's grid. \\param cascades  (cascade,
    level) to include"""
    dx = dy = dz = 0.0
    for cascade, level in cascades:
        n = cascade.n >> level
        # A texel of level m is the mean of texels whose centre is (2^m - 1) / 2 texels further.
        scale = 1 / (cascade.texel * (1 << level))
        shift = 0.5 * ((1 << level) - 1) / (1 << level)
        u = (cascade.cosine * x + cascade.sine * z) * scale - shift
        v = (cascade.cosine * z - cascade.sine * x) * scale - shift
        iu, iv = math.floor(u), math.floor(v)
        fu, fv = u - iu, v - iv
        i0, i1, j0, j1 = iu % n, (iu + 1) % n, iv % n * n, (iv + 1) % n * n
        texels = cascade.levels[level]
        a, b, c, d = texels[j0 + i0], texels[j0 + i1], texels[j1 + i0], texels[j1 + i1]
        wa, wb, wc, wd = (1 - fu) * (1 - fv), fu * (1 - fv), (1 - fu) * fv, fu * fv
        dx += wa * a[0] + wb * b[0] + wc * c[0] + wd * d[0]
        dy += wa * a[1] + wb * b[1] + wc * c[1] + wd * d[1]
        dz += wa * a[2] + wb * b[2] + wc * c[2] + wd * d[2]
    return dx, dy, dz


class SeaMesh:
    """A mesh around the origin, y up: `places` (x, y, z of each vertex), `roughness` (mean square
    slope of removed waves, of each vertex), `quads`.

    \\param finest_m   spacing inside, a power of two, so that rings share vertices exactly
    \\param radius_m   minimum extent of the outermost ring
    \\param all_slopes mean square slope of all waves, both axes
    """
    cells = 256  # cells along a side of each ring
    depth_m = 300  # opaque at this depth; Cycles requires closed water

    def __init__(self, cascades, finest_m, radius_m, all_slopes):
        self.places, self.roughness, self.quads = array("f"), array("f"), array("i")
        self.rings = []
        spacing = finest_m
        while True:
            last = spacing * self.cells / 2 >= radius_m
            self.add_ring(cascades, spacing, self.rings != [], last, all_slopes)
            if last:
                break
            spacing *= 2
        self.add_walls(all_slopes)

    def add_ring(self, cascades, spacing, has_hole, is_last, all_slopes):
        n, half = self.cells, self.cells // 2

        def counting(s):
            return [(cascade, cascade.level_for(s)) for cascade in cascades if cascade.level_for(s) is not None]

        own, coarser = counting(spacing), counting(2 * spacing)

        def hidden(i, j):
            return has_hole and n // 4 < i < 3 * n // 4 and n // 4 < j < 3 * n // 4

        def place(i, j, which):
            x, z = (i - half) * spacing, (j - half) * spacing
            dx, dy, dz = displacement(which, x, z)
            return x + dx, dy, z + dz

        first = len(self.places) // 3
        number, rows = {}, {}
        for j in range(n + 1):
            for i in range(n + 1):
                if hidden(i, j):
                    continue
                on_edge = not is_last and (i in (0, n) or j in (0, n))
                if not on_edge:
                    p = place(i, j, own)
                elif i % 2 == 0 and j % 2 == 0:
                    p = place(i, j, coarser)
                else:  # at the middle of an edge of the next ring
                    across = (1, 0) if i % 2 else (0, 1)
                    a = place(i - across[0], j - across[1], coarser)
                    b = place(i + across[0], j + across[1], coarser)
                    p = tuple(0.5 * (s + t) for s, t in zip(a, b))
                number[i, j] = first + len(rows)
                rows[i, j] = p
                self.places.extend(p)
        squares = weights = 0.0
        for j in range(n):
            for i in range(n):
                if has_hole and n // 4 <= i < 3 * n // 4 and n // 4 <= j < 3 * n // 4:
                    continue
                # Counter-clockwise from above: x east, z south.
                self.quads.extend((number[i, j], number[i, j + 1], number[i + 1, j + 1], number[i + 1, j]))
                if (i + j) % 3:
                    continue
                a, b, c, d = rows[i, j], rows[i, j + 1], rows[i + 1, j + 1], rows[i + 1, j]
                s, t = [c[k] - a[k] for k in range(3)], [d[k] - b[k] for k in range(3)]
                x, y, z = s[1] * t[2] - s[2] * t[1], s[2] * t[0] - s[0] * t[2], s[0] * t[1] - s[1] * t[0]
                squares += (x * x + z * z) / max(abs(y), 1e-12)
                weights += abs(y)
        n0 = [(i, 0) for i in range(n)] + [(n, j) for j in range(n)]
        self.border = [number[p] for p in n0 + [(n - i, n - j) for i, j in n0]]
        shown = squares / weights
        left = max(all_slopes - shown, 4e-4)
        self.roughness.extend([left] * len(rows))
        self.rings.append({"spacing_m": spacing, "shown": shown, "left": left})


    def add_walls(self, all_slopes):
        """Down from the outermost border, and a floor."""
        first, count = len(self.places) // 3, len(self.border)
        for vertex in self.border:
            x, _, z = self.places[3 * vertex:3 * vertex + 3]
            self.places.extend((x, -self.depth_m, z))
        self.roughness.extend([all_slopes] * count)
        for k, vertex in enumerate(self.border):
            after = (k + 1) % count
            self.quads.extend((vertex, self.border[after], first + after, first + k))
        self.quads.extend(first + k * count // 4 for k in range(4))


def read_cascades(folder, load):
    """\\param load  file name to RGBA floats, row 0 first"""
    record = json.loads((Path(folder) / "sea.json").read_text())
    cascades = []
    for layout in record["layout"]["cascades"]:
        part = layout["in_file_names"]
        cascades.append(Cascade(layout, load(Path(folder) / f"displacement_{part + '_' if part else ''}0000.exr")))
    return cascades
