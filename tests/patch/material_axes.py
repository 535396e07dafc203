"""material_axes.py -- the axes of the material of strain.opts and thermal.opts in those of the scene."""
import math

import numpy


def turn(axis, degrees):
    """The turn about one axis of coordinates that takes components of the turned axes to those of the fixed ones."""
    j, k = (axis + 1) % 3, (axis + 2) % 3
    matrix, angle = numpy.eye(3), math.radians(degrees)
    matrix[j, j] = matrix[k, k] = math.cos(angle)
    matrix[k, j] = math.sin(angle)
    matrix[j, k] = -matrix[k, j]
    return matrix


AXES = turn(2, 25) @ turn(0, -40) @ turn(2, 70)  # R = R_z(a) R_x(b) R_z(c), the angles of both scenes
