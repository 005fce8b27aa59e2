# Checks the DDS files of an export with independent readers: nvddsinfo the formats, ffmpeg the
# pixels of gradient and displacement, and Pillow, if it is installed, those of gradient.
#
# usage: dds_check.py FOLDER
import subprocess
import sys
from pathlib import Path

folder = Path(sys.argv[1])
HEADER = 148


def said(*command):
    return subprocess.run(command, check=True, capture_output=True).stdout


def decoded(file, layout):
    return said("ffmpeg", "-v", "error", "-i", str(file), "-f", "rawvideo", "-pix_fmt", layout, "-")


for name, dxgi in (("displacement", "R16G16B16A16_FLOAT"), ("gradient", "R8G8B8A8_UNORM"), ("compression", "R16_FLOAT")):
    info = said("nvddsinfo", str(folder / f"{name}_0000.dds")).decode()
    for text in (f"({dxgi})", "Mipmap count: 8", "Width: 128", "Height: 128", "(TEXTURE2D)"):
        assert text in info, f"nvddsinfo says nothing of {text} in {name}:\n{info}"

gradient = folder / "gradient_0000.dds"
level = gradient.read_bytes()[HEADER:HEADER + 4 * 128 * 128]
# ffmpeg 5.1 reads both as blue, green, red and alpha, and halves as 16-bit integers; with these
# formats it returns the bytes unchanged.
assert decoded(gradient, "bgra") == level, "ffmpeg sees another gradient"
displacement = folder / "displacement_0000.dds"
assert decoded(displacement, "bgra64le") == displacement.read_bytes()[HEADER:HEADER + 8 * 128 * 128], "ffmpeg sees another displacement"
try:
    from PIL import Image
    assert Image.open(gradient).tobytes() == level, "Pillow sees another gradient"
    print("nvddsinfo, ffmpeg and Pillow read the DDS files")
except ImportError:
    print("nvddsinfo and ffmpeg read the DDS files; Pillow is not installed")
