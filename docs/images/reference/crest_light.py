# Sunlight that leaves the face of a steep wave, by tracing photons in double precision.
#
#   python3 docs/images/reference/crest_light.py PELAGIC docs/images/reference/crest_light.csv
#
# The waves are Gerstner's: x = s - A sin(k s), y = A cos(k s), uniform along z. Their surface is a
# smooth dielectric. The water has the absorption and scattering of `pelagic render --json`, and the
# phase function of Henyey and Greenstein with the same backscattered fraction. The sun's irradiance
# is 1, and the sky is black. The sun shines from -x, the eye is at +x, far away.
#
# Photons enter from the sun, are refracted, scatter any number of times, and are reflected within.
# Light that leaves a wave, or is reflected, may enter another. Each piece of a path adds to each
# ray of an eye that it crosses, seen along z. The table has the radiance within the face, divided
# by the square of the index: Fresnel's transmittance of the face and its reflection are left out,
# as in upwelling() of gl/shaders/water.glsl.
import argparse
import csv
import itertools
import json
import math
import subprocess
import tempfile
from dataclasses import dataclass

import numpy as np

water_index = 1.333
steepness = 0.44  # A k; Stokes' highest wave has 0.443
least_angle_deg = 15  # scattering by less counts as none; 8 degrees give the same within the noise
batches = 4
# Nearly parallel crossings are limited to this sine. They are 1 % of the light, and half of it is
# lost.
least_sine = 0.01
# Where the radiance is taken, by height over amplitude.
heights = (0.9, 0.7, 0.5, 0.3, 0.0, -0.3)


def henyey_greenstein_g(backwards):
    """Returns the asymmetry g for which the fraction `backwards` is scattered backwards."""
    low, high = 1e-6, 1 - 1e-9
    for _ in range(60):
        g = 0.5 * (low + high)
        part = (1 - g) / (2 * g) * ((1 + g) / math.sqrt(1 + g * g) - 1)
        low, high = (g, high) if part > backwards else (low, g)
    return low


class Phase:
    """Henyey and Greenstein's function. Light that is scattered by less than `least_deg` counts as
    unscattered, which keeps noise low."""

    def __init__(self, g, least_deg):
        self.g, self.most_cosine = g, math.cos(math.radians(least_deg))
        # Scattered fraction: the distribution function, from backwards.
        self.fraction = ((1 - g * g) / math.sqrt(1 + g * g - 2 * g * self.most_cosine) - (1 - g)) / (2 * g)

    def density(self, cosine):
        g = self.g
        p = (1 - g * g) / (4 * math.pi * np.power(1 + g * g - 2 * g * cosine, 1.5))
        return np.where(cosine < self.most_cosine, p, 0)

    def cosines(self, uniform):
        g = self.g
        term = (1 - g * g) / (1 - g + 2 * g * self.fraction * uniform)
        return np.clip((1 + g * g - term * term) / (2 * g), -1, 1)


def unit(azimuth_deg, elevation_deg):
    a, e = math.radians(azimuth_deg), math.radians(elevation_deg)
    return np.array([math.cos(e) * math.cos(a), math.sin(e), math.cos(e) * math.sin(a)])


def dot(a, b):
    return (a * b).sum(-1)


def reflectance(cosine, index):
    """Returns Fresnel's reflectance of unpolarised light; 1 beyond the critical angle."""
    inner2 = 1 - (1 - cosine * cosine) / (index * index)
    inner = np.sqrt(np.maximum(inner2, 0))
    s = (cosine - index * inner) / (cosine + index * inner)
    p = (index * cosine - inner) / (index * cosine + inner)
    return np.where(inner2 > 0, 0.5 * (s * s + p * p), 1.0)


def refracted(ray, normal, index):
    """Returns the direction of a ray beyond the surface; `normal` points against the ray."""
    cosine = -dot(ray, normal)[..., None]
    inner = np.sqrt(np.maximum(1 - (1 - cosine * cosine) / (index * index), 0))
    return ray / index + normal * (cosine / index - inner)


