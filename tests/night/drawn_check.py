# Compares the height of a vertex that sample.mjs prints with `pelagic query`.
#
# usage: drawn_check.py PELAGIC FOLDER "X Y Z"
import csv
import math
import subprocess
import sys

pelagic, folder, text = sys.argv[1:]
x, y, z = map(float, text.split())
assert math.hypot(x - 10, z - 20) > 0.01, "the water does not move horizontally"
answer = subprocess.run([pelagic, "query", "--config", f"{folder}/sea.json", "--points", "-", "--interpolation", "linear"], input=f"{x!r},{z!r}\n",
                        check=True, capture_output=True, text=True).stdout
height = float(next(csv.DictReader(answer.splitlines()))["height"])
# Displacements up to 4 m are within 2^-10 m as halves. The bound allows for two cascades, and as
# much again for horizontal errors on slopes up to 1.
bound = 4 * 2**-10
print(f"drawn at {y:.4f} m, query says {height:.4f} m, bound {bound:.4f}")
assert abs(y - height) < bound
