# Images as lists of (r, g, b), row 0 at the top, and the regions that are compared, selected by a
# pixel's ray over a flat sea.
import math

from mathutils import Vector

names = ("near", "middle", "far", "horizon", "glitter")
min_pixels = 60


def rays_of(camera, target, fov_deg, width, height):
    """Returns unit vectors through the centres of pixels, y up."""
    forward = (Vector(target) - Vector(camera)).normalized()
    right = forward.cross(Vector((0, 1, 0)))
    # straight down: +x is at the top
    right = right.normalized() if right.length > 1e-6 else Vector((0, 0, 1))
    up = right.cross(forward)
    half = math.tan(math.radians(fov_deg) / 2)
    for j in range(height):
        for i in range(width):
            x, y = (2 * (i + 0.5) / width - 1) * half * width / height, (1 - 2 * (j + 0.5) / height) * half
            yield (forward + x * right + y * up).normalized()


def region_of(ray, sun):
    """Returns the region of a ray, by its angle below the horizon. Glitter: a facet that reflects
    the sun is tilted by less than 12 degrees, 1.8 deviations of the slopes. Its surroundings, up to
    17 degrees, belong to no region."""
    below = math.degrees(math.asin(-ray.y))
    if below < 0.25:
        return None
    tilt = math.degrees(math.acos(min(1, (sun - ray).normalized().y)))
    if tilt < 12:
        return "glitter"
    if tilt < 17:
        return None
    if below < 1.5:
        return "horizon"
    if below < 8:
        return "far"
    if below < 20:
        return "middle"
    return "near"


def means(image, regions):
    """Returns the mean colour of each region that is large enough."""
    sums = {}
    for pixel, region in zip(image, regions):
        if region:
            entry = sums.setdefault(region, [0, 0.0, 0.0, 0.0])
            entry[0] += 1
            for c in range(3):
                entry[c + 1] += pixel[c]
    return {name: tuple(v / sums[name][0] for v in sums[name][1:])
            for name in names if name in sums and sums[name][0] >= min_pixels}


def luminance(colour):
    return 0.2126 * colour[0] + 0.7152 * colour[1] + 0.0722 * colour[2]