class Waves:
    def __init__(self, amplitude_m):
        self.amplitude = amplitude_m
        self.k = steepness / amplitude_m
        self.period = 2 * math.pi / self.k
        s = np.linspace(-0.5, 0.5, 8001) * self.period
        self.xs = s - amplitude_m * np.sin(self.k * s)
        self.ys = amplitude_m * np.cos(self.k * s)
        slopes = -steepness * np.sin(self.k * s) / (1 - steepness * np.cos(self.k * s))
        self.normals = np.stack([-slopes, np.ones_like(s)], -1) / np.hypot(slopes, 1)[:, None]

    def height(self, x):
        return np.interp((x + 0.5 * self.period) % self.period - 0.5 * self.period, self.xs, self.ys)

    def normal(self, x):
        at = (x + 0.5 * self.period) % self.period - 0.5 * self.period
        n = np.stack([np.interp(at, self.xs, self.normals[:, c]) for c in (0, 1)], -1)
        n /= np.linalg.norm(n, axis=-1, keepdims=True)
        return np.concatenate([n, np.zeros_like(n[..., :1])], -1)

    def face(self, height):
        """Returns the point of the face towards +x at a height over the amplitude."""
        s = math.acos(height) / self.k
        return np.array([s - self.amplitude * math.sin(self.k * s), height * self.amplitude])

    def distance(self, at, ray, reach):
        """Returns the distance to the surface along rays, or `reach` where they do not meet it.
        The search is between the levels of the troughs and the crests, in short steps."""
        side = np.sign(at[:, 1] - self.height(at[:, 0]))
        rise = np.where(np.abs(ray[:, 1]) < 1e-9, 1e-9, ray[:, 1])
        ends = (np.array([[-1.0], [1.0]]) * self.amplitude * 1.001 - at[:, 1]) / rise
        first = np.clip(ends.min(0), 0, reach)
        last = np.clip(ends.max(0), 0, reach)
        steps = 48
        low, high = first, np.full(len(at), np.inf)
        for i in range(1, steps + 1):
            t = first + (last - first) * i / steps
            crossed = np.isinf(high) & (side * (at[:, 1] + t * ray[:, 1] - self.height(at[:, 0] + t * ray[:, 0])) < 0)
            high = np.where(crossed, t, high)
            low = np.where(np.isinf(high), t, low)
        met = ~np.isinf(high)
        for _ in range(26):
            middle = 0.5 * (low + np.where(met, high, low))
            beyond = side * (at[:, 1] + middle * ray[:, 1] - self.height(at[:, 0] + middle * ray[:, 0])) < 0
            high = np.where(met & beyond, middle, high)
            low = np.where(met & ~beyond, middle, low)
        return np.where(met, low, reach), met


@dataclass
class EyeRay:
    """A piece of a ray from an eye, within the water."""
    face: int
    at: np.ndarray
    ray: np.ndarray
    length: float
    before: float  # path in the water before this piece
    weight: float


def eye_rays(waves, to_eye):
    rays = []
    for face, height in enumerate(heights):
        at = waves.face(height)
        normal = waves.normal(at[:1])[0]
        seen = float(to_eye @ normal)
        if seen <= 0.02 or waves.distance((at + [1e-6 * to_eye[0], 1e-4])[None], to_eye[None], np.array([3 * waves.period]))[1][0]:
            continue  # turned away, or behind another wave
        # In the water; Fresnel's transmittance of the face is left out, as in upwelling().
        ray, before, weight = refracted(-to_eye, normal, water_index), 0.0, 1 / water_index**2
        at = at + 1e-6 * ray[:2]
        for _ in range(4):
            reach = 60.0
            length, met = waves.distance(at[None] - [0, 1e-7], ray[None], np.array([reach]))
            rays.append(EyeRay(face, at, ray, float(length[0]), before, weight))
            if not met[0]:
                break
            at, before = at + length[0] * ray[:2], before + length[0]
            normal = -waves.normal(at[:1])[0]
            weight *= float(reflectance(-(ray @ normal), 1 / water_index))
            if weight < 1e-3:
                break
            ray = ray - 2 * (ray @ normal) * normal
            at = at + 1e-5 * ray[:2]
    return rays


