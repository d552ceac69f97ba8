"""What kind of distortion a lens has, and how far it bows a straight line."""

import numpy as np
import pytest
from numpy.typing import ArrayLike

from simulations.models.distortion.kinds import classify, line_bow
from simulations.models.distortion.lens_model import Distortion


@pytest.mark.parametrize(
    ("lens", "kind"),
    [
        (Distortion(), "none"),
        (Distortion(k1=-0.1), "barrel"),
        (Distortion(k1=0.1), "pincushion"),
        (Distortion(k1=-0.2, k2=0.2), "moustache"),
        (Distortion(k1=-0.2, k2=0.05), "barrel"),  # turns only at r = 1.41, outside the picture
    ],
)
def test_the_kind_follows_from_the_profile_inside_the_picture(lens: Distortion, kind: str) -> None:
    assert classify(lens, corner_radius=1.0, tolerance=1e-4) == kind


@pytest.mark.parametrize(
    ("k1", "tolerance", "kind"),
    [
        (0.1, 0.099, "pincushion"),
        (0.1, 0.101, "none"),
        (-0.1, 0.099, "barrel"),
        (-0.1, 0.101, "none"),
    ],
)
def test_a_change_of_magnification_within_the_tolerance_is_none(
    k1: float, tolerance: float, kind: str
) -> None:
    """From 1 on the axis to 1 + k₁ at the corner."""
    assert classify(Distortion(k1=k1), corner_radius=1.0, tolerance=tolerance) == kind


def test_the_kind_is_judged_up_to_the_fold_and_up_to_the_corner() -> None:
    turns = Distortion(k1=-0.2, k2=0.2)  # g = 1 − 0.2 s + 0.2 s² turns at s = 1/2
    assert classify(turns, corner_radius=0.7, tolerance=1e-4) == "barrel"
    assert classify(turns, corner_radius=0.75, tolerance=1e-4) == "moustache"
    folds = Distortion(k1=-0.5, k2=0.03)  # at r = 0.83; g itself turns only at r = 2.9
    assert classify(folds, corner_radius=4.0, tolerance=1e-4) == "barrel"


def test_a_bow_is_the_same_to_either_side_and_turned_any_way() -> None:
    angle = np.linspace(-np.pi / 3, np.pi / 3, 101)
    arc = np.column_stack((np.cos(angle), np.sin(angle)))
    for turn in np.linspace(0, 6, 7):
        c, s = np.cos(turn), np.sin(turn)
        turned = arc @ [[c, s], [-s, c]] + [5.0, -3.0]
        np.testing.assert_allclose(line_bow([turned, turned[::-1], turned * [1, -1]]), 0.5)


def test_a_closed_curve_is_measured_from_its_ends() -> None:
    square = np.array([[1.0, 1], [4, 1], [4, 5], [1, 5], [1, 1]])
    assert line_bow(square) == pytest.approx(5.0)
    assert line_bow([square, square * 2]).tolist() == pytest.approx([5.0, 10.0])
    assert line_bow([[3.0, 4.0], [5.0, 6.0]]) == 0
    assert line_bow([[0, 0], [1, 1], [2, 2]]) == 0


def test_with_no_tolerance_at_all_an_ideal_lens_is_still_none() -> None:
    assert classify(Distortion(), corner_radius=1.0, tolerance=0.0) == "none"


@pytest.mark.parametrize("size", [1e-3, 1.0, 1e3])
def test_a_bow_scales_with_its_curve(size: float) -> None:
    assert line_bow(size * np.array([[0.0, 0], [1, 0.25], [2, 0]])) == pytest.approx(0.25 * size)


@pytest.mark.parametrize(
    "points",
    [
        np.empty((0, 2)),
        [1.0, 2.0],
        [[0, 0], [np.nan, 1], [1, 1]],
        [[0, 0], [1.001e150, 1]],
        [[0, 0], [1, -1.001e150]],
    ],
)
def test_a_curve_that_is_none_has_no_bow(points: ArrayLike) -> None:
    with pytest.raises(ValueError, match=r"legal: \(\.\.\., N, 2\), finite"):
        line_bow(points)


@pytest.mark.parametrize("corner", [-1.0, np.nan, np.inf])
def test_a_kind_is_told_over_a_picture_with_corners(corner: float) -> None:
    with pytest.raises(ValueError, match=r"corner_radius .*; legal: 0 to"):
        classify(Distortion(k1=0.1), corner, 1e-3)


def test_a_curve_may_reach_to_1e150_and_a_picture_from_the_axis_to_1e45() -> None:
    assert line_bow([[-1e150, 0.0], [0.0, 1e150], [1e150, 0.0]]) == pytest.approx(1e150)
    assert classify(Distortion(k1=0.1), 0.0, 1e-3) == "none"
    assert classify(Distortion(k1=0.1), 1e45, 1e-3) == "pincushion"
