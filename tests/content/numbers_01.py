"""Chapter 1: transformations of the plane."""

import numpy as np
from support.worked_numbers import Says

from simulations.models.geometry.transforms import (
    apply_homography,
    translation,
)

CHAPTER = "01-2d-transformations"


def shift_first_and_then_double() -> Says:
    S, T = np.diag([2, 2, 1]), translation(3, 0)
    first, other = (apply_homography(H, [1, 1])[0] for H in (S @ T, T @ S))
    yield "sends the point $(1, 1)$ to $({:g}, {:g})$?\n- [x] Only $ST$".format(*first)
    yield "The shift then leads to $({:g}, {:g})$".format(*other)


ROAD = np.array([[1, 0, 0], [0, 1, 0], [0.5, 0, 1]])


def where_the_line_at_infinity_goes() -> Says:
    horizon = np.linalg.inv(ROAD).T @ [0, 0, 1]
    yield "becomes $({:g}, {:g}, {:g})$: the upright line".format(*horizon)
    yield f"$x = {-horizon[2] / horizon[0]:g}$, on which the two parallels met"


WORKED = (
    where_the_line_at_infinity_goes,
    shift_first_and_then_double,
)
