"""Recovers decimal numbers as they were typed into the panel."""
import math

import numpy


def typed(number):
    """Returns the shortest decimal number that has the same 32-bit float, because Blender stores
    floats: 9.3, as on the command line, and not 9.30000019."""
    return float(str(numpy.float32(number)))


def typed_degrees(radians):
    """Returns an angle in degrees as it was typed. The error of a float is at most 3e-5 degrees."""
    return round(math.degrees(radians), 4) + 0.0
