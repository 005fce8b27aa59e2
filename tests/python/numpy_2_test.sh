#!/usr/bin/env bash
# The tests of the package with NumPy 2 of PyPI, in a virtual environment with the wheel that
# Python.PageLines made. Skipped (77) if PyPI cannot be reached.
#
# usage: numpy_2_test.sh SOURCE_FOLDER
set -euo pipefail
source=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
/usr/bin/python3 -m venv --system-site-packages "$work/venv"
"$work/venv/bin/pip" install -q --ignore-installed 'numpy>=2' >"$work/log" 2>&1 || { echo "skipped: $(tail -n 1 "$work/log")" && exit 77; }
"$work/venv/bin/pip" install -q --no-index --no-deps "$source"/build/python-wheel/*.whl
"$work/venv/bin/python" -c 'import numpy; assert numpy.__version__ >= "2", numpy.__version__; print(numpy.__version__)'
# Debian's matplotlib, which an example draws with, is for NumPy 1.
"$work/venv/bin/python" -B -m pytest -q -p no:cacheprovider --ignore "$source/tests/python/measured_spectrum_test.py" "$source/tests/python"
