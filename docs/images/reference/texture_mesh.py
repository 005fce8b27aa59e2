# The sea of `pelagic export` as a polar mesh around an eye, with cells of about half a pixel, and
# slopes of ripples below the exported wavelengths.
#
# Waves too short for a cell are removed in Fourier space, and their mean square slope becomes the
# vertex's roughness. Ripples are a Gaussian field. Each octave has the same mean
# square slope, as in the saturation range.
import json
import math
from pathlib import Path

import numpy as np

min_cells_per_wave = 2.5
texels_per_wave = 8  # linear interpolation then keeps 95 % of a wave's height
ripple_part = 0.75  # of the mean square slope below the cascades; the rest stays roughness
shortest_ripple_m = 0.022
ripple_spread_rad = 0.8  # deviation of directions from +x, the wind's
ripple_side_m, ripple_texels = 2.816, 1024


def wave_numbers(n, side_m):
    k = 2 * math.pi * np.fft.fftfreq(n, side_m / n)
    return k[None, :], k[:, None]  # along columns and rows


class Waves:
    """A periodic field of displacements, x, y and z, at octaves of shortest waves.
    \\param spectrum  the field's FFT over rows and columns, divided by the number of texels"""

    def __init__(self, spectrum, side_m, shortest_m, cosine=1.0, sine=0.0):
        self.side, self.cosine, self.sine = side_m, cosine, sine
        self.shortest, self.levels = shortest_m, []
        kx, kz = wave_numbers(spectrum.shape[0], side_m)
        k, shortest = np.hypot(kx, kz), shortest_m
        # The last level holds no wave.
        while shortest < 2 * side_m:
            n = 1 << max(4, math.ceil(math.log2(texels_per_wave * side_m / shortest)))
            kept = np.where((k <= 2 * math.pi / shortest * (1 + 1e-9))[..., None], spectrum, 0)
            self.levels.append(self.resampled(kept, n))
            shortest *= 2
        self.levels.append(np.zeros((4, 4, 3), np.float32))

    @staticmethod
    def resampled(spectrum, n):
        m, out = spectrum.shape[0], np.zeros((n, n, 3), complex)
        half = min(m, n) // 2
        ends = (slice(0, half), slice(-half, None))
        for rows in ends:
            for columns in ends:
                out[rows, columns] = spectrum[rows, columns]
        return (np.fft.ifft2(out, axes=(0, 1)).real * n * n).astype(np.float32)

    def at_level(self, level, x, z):
        texels = self.levels[level]
        n = texels.shape[0]
        u = (self.cosine * x + self.sine * z) * (n / self.side)
        v = (self.cosine * z - self.sine * x) * (n / self.side)
        i, j = np.floor(u).astype(np.int64), np.floor(v).astype(np.int64)
        u, v = (u - i)[..., None], (v - j)[..., None]
        i, j, right, below = i % n, j % n, (i + 1) % n, (j + 1) % n
        return ((texels[j, i] * (1 - u) + texels[j, right] * u) * (1 - v) +
                (texels[below, i] * (1 - u) + texels[below, right] * u) * v)

    def displacement(self, x, z, cell_m):
        """Returns the displacement of waves that cells resolve. Levels are blended, so that no ring
        shows where one ends."""
        level = min(max(math.log2(min_cells_per_wave * cell_m / self.shortest), 0), len(self.levels) - 1)
        first = min(int(level), len(self.levels) - 2)
        part = level - first
        finer = self.at_level(first, x, z) * (1 - part) if part < 1 else 0
        return finer + (self.at_level(first + 1, x, z) * part if part > 0 else 0)


def read_cascades(folder, load):
    """\\param load  file name to an array of rows, columns and RGBA"""
    cascades = []
    for layout in json.loads((Path(folder) / "sea.json").read_text())["layout"]["cascades"]:
        part, rotation = layout["in_file_names"], layout["rotation"]
        texels = load(Path(folder) / f"displacement_{part + '_' if part else ''}0000.exr")[..., :3]
        spectrum = np.fft.fft2(texels, axes=(0, 1)) / layout["resolution"] ** 2
        cascades.append(Waves(spectrum, layout["side_m"], layout["shortest_wave_m"], rotation["cosine"], rotation["sine"]))
    return cascades


