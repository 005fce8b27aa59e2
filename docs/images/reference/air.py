# Adds the air between the eye and the sea to the reference's image, because the path tracer renders
# none.
#
# A path adds its source function times 1 - T, where T is its transmittance: the sun's light,
# scattered once by air (Rayleigh) and haze (Cornette and Shanks 1992), and the sky's light, assumed
# uniform from above. Coefficients, asymmetry and scale heights are those of gl/sky/atmosphere.hpp.
import math

rayleigh_per_m = (5.8e-6, 13.5e-6, 33.1e-6)
haze_albedo, haze_asymmetry = 0.9, 0.76
rayleigh_height_m, haze_height_m = 8000, 1200


def rayleigh_phase(cosine):
    return 3 / (16 * math.pi) * (1 + cosine * cosine)


def haze_phase(cosine):
    g2 = haze_asymmetry ** 2
    return (3 / (8 * math.pi) * (1 - g2) * (1 + cosine * cosine) /
            ((2 + g2) * (1 + g2 - 2 * haze_asymmetry * cosine) ** 1.5))


def through_air(radiance, ray, height_m, light):
    """\\param light  "sky" of `pelagic render --json`"""
    if ray.y >= 0:
        return radiance
    to_sun = sum(a * b for a, b in zip(ray, light["sun_direction"]))
    seen = []
    for c in range(3):
        def optical_depth(per_m, scale_m):
            return per_m * scale_m * (1 - math.exp(-height_m / scale_m)) / -ray.y

        air = optical_depth(rayleigh_per_m[c], rayleigh_height_m)
        haze = optical_depth(light["air_extinction_per_m"][c] - rayleigh_per_m[c], haze_height_m)
        once = light["sun_irradiance"][c] * (air * rayleigh_phase(to_sun) + haze_albedo * haze * haze_phase(to_sun))
        again = light["sky_irradiance"][c] / (2 * math.pi) * (air + haze_albedo * haze)
        left = math.exp(-(air + haze))
        seen.append(radiance[c] * left + (once + again) / (air + haze) * (1 - left))
    return tuple(seen)
