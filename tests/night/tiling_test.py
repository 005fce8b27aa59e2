"""Images of seas with foam, straight down from 2.5 km, do not repeat visibly.

    tiling_test.py PELAGIC FOLDER

The autocorrelation of luminance, without slow gradients, is at most 0.45 at one side of the
coarsest cascade, whose waves repeat there, and at most 0.25 at all other lags from 200 m to 1.9 km.
Pixels measure 4.5 m.
"""
import json
import math
import subprocess
import sys
from pathlib import Path

import numpy
import OpenImageIO

HEIGHT_M, PIXELS, FIELD_OF_VIEW_DEG = 2500, 640, 60
PIXEL_M = 2 * HEIGHT_M * math.tan(math.radians(FIELD_OF_VIEW_DEG / 2)) / PIXELS


def box_means(image, half):
    """Means of squares of 2 half + 1 pixels, with the edge's pixels repeated outside."""
    for axis in (0, 1):
        padded = numpy.pad(image, [(half + 1, half) if axis == a else (0, 0) for a in (0, 1)], "edge")
        sums = numpy.cumsum(padded, axis=axis)
        ahead, behind = (numpy.take(sums, range(start, start + PIXELS), axis=axis) for start in (2 * half + 1, 0))
        image = (ahead - behind) / (2 * half + 1)
    return image


def autocorrelation(image):
    """Correlations of the image with itself by lag, and lags in metres; only lags with at least
    15 % of the pixels."""
    half = int(120 / PIXEL_M)
    image = image - box_means(box_means(image, half), half)
    transform = lambda values: numpy.abs(numpy.fft.rfft2(values, (2 * PIXELS, 2 * PIXELS))) ** 2
    products, pairs = (numpy.fft.irfft2(transform(values)) for values in (image, numpy.ones_like(image)))
    along = numpy.fft.fftfreq(2 * PIXELS) * 2 * PIXELS * PIXEL_M
    enough = pairs > 0.15 * PIXELS ** 2
    return (products / numpy.maximum(pairs, 1) / image.var())[enough], numpy.hypot(along[:, None], along[None, :])[enough]


def main(pelagic, folder):
    folder.mkdir(parents=True, exist_ok=True)
    failed = False
    for preset in ("moderate", "rough", "storm"):
        file = folder / f"{preset}.exr"
        subprocess.run([pelagic, "render", folder / f"{preset}.png", "--hdr", file, "--preset", preset, "--size", f"{PIXELS}x{PIXELS}",
                        "--fov", str(FIELD_OF_VIEW_DEG), "--camera", f"0,{HEIGHT_M},0", "--target", "0,0,1", "--quiet"], check=True)
        image = numpy.asarray(OpenImageIO.ImageBuf(str(file)).get_pixels(OpenImageIO.FLOAT))[..., :3].mean(-1)
        side_m = json.loads(subprocess.run([pelagic, "info", preset, "--json"], check=True, stdout=subprocess.PIPE).stdout)["repeats_after_m"]
        values, lag_m = autocorrelation(image)
        near = abs(lag_m - side_m) < 0.05 * side_m
        at_a_side = values[near].max() if near.any() else math.nan
        elsewhere = values[(lag_m > 200) & (lag_m < 1900) & ~near].max()
        print(f"{preset}: {at_a_side:.3f} at {side_m:.0f} m, elsewhere at most {elsewhere:.3f}")
        failed |= at_a_side > 0.45 or elsewhere > 0.25
    return int(failed)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], Path(sys.argv[2])))
