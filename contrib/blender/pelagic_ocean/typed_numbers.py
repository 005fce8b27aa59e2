"""Numbers of the panel as people typed them."""
import math

import numpy


def typed(number):
    """Returns the number that the user typed. Blender stores 32-bit floats; the typed number is the
    shortest decimal with the same float, so 9.3 is the 9.3 of the command line and not 9.30000019.
    """
    return float(str(numpy.float32(number)))


def typed_degrees(radians):
    """Returns an angle in the degrees that the user typed; those of a float have an error of at
    most 3e-5 degrees."""
    return round(math.degrees(radians), 4) + 0.0
