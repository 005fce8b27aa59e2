# Pelagic's gust factor of the roughness (gust_at() of gl/shaders/waves.glsl), from the noise of
# gl/water/detail_image.cpp, so that the reference has the same roughness at every place.
import numpy as np

side = 256
periods_m = (460, 1510)


class MinstdRand:
    """std::minstd_rand"""

    def __init__(self, seed):
        self.state = seed

    def uniform(self):
        self.state = self.state * 48271 % 2147483647
        return self.state / 2 ** 31


def nearest(points, u, v):
    """Returns the distances to the nearest and to the second nearest point, in cells."""
    cells = points.shape[0]
    first, second = np.full(u.shape, 9.0), np.full(u.shape, 9.0)
    cx, cz = u.astype(int), v.astype(int)
    for dz in (-1, 0, 1):
        for dx in (-1, 0, 1):
            point = points[(cz + dz) % cells, (cx + dx) % cells]
            d = np.hypot(cx + dx + point[..., 0] - u, cz + dz + point[..., 1] - v)
            second = np.where(d < first, first, np.minimum(second, d))
            first = np.minimum(first, d)
    return first, second


def noise():
    """Returns the noise, an array of ranks in [0, 1]."""
    engine = MinstdRand(7)
    for _ in range(96 * 5):  # of the ripples
        engine.uniform()
    z, x = np.mgrid[0:side, 0:side].astype(float)
    lace, bend_x, bend_z = np.zeros((3, side, side))
    for layer, (cells, weight) in enumerate(((6, 0.34), (13, 0.30), (29, 0.22), (61, 0.14))):
        points = np.array([engine.uniform() for _ in range(2 * cells * cells)]).reshape(cells, cells, 2)
        u, v = ((at + bend + side) * cells / side % cells for at, bend in ((x, bend_x), (z, bend_z)))
        first, second = nearest(points, u, v)
        thread = 1 - np.minimum(1, (second - first) * 2.2)
        lace += weight * (0.65 * thread + 0.35 * (1 - np.minimum(1, first)))
        bend_x, bend_z = (first - 0.5) * 9 / (layer + 1), (second - 0.8) * 9 / (layer + 1)
    ranks = np.empty(side * side)
    ranks[np.argsort(lace, axis=None)] = np.linspace(0, 1, side * side)
    return ranks.reshape(side, side)


def sampled(texels, u, v):
    """Bilinear and periodic, as textures are; u and v in periods."""
    u, v = u * side - 0.5, v * side - 0.5
    i, j = np.floor(u).astype(int), np.floor(v).astype(int)
    u, v = u - i, v - j
    i, j, right, below = i % side, j % side, (i + 1) % side, (j + 1) % side
    return ((texels[j, i] * (1 - u) + texels[j, right] * u) * (1 - v) +
            (texels[below, i] * (1 - u) + texels[below, right] * u) * v)


def gusts(x, z):
    """Returns the factor at undisplaced positions in metres; the viewer is at the origin."""
    texels = noise()
    wide = sampled(texels, z / periods_m[1], x / periods_m[1])
    fine = sampled(texels, x / periods_m[0] + 0.9 * wide, z / periods_m[0] - 0.7 * wide)
    return np.clip(0.35 + 1.3 * (fine + wide - 0.5), 0.35, 1.7)
