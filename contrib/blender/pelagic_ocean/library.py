"""Loads the Python package `pelagic` from the zip's folder python/."""
import os
import platform
import sys

problem = ""  # one line for the panel if the package cannot be loaded
pelagic = None

folder = os.path.join(os.path.dirname(os.path.abspath(__file__)), "python")
sys.path.insert(0, folder)
try:
    import pelagic
except ImportError as error:
    problem = (f"The add-on's library does not load in Python {sys.version_info.major}.{sys.version_info.minor} on "
               f"{platform.system()} {platform.machine()} ({error}): install the zip made for this system")
finally:
    sys.path.remove(folder)
