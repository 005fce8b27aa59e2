# Fresnel's mean over the facets that an eye sees, of a surface whose slopes have Gauss' distribution: by summing it up.
import math


def fresnel(cosine, index=1.333):
    """Unpolarised light, from air into water."""
    g = math.sqrt(index * index - 1 + cosine * cosine)
    return (0.5 * ((g - cosine) / (g + cosine)) ** 2 *
            (1 + ((cosine * (g + cosine) - 1) / (cosine * (g - cosine) + 1)) ** 2))


def mean_fresnel(cosine, mean_square_slope, steps=60):
    """A facet of slopes a, b counts with its area as the eye sees it, max(cosine - a sine, 0). \\param cosine  eye and the mean normal
    \\param mean_square_slope  of both axes together"""
    deviation, sine = math.sqrt(mean_square_slope / 2), math.sqrt(max(0, 1 - cosine * cosine))
    total = weights = 0.0
    for i in range(steps):
        a = (10 * (i + 0.5) / steps - 5) * deviation
        seen = cosine - a * sine
        if seen <= 0:
            continue
        for j in range(steps // 2):
            b = 5 * (j + 0.5) / (steps / 2) * deviation
            weight = seen * math.exp(-(a * a + b * b) / (2 * deviation * deviation))
            total += weight * fresnel(min(1, seen / math.sqrt(1 + a * a + b * b)))
            weights += weight
    return total / weights