def ripples(longest_m, mean_square, seed):
    """Returns the slopes of ripples along x and z: a periodic array of rows, columns and both."""
    n = ripple_texels
    kx, kz = wave_numbers(n, ripple_side_m)
    k = np.maximum(np.hypot(kx, kz), 1e-9)
    held = (k >= 2 * math.pi / longest_m) & (k <= 2 * math.pi / shortest_ripple_m)
    slopes = np.where(held, np.exp(-0.25 * (np.arctan2(kz, kx) / ripple_spread_rad) ** 2) / k, 0)
    spectrum = np.fft.fft2(np.random.default_rng(seed).standard_normal((n, n))) * slopes
    field = np.stack([np.fft.ifft2(1j * part / k * spectrum).real for part in (kx, kz)], -1)
    return field * math.sqrt(mean_square / np.mean(np.sum(field ** 2, -1)))


def displacement(waves, x, z, cell_m):
    return sum(w.displacement(x, z, cell_m) for w in waves)


class PolarSea:
    """A mesh as cycles_scene.add_sea() takes it: `places`, `roughness` and `quads`.

    \\param azimuth_rad  of the view, from +x to +z
    \\param all_slopes   mean square slope of all waves, both axes
    """
    cell_rad, ring = 0.0025, 0.003  # ring: relative difference of radii
    half_view_rad = math.radians(50)
    nearest_m, farthest_m = 0.3, 400

    def __init__(self, waves, azimuth_rad, all_slopes, gusts):
        middle = self.below_eye(waves)
        view = np.arange(-self.half_view_rad, self.half_view_rad, self.cell_rad)
        behind = np.linspace(self.half_view_rad, 2 * math.pi - self.half_view_rad, 60)[:-1]
        angles = azimuth_rad + np.concatenate((view, behind))
        # Near the eye, rings are a tenth of the shortest exported waves apart.
        equal = min(w.shortest for w in waves) / 10
        radii = np.concatenate((np.arange(self.nearest_m, equal / self.ring, equal), np.exp(
            np.arange(math.log(equal / self.ring), math.log(self.farthest_m), self.ring))))
        places, rest = np.zeros((2, len(radii), len(angles), 3), np.float32)
        for first in range(0, len(radii), 32):
            r = radii[first:first + 32, None]
            x, z = middle[0] + r * np.cos(angles), middle[1] + r * np.sin(angles)
            moved = displacement(waves, x, z, self.cell_m(r.mean()))
            rest[first:first + 32] = np.stack((x, np.zeros_like(x), z), -1)
            places[first:first + 32] = moved + rest[first:first + 32]
        self.places, self.rest = places.reshape(-1), rest.reshape(-1)
        self.gust = gusts(rest[..., 0], rest[..., 2]).astype(np.float32).reshape(-1)
        # Slopes of cells at random places, because a ring near the eye is shorter than most waves.
        some = np.exp(np.linspace(math.log(self.nearest_m), math.log(self.farthest_m), 48))
        self.shown = np.array([self.mean_square(waves, self.cell_m(r), azimuth_rad) for r in some])
        left = np.maximum(all_slopes - np.interp(np.log(radii), np.log(some), self.shown), 4e-4)
        self.roughness = np.repeat(left, len(angles)).astype(np.float32)
        index = np.arange(places.shape[0] * places.shape[1], dtype=np.int32).reshape(places.shape[:2])
        after = np.roll(index, -1, 1)
        # Counter-clockwise from above: x east, z south.
        self.quads = np.stack((index[:-1], after[:-1], after[1:], index[1:]), -1).reshape(-1)

    def cell_m(self, radius_m):
        return radius_m * max(self.cell_rad, self.ring)

    @staticmethod
    def below_eye(waves):
        """Returns the undisplaced position of the water at the origin."""
        at = np.zeros(2)
        for _ in range(50):
            moved = displacement(waves, at[0:1], at[1:2], 0.1)[0]
            at = 0.5 * at - 0.5 * moved[[0, 2]]
        return at

    def mean_square(self, waves, cell_m, azimuth_rad, samples=20000):
        draws = np.random.default_rng(1)
        x, z = draws.uniform(-5e3, 5e3, (2, samples))
        corners = []
        for along, across in ((0, 0), (0, 1), (1, 1), (1, 0)):
            dx = cell_m * (along * math.cos(azimuth_rad) - across * math.sin(azimuth_rad))
            dz = cell_m * (along * math.sin(azimuth_rad) + across * math.cos(azimuth_rad))
            moved = displacement(waves, x + dx, z + dz, cell_m)
            corners.append(moved + np.stack((np.full(samples, dx), np.zeros(samples), np.full(samples, dz)), -1))
        normal = np.cross(corners[2] - corners[0], corners[3] - corners[1])
        level = np.abs(normal[:, 1])
        return np.sum((normal[:, 0] ** 2 + normal[:, 2] ** 2) / np.maximum(level, 1e-12)) / np.sum(level)