def turned(ray, cosine, azimuth):
    """Returns rays that deviate from `ray` by an angle and an azimuth."""
    helper = np.where(np.abs(ray[:, 1:2]) < 0.9, [[0.0, 1.0, 0.0]], [[1.0, 0.0, 0.0]])
    u = np.cross(ray, helper)
    u /= np.linalg.norm(u, axis=-1, keepdims=True)
    v = np.cross(ray, u)
    sine = np.sqrt(np.maximum(1 - cosine * cosine, 0))
    return (cosine[:, None] * ray + (sine * np.cos(azimuth))[:, None] * u + (sine * np.sin(azimuth))[:, None] * v)


def entering(waves, at, ray, power, events):
    """Returns light in the water, of light that meets the surface from the air: refracted where it
    meets it, and refracted into another wave that the reflected light meets."""
    normal = waves.normal(at[:, 0])
    mirrored = reflectance(-dot(ray, normal), water_index)
    inner = refracted(ray, normal, water_index)
    first = at + 1e-6 * inner[:, :2], inner, power * (1 - mirrored), events
    away = ray - 2 * dot(ray, normal)[:, None] * normal
    second = into_other_wave(waves, at, away, power * mirrored, events)
    return tuple(np.concatenate(pair) for pair in zip(first, second))


def into_other_wave(waves, at, ray, power, events):
    """Returns light in the water, of light in the air that leaves the surface at `at`."""
    at = at + 1e-5 * ray[:, :2] + [0, 1e-7]
    length, met = waves.distance(at, ray, np.full(len(at), 2 * waves.period))
    at, ray, power, events = (at + length[:, None] * ray[:, :2])[met], ray[met], power[met], events[met]
    normal = waves.normal(at[:, 0])
    seen = -dot(ray, normal)
    at, ray, power, events, normal, seen = (v[seen > 1e-3] for v in (at, ray, power, events, normal, seen))
    inner = refracted(ray, normal, water_index)
    return at + 1e-6 * inner[:, :2], inner, power * (1 - reflectance(seen, water_index)), events


