"""What kind of distortion a lens has, and how far it bows a straight line."""

import numpy as np
import pytest
from numpy.typing import ArrayLike

from simulations.models.distortion.kinds import classify, line_bow
from simulations.models.distortion.lens_model import Distortion

TURNS = Distortion(k1=-0.2, k2=0.2)
"""g = 1 − 0.2 s + 0.2 s² turns at s = 1/2."""


@pytest.mark.parametrize(
    ("lens", "corner", "tolerance", "kind"),
    [
        (Distortion(), 1.0, 0.0, "none"),
        (Distortion(k1=-0.1), 1.0, 1e-4, "barrel"),
        (Distortion(k1=0.1), 1.0, 1e-4, "pincushion"),
        (Distortion(k1=-0.2, k2=0.05), 1.0, 1e-4, "barrel"),  # turns only at r = 1.41
        (TURNS, 1.0, 1e-4, "moustache"),
        (TURNS, 0.7, 1e-4, "barrel"),
        (TURNS, 0.75, 1e-4, "moustache"),
        (Distortion(k1=-0.5, k2=0.03), 4.0, 1e-4, "barrel"),  # folds at 0.83, before g turns
        # The magnification changes from 1 on the axis to 1 + k₁ at the corner.
        (Distortion(k1=0.1), 1.0, 0.099, "pincushion"),
        (Distortion(k1=0.1), 1.0, 0.101, "none"),
        (Distortion(k1=-0.1), 1.0, 0.099, "barrel"),
        (Distortion(k1=-0.1), 1.0, 0.101, "none"),
        (Distortion(k1=0.1), 0.0, 1e-3, "none"),
        (Distortion(k1=0.1), 1e45, 1e-3, "pincushion"),
    ],
)
def test_the_kind_follows_from_the_profile_inside_the_picture(
    lens: Distortion, corner: float, tolerance: float, kind: str
) -> None:
    assert classify(lens, corner, tolerance) == kind


SQUARE = np.array([[1.0, 1], [4, 1], [4, 5], [1, 5], [1, 1]])


@pytest.mark.parametrize(
    ("curve", "bow"),
    [
        (SQUARE, 5.0),  # a closed curve is measured from its ends
        ([SQUARE, 2 * SQUARE], [5.0, 10.0]),
        ([[3.0, 4.0], [5.0, 6.0]], 0.0),
        ([[0, 0], [1, 1], [2, 2]], 0.0),
        ([[0.0, 0], [1e3, 250.0], [2e3, 0]], 250.0),
        ([[-1e150, 0.0], [0.0, 1e150], [1e150, 0.0]], 1e150),
    ],
)
def test_a_bow_is_the_furthest_from_the_chord(curve: ArrayLike, bow: ArrayLike) -> None:
    assert line_bow(curve).tolist() == pytest.approx(bow)


def test_a_bow_is_the_same_to_either_side_and_turned_any_way() -> None:
    angle = np.linspace(-np.pi / 3, np.pi / 3, 101)
    arc = np.column_stack((np.cos(angle), np.sin(angle)))
    for turn in np.linspace(0, 6, 7):
        c, s = np.cos(turn), np.sin(turn)
        turned = arc @ [[c, s], [-s, c]] + [5.0, -3.0]
        np.testing.assert_allclose(line_bow([turned, turned[::-1], turned * [1, -1]]), 0.5)
