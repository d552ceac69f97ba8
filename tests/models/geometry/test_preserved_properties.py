"""What each rung of the transformations keeps, measured."""

import math

import numpy as np
import pytest

from simulations.models.geometry import preserved_properties, transforms
from simulations.models.geometry.preserved_properties import measure_preservation

TILTED = transforms.projective([1, 0, 0, 0, 1, 0, 1, 0, 1])
"""w = 1 + x: the line x = −1 goes to infinity."""
SEGMENTS = np.array(
    [[(0, 0), (1, 0)], [(0, 1), (1, 1)], [(0, 0), (0, 1)], [(1, 0), (1, 1)], [(0, 0), (1, 1)]],
    dtype=float,
)
RUNGS = {
    "translation": (transforms.translation(3, 1), set()),
    "rigid": (transforms.rigid(0.4, 3, 1), {"turn_rad"}),
    "similarity": (transforms.similarity(1.5, 0.4, 3, 1), {"turn_rad", "length"}),
    "affine": (
        transforms.affine([[1.2, 0.3], [0.1, 0.8]], (3, 1)),
        {"turn_rad", "length", "angle_rad"},
    ),
    "mirror": (transforms.affine([[-1, 0], [0, 1]], (0, 0)), {"turn_rad"}),
    "projective": (TILTED, {"turn_rad", "length", "angle_rad", "parallel_rad"}),
}


@pytest.mark.parametrize("rung", RUNGS)
def test_every_rung_gives_up_one_more_property(rung: str) -> None:
    H, lost = RUNGS[rung]
    measured = measure_preservation(H, SEGMENTS)
    changed = {name for name in measured.__slots__ if getattr(measured, name) > 1e-12}
    assert changed == lost


def test_the_measures_are_the_known_amounts() -> None:
    measured = measure_preservation(transforms.similarity(1.5, 0.4, 3, 1), SEGMENTS)
    assert (measured.turn_rad, measured.length) == pytest.approx((0.4, 0.5))
    sheared = measure_preservation(transforms.affine([[1, 1], [0, 1]], (0, 0)), SEGMENTS)
    assert sheared.angle_rad == pytest.approx(math.pi / 4)
    assert sheared.length == pytest.approx(math.sqrt(5 / 2) - 1)


def test_lengths_change_without_bound_where_the_figure_is_cut() -> None:
    measured = measure_preservation(TILTED, SEGMENTS - [0.5 + 1, 0])
    assert measured.length == math.inf
    assert measured.bend < 1e-9


@pytest.mark.parametrize("side", [1, -1])
def test_a_bend_is_found_on_either_side_in_shares_of_the_length(side: int) -> None:
    """No homography bends a line; images that do are made here from an arc."""
    share = np.linspace(0, 1, 9)
    arc = np.stack([2 * share, side * 0.4 * share * (1 - share)], axis=-1)
    straight = share[:, None] * [3.0, 0.0]
    images, along = np.array([straight, arc]), np.array([[1.0, 0], [1.0, 0]])
    bend = preserved_properties._bend(images, along, np.array([3.0, 2.0]))
    assert bend == pytest.approx(0.1 / 2)


def test_a_projective_map_changes_what_is_known_of_a_rectangle() -> None:
    """Under w = 1 + x the sides of the unit square at x = 0 and 1 become 1 and 1/2 long."""
    square = np.array(
        [[(0, 0), (1, 0)], [(1, 0), (1, 1)], [(0, 1), (1, 1)], [(0, 0), (0, 1)]], float
    )
    measured = measure_preservation(TILTED, square)
    slant = math.hypot(0.5, 0.5)  # the upper side runs from (0, 1) to (1/2, 1/2)
    assert measured.turn_rad == pytest.approx(math.pi / 4)
    assert measured.length == pytest.approx(0.5)
    assert abs(slant - 1) < 0.5
    assert measured.angle_rad == pytest.approx(math.pi / 4)
    assert measured.parallel_rad == pytest.approx(math.pi / 4)
    assert measured.bend == pytest.approx(0, abs=1e-12)


def test_lines_that_are_nearly_parallel_are_not_parallel() -> None:
    """1e-6 rad apart: only lines that are parallel to a billionth are judged by that measure."""
    for slant, changed in ((1e-6, False), (1e-10, True)):
        two = np.array([[(0, 0), (1, 0)], [(0, 1), (1, 1 + slant)]], float)
        assert (measure_preservation(TILTED, two).parallel_rad > 0.1) is changed


def test_parallel_lines_may_run_in_opposite_senses() -> None:
    """Under w = 1 + y/2 the uprights at x = 0 and x = 1 lean by atan 1/2 towards one another."""
    H = transforms.projective([1, 0, 0, 0, 1, 0, 0, 0.5, 1])
    up = np.array([[(0, 0), (0, 1)], [(1, 0), (1, 1)]], float)
    for two in (up, up[::-1], np.array([up[0], up[1, ::-1]])):
        measured = measure_preservation(H, two)
        assert measured.parallel_rad == pytest.approx(math.atan(0.5))
        assert measured.turn_rad == pytest.approx(math.atan(0.5))
