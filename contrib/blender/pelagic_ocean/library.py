"""The Python package `pelagic`, which the zip carries beside these files: as a part of this package, so that no path of Blender's
changes and another add-on may carry another one."""
import platform
import sys

problem = ""  # one line, for the panel, where the package can't be loaded
pelagic = None

try:
    from . import pelagic
except ImportError as error:
    problem = (f"The add-on's library does not load in Python {sys.version_info.major}.{sys.version_info.minor} on "
               f"{platform.system()} {platform.machine()}: {error}. Install the zip made for them")
