"""Chapter 3: perspective projection."""

from math import atan, degrees

import numpy as np
from support.worked_numbers import Says

from simulations.models.projection.pinhole import (
    intrinsics,
    look_at,
)
from simulations.models.projection.vanishing import vanishing_point

CHAPTER = "03-perspective-projection"


def where_two_rails_meet() -> Says:
    left = np.cross((100, 480, 1), (250, 300, 1)) / 30
    right = np.cross((540, 480, 1), (390, 300, 1)) / 30
    for line in (left, right):
        column = r" \\ ".join(f"{entry:.0f}" for entry in line)
        yield rf"\sim \begin{{bmatrix}} {column} \end{{bmatrix}}"
    meet = np.cross(left, right)
    u, v = meet[:2] / meet[2]
    yield rf"\sim \begin{{bmatrix}} {u:.0f} \\ {v:.0f} \\ 1 \end{{bmatrix}}"
    yield f"The rails meet at $({u:.0f}, {v:.0f})$."
    yield f"Then the rails meet {240 - v:.0f} px above the principal point"
    yield rf"$\arctan(24/800) = {degrees(atan(24 / 800)):.1f}^\circ$"
    down = look_at([0, 0, 0], [0, -24 / 800, 1], [0, 1, 0])  # heights upwards, z along the track
    seen, valid = vanishing_point(down[:3, :3] @ (0, 0, 1), intrinsics(800, (320, 240)))
    assert valid
    yield f"the horizon is row {seen[1]:.0f}."
