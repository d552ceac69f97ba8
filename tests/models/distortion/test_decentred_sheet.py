"""How far a decentred lens keeps its orientation: exactly, in every direction."""

import numpy as np
import pytest
from numpy.typing import ArrayLike

from simulations.models.arrays import Mask
from simulations.models.distortion.decentred_sheet import on_sheet_of_axis, sheet_of
from simulations.models.distortion.lens_model import Distortion
from simulations.models.distortion.radial_profile import RadialProfile


def asked(points: ArrayLike, lens: Distortion) -> Mask:
    return on_sheet_of_axis(np.asarray(points, float), lens.radial, lens.p1, lens.p2)


@pytest.mark.parametrize("p", [(0.03, 0.0), (0.0, 0.05), (0.03, 0.04)])
def test_without_radial_terms_the_map_first_turns_over_at_one_sixth_of_p(
    p: tuple[float, float],
) -> None:
    """1 − 6 |p| r against p: there, and in no other direction before."""
    assert sheet_of(RadialProfile(), *p).sure == pytest.approx(1 / (6 * np.hypot(*p)), rel=1e-12)


@pytest.mark.parametrize("sign", [1, -1])
@pytest.mark.parametrize(("along", "turns"), [((0, -1), 1 / 0.6), ((0, 1), np.inf)])
def test_along_and_against_p_the_turning_is_where_the_one_dimensional_map_has_it(
    along: tuple[int, int], turns: float, sign: int
) -> None:
    """y + 3 p₁ y² turns at y = −1 / (6 p₁), and nowhere on the other side of the axis."""
    lens, direction = Distortion(p1=0.1 * sign), sign * np.asarray(along, float)
    for radius in (0.5, 1.66, 1.67, 3.0, 1e3):
        assert asked([radius * direction], lens)[0] == (radius < turns)


def test_a_fold_however_narrow_is_seen() -> None:
    """1 − 0.9 s + 5 k₂ s² falls below zero over a few parts in a million of the radius."""
    lens = Distortion(k1=-0.3, k2=0.0405 * (1 - 1e-11), p1=1e-30)
    fold = np.sqrt(0.9 / (10 * lens.k2))
    assert asked([[0.999 * fold, 0], [1.001 * fold, 0], [0, 2 * fold]], lens).tolist() == [
        True,
        False,
        False,
    ]
    open_lens = Distortion(k1=-0.3, k2=0.0405 * (1 + 1e-6), p1=1e-30)
    assert asked([[1.001 * fold, 0], [0, 2 * fold]], open_lens).all()


def test_beyond_a_pole_nothing_is_on_the_sheet() -> None:
    lens = Distortion(k4=-1.0, p1=1e-6)
    assert sheet_of(lens.radial, lens.p1, lens.p2).pole == pytest.approx(1.0)
    assert asked([[0.9, 0.0], [1.1, 0.0], [0.0, -3.0]], lens).tolist() == [True, False, False]