def radiance(waves, sun, views, optics, photons, seed=1, most_events=24):
    """Returns the radiance of each view's eye rays by view, face and number of scatterings (one,
    more), before Fresnel's transmittance of the face. optics: absorption, scattering and g."""
    absorption, all_scattering, phase = optics
    scattering = all_scattering * phase.fraction
    random = np.random.default_rng(seed)
    rays = [eye_rays(waves, view) for view in views]
    found = np.zeros((len(views), len(heights), 2))
    for view, pieces in enumerate(rays):
        found[view][[f for f in range(len(heights)) if f not in {p.face for p in pieces}]] = np.nan
    # Sunlight on one period, stratified.
    x = ((np.arange(photons) + random.random(photons)) / photons - 0.5) * waves.period
    at = np.stack([x, np.full(photons, waves.amplitude * 1.0001)], -1)
    ray = np.tile(-sun, (photons, 1))
    power = np.full(photons, sun[1] * waves.period / photons)
    reach = np.full(photons, 2.2 * waves.amplitude / sun[1])
    length, met = waves.distance(at, ray, reach)
    assert met.all()
    at, ray, power, events = entering(waves, at + length[:, None] * ray[:, :2], ray, power, np.zeros(photons, int))
    least_power = 1e-3 * sun[1] * waves.period / photons
    for _ in range(most_events):
        free = random.exponential(1 / scattering, len(at))
        length, met = waves.distance(at, ray, np.minimum(free, 60.0))
        for view, pieces in enumerate(rays):
            for piece in pieces:
                # All periods of the waves are alike: shift the photon to each that may be crossed.
                across = ray[:, 0] * piece.ray[1] - ray[:, 1] * piece.ray[0]
                span = piece.at[0] + np.array([0, piece.length * piece.ray[0]])
                first = math.floor((span.min() - 60) / waves.period)
                last = math.ceil((span.max() + 60) / waves.period)
                for period in range(max(first, -8), min(last, 8) + 1):
                    off = piece.at - (at + [period * waves.period, 0])
                    own = (off[:, 0] * piece.ray[1] - off[:, 1] * piece.ray[0]) / across
                    other = (off[:, 0] * ray[:, 1] - off[:, 1] * ray[:, 0]) / across
                    hit = (own > 0) & (own < length) & (other > 0) & (other < piece.length)
                    if not hit.any():
                        continue
                    light = (power[hit] * np.exp(-absorption * own[hit]) / np.maximum(np.abs(across[hit]), least_sine) *
                             all_scattering * phase.density(-dot(ray[hit], piece.ray)) *
                             np.exp(-(absorption + scattering) * (piece.before + other[hit])) * piece.weight)
                    single = events[hit] == 0
                    found[view, piece.face, 0] += light[single].sum()
                    found[view, piece.face, 1] += light[~single].sum()
        power = power * np.exp(-absorption * length)
        at = at + length[:, None] * ray[:, :2]
        inner = met
        normal = -waves.normal(at[:, 0])
        back = reflectance(-dot(ray, normal), 1 / water_index)
        mirrored = ray - 2 * dot(ray, normal)[:, None] * normal
        deflected = turned(ray, phase.cosines(random.random(len(at))), 2 * math.pi * random.random(len(at)))
        out = inner & (power * (1 - back) > 10 * least_power)
        again = into_other_wave(waves, at[out], refracted(ray[out], normal[out], 1 / water_index),
                                (power * (1 - back))[out], events[out])
        ray = np.where(inner[:, None], mirrored, deflected)
        power = np.where(inner, power * back, power)
        events = np.where(inner | (free > 60), events, events + 1)
        at = np.where(inner[:, None], at + 1e-5 * ray[:, :2] - [0, 1e-7], at)
        alive = (power > least_power) & (at[:, 1] < waves.height(at[:, 0])) & (at[:, 1] > -60)
        at, ray, power, events = (np.concatenate([own[alive], more])
                                  for own, more in zip((at, ray, power, events), again))
        if len(at) == 0:
            break
    return found


def optics_of(pelagic, water):
    with tempfile.TemporaryDirectory() as folder:
        text = subprocess.check_output(
            [pelagic, "render", "--out", f"{folder}/sea.png", "--size", "16x16", "--preset", "calm", "--quality", "low",
             "--water", water, "--json"], stderr=subprocess.DEVNULL)
    said = json.loads(text)["water"]
    for a, b, bb in zip(said["absorption_per_m"], said["scattering_per_m"], said["backscattering_per_m"]):
        yield a, b, Phase(henyey_greenstein_g(bb / b), least_angle_deg)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("pelagic")
    parser.add_argument("file")
    parser.add_argument("--photons", type=int, default=4000, help="in each of the batches")
    options = parser.parse_args()
    water = "II"
    channels = list(optics_of(options.pelagic, water))
    eyes = (3, 10, 25)
    with open(options.file, "w", newline="") as file:
        rows = csv.writer(file, lineterminator="\n")
        rows.writerow("water amplitude_m sun_deg eye_deg height_m thickness_m red green blue error_green".split())
        for amplitude, sun in itertools.product((0.5, 1.5, 4), (10, 20, 40)):
            waves = Waves(amplitude)
            views = [unit(0, eye) for eye in eyes]
            found = np.array([[radiance(waves, unit(180, sun), views, optics, options.photons, seed).sum(-1)
                               for seed in range(batches)] for optics in channels])
            mean, error = found.mean(1), found[1].std(0) / math.sqrt(batches)
            for (view, eye), (face, height) in itertools.product(enumerate(eyes), enumerate(heights)):
                if np.isnan(mean[0, view, face]):
                    continue
                thickness = 2 * waves.face(height)[0]
                rows.writerow([water, amplitude, sun, eye, f"{height * amplitude:.2f}", f"{thickness:.2f}",
                               *(f"{value:.6f}" for value in mean[:, view, face]), f"{error[view, face]:.6f}"])
            file.flush()


if __name__ == "__main__":
    main()
