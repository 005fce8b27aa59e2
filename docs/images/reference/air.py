# The air between the eye and the sea, put over the reference's picture: the path tracer draws none.
#
# What a path of transmittance T adds is the share (1 - T) / (1 - T_sky) of the sky's radiance in the direction mirrored upwards, T_sky
# being the whole air's transmittance there: the same source of light, seen through less of it.
import math

rayleigh_per_m = (5.8e-6, 13.5e-6, 33.1e-6)
rayleigh_height_m, haze_height_m = 8000, 1200


def air_mass(sine):
    """Kasten and Young 1989."""
    degrees = math.degrees(math.asin(sine))
    return 1 / (sine + 0.50572 * (degrees + 6.07995) ** -1.6364)


class Panorama:
    """`pelagic render --sky`, nearest texel. \\param rows  row 0 first, of (r, g, b)"""

    def __init__(self, pixels, width, height):
        self.pixels, self.width, self.height = pixels, width, height

    def radiance(self, d):
        i = int((math.atan2(d.z, d.x) / (2 * math.pi) + 0.5) * self.width) % self.width
        j = int((0.5 - math.asin(max(-1, min(1, d.y))) / math.pi) * self.height)
        return self.pixels[min(j, self.height - 1) * self.width + i]


def through_air(radiance, ray, height_m, extinction_per_m, sky):
    if ray.y >= 0:
        return radiance
    up = ray.copy()
    up.y = -up.y
    above, mass, way = sky.radiance(up), air_mass(up.y), height_m / up.y
    seen = []
    for c in range(3):
        vertical = rayleigh_per_m[c] * rayleigh_height_m + (extinction_per_m[c] - rayleigh_per_m[c]) * haze_height_m
        left = math.exp(-extinction_per_m[c] * way)
        seen.append(radiance[c] * left + above[c] * (1 - left) / (1 - math.exp(-vertical * mass)))
    return tuple(seen)
