"""Numbers of the panel as people typed them."""
import math

import numpy


def typed(number):
    """Blender keeps 32-bit floats. What a person typed is the shortest decimal number that is the same float, so 9.3 is the 9.3 of the
    command line and not 9.30000019."""
    return float(str(numpy.float32(number)))


def typed_degrees(radians):
    """The same of an angle, which people type in degrees: those of a float are off by at most 3e-5 of them."""
    return round(math.degrees(radians), 4) + 0.0
