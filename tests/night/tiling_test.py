"""Images of seas, straight down, do not repeat visibly.

    tiling_test.py PELAGIC FOLDER

The measure is the autocorrelation of luminance without slow gradients.

Foam from 2.5 km: at most 0.45 at one side of the coarsest cascade, whose waves repeat there, and at
most 0.25 at all other lags from 200 m to 1.9 km. Pixels measure 4.5 m. The side of storm, 3.8 km, is
longer than the image, so the first bound is not tested there.

Waves from 900 m, for ten seeds: at most 0.2 at lags from 200 to 900 m. The sun is high, so slopes show
most, and there are no clouds, whose shadows are equal for all seeds. Pixels measure 3.6 m, which shows
the second cascade: without its displacement `moderate` has 0.23 to 0.30 at 1.4 of its sides.
Without periods, 0.13 is reached by chance, because few waves are in the least overlap of 15 %.
"""
import json
import math
import subprocess
import sys
from pathlib import Path

import numpy
import OpenImageIO

FIELD_OF_VIEW_DEG = 60
SEEDS = range(1, 11)


def box_means(image, half):
    """Means of squares of 2 half + 1 pixels, with the edge's pixels repeated outside."""
    pixels = len(image)
    for axis in (0, 1):
        padded = numpy.pad(image, [(half + 1, half) if axis == a else (0, 0) for a in (0, 1)], "edge")
        sums = numpy.cumsum(padded, axis=axis)
        ahead, behind = (numpy.take(sums, range(start, start + pixels), axis=axis) for start in (2 * half + 1, 0))
        image = (ahead - behind) / (2 * half + 1)
    return image


def autocorrelation(image, pixel_m):
    """Correlations of the image with itself by lag, and lags in metres; only lags with at least
    15 % of the pixels."""
    pixels, half = len(image), int(120 / pixel_m)
    image = image - box_means(box_means(image, half), half)
    transform = lambda values: numpy.abs(numpy.fft.rfft2(values, (2 * pixels, 2 * pixels))) ** 2
    products, pairs = (numpy.fft.irfft2(transform(values)) for values in (image, numpy.ones_like(image)))
    along = numpy.fft.fftfreq(2 * pixels) * 2 * pixels * pixel_m
    enough = pairs > 0.15 * pixels ** 2
    return (products / numpy.maximum(pairs, 1) / image.var())[enough], numpy.hypot(along[:, None], along[None, :])[enough]


def correlations_from(height_m, pixels, sea, pelagic, file):
    """autocorrelation() of an image of a sea from this height."""
    subprocess.run([pelagic, "render", file.with_suffix(".png"), "--hdr", file, *sea, "--size", f"{pixels}x{pixels}", "--fov",
                    str(FIELD_OF_VIEW_DEG), "--camera", f"0,{height_m},0", "--target", "0,0,1", "--quality", "low", "--quiet"], check=True)
    image = numpy.asarray(OpenImageIO.ImageBuf(str(file)).get_pixels(OpenImageIO.FLOAT))[..., :3].mean(-1)
    return autocorrelation(image, 2 * height_m * math.tan(math.radians(FIELD_OF_VIEW_DEG / 2)) / pixels)


def foam_repeats(preset, pelagic, folder):
    values, lag_m = correlations_from(2500, 640, ["--preset", preset], pelagic, folder / f"{preset}.exr")
    side_m = json.loads(subprocess.run([pelagic, "info", preset, "--json"], check=True, stdout=subprocess.PIPE).stdout)["repeats_after_m"]
    near = abs(lag_m - side_m) < 0.05 * side_m
    at_a_side = values[near].max() if near.any() else math.nan
    elsewhere = values[(lag_m > 200) & (lag_m < 1900) & ~near].max()
    print(f"{preset}: {at_a_side:.3f} at {side_m:.0f} m, elsewhere at most {elsewhere:.3f}")
    return at_a_side > 0.45 or elsewhere > 0.25


def waves_repeat(preset, seed, pelagic, folder):
    sea = ["--preset", preset, "--seed", str(seed), "--light", "noon", "--clouds", "0", "--exposure", "15", "--spray", "off"]
    values, lag_m = correlations_from(900, 288, sea, pelagic, folder / f"{preset}_{seed}.exr")
    most = values[(lag_m > 200) & (lag_m < 900)].max()
    print(f"{preset}, seed {seed}: at most {most:.3f} from 200 to 900 m", flush=True)
    return most > 0.2


def main(pelagic, folder):
    folder.mkdir(parents=True, exist_ok=True)
    failures = [foam_repeats(preset, pelagic, folder) for preset in ("moderate", "rough", "storm")]
    failures += [waves_repeat(preset, seed, pelagic, folder) for preset in ("moderate", "rough") for seed in SEEDS]
    return int(any(failures))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], Path(sys.argv[2])))
