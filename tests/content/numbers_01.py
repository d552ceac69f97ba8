"""Chapter 1: transformations of the plane."""

import numpy as np
from support.worked_numbers import Says

from simulations.models.transforms import apply_homography, rigid, translation

CHAPTER = "01-2d-transformations"


def a_square_becomes_a_road() -> Says:
    H = np.array([[1, 0, 0], [0, 1, 0], [0.5, 0, 1]])
    corners = np.array([[0, 0], [1, 0], [1, 1], [0, 1], [0.5, 0.5], [0.5, 0]])
    (stays, right, top, also_stays, centre, middle), _ = apply_homography(H, corners)
    assert [*stays, *also_stays] == [0, 0, 0, 1]
    yield f"have $w = {0.5 * 1 + 1:g}$, so $(1, 0)$ goes to $({right[0]:.3f}, {right[1]:.0f})$"
    yield f"$(1, 1)$ goes to $({top[0]:.3f}, {top[1]:.3f})$"
    yield f"has $w = {0.5 * 0.5 + 1:g}$ and goes to $({centre[0]:g}, {centre[1]:g})$"
    yield f"$y = 1 - {(1 - top[1] / 2) / top[0] + 0.5:.1f}x$. At $x = {centre[0]:g}$"
    assert np.isclose(1 - 1.5 * centre[0], centre[1]), "the diagonals cross there"
    assert np.isclose(1 - 1.5 * right[0], right[1]), "the falling diagonal ends in the corner"
    yield f"also goes to $x = {middle[0]:g}$"
    yield f"the middle of the new side is ${right[0] / 2:.3f}$"
    fall = (1 - top[1]) / top[0]
    yield f"falls by {fall:g} for each unit to the right"
    yield f"meets the lower side at $({1 / fall:g}, 0)$"


def the_figure_s_scale_and_shift() -> Says:
    yield f"corner $P$ goes from $(40, 40)$ to $({40 + 30}, {40 + 30 // 2})$"
    yield f"$1.5^2 = {1.5**2:g}$"


def where_the_corner_runs_off() -> Says:
    per_amount = 40 / 10000 + 40 / 3000
    yield rf"$w = 1 - {per_amount:.5f}\,a$, which is zero at $a = {1 / per_amount:.1f}$"


def turn_and_shift() -> Says:
    turn, shift = rigid(np.pi / 2, 0, 0), translation(3, 0)
    first, _ = apply_homography(shift @ turn, [1, 0])
    yield "to $({:.0f}, {:.0f})$. Shift first".format(*first)
    second, _ = apply_homography(turn @ shift, [1, 0])
    yield "then to $({:.0f}, {:.0f})$.".format(*second)


WORKED = (
    a_square_becomes_a_road,
    the_figure_s_scale_and_shift,
    where_the_corner_runs_off,
    turn_and_shift,
)
