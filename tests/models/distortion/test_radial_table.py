"""The table that undoes lenses: against bisection, and where it must not be used."""

import numpy as np
import pytest
from support.radial_profiles import bisect

from simulations.models.arrays import Floats
from simulations.models.distortion import radial_table
from simulations.models.distortion.lens_model import (
    Distortion,
    undistort,
)
from simulations.models.distortion.radial_profile import (
    RadialProfile,
    evaluate,
    fold_radius,
    largest_image_radius,
    slope,
)
from simulations.models.distortion.radial_table import (
    inverse_table,
    invert,
    shrinkage,
)

LONGEST_FOCAL_PX = 2000.0
FURTHEST = 1.2
"""Ideal radius, 50° off the axis, to which lenses without a fold are tried."""
LENSES = {
    "slight barrel": Distortion(k1=-0.05),
    "barrel": Distortion(k1=-0.2),
    "strong barrel": Distortion(k1=-0.5),
    "barrel that recovers": Distortion(k1=-0.3, k2=0.1),
    "action camera": Distortion(k1=-0.28, k2=0.07, k3=-0.009),
    "moustache": Distortion(k1=-0.2, k2=0.2),
    "pincushion": Distortion(k1=0.2),
    "strong pincushion": Distortion(k1=1.0),
    "strongest pincushion": Distortion(k1=2.0),
    "pincushion of three terms": Distortion(k1=0.4, k2=0.3, k3=0.2),
    "pincushion that folds": Distortion(k1=0.2, k2=-0.05, k3=-0.01),
    "strong pincushion that folds": Distortion(k1=1.0, k2=-0.5),
    "k3 alone": Distortion(k3=-0.1),
    "rational": Distortion(k1=0.1, k2=0.02, k3=0.01, k4=0.3, k5=0.05, k6=0.01),
    "rational that folds": Distortion(k4=1.0),
    "pole": Distortion(k4=-0.25),
    "hardly any": Distortion(k1=1e-13),
    "hardly any barrel": Distortion(k1=-1e-13),
}


def images_up_to_99_percent(profile: RadialProfile) -> Floats:
    """Image radii up to 99 % of the fold, in ideal radius as well as in the picture."""
    fold = fold_radius(profile)
    return np.linspace(0.0, evaluate(profile, min(0.99 * fold, max(FURTHEST, 0.99))), 4001)


@pytest.mark.parametrize("name", LENSES)
def test_the_inverse_is_good_to_a_millionth_of_a_pixel_within_99_percent_of_the_fold(
    name: str,
) -> None:
    lens = LENSES[name]
    image_radius = images_up_to_99_percent(lens.radial)
    turn = np.linspace(0.0, 20.0, image_radius.size)
    seen = image_radius[:, None] * np.stack((np.cos(turn), np.sin(turn)), axis=-1)
    ideal, valid = undistort(seen, lens)
    assert valid.all()
    # The radius that was asked for is that of the rounded point.
    x, y = seen.T.astype(np.longdouble)
    radius = np.hypot(x, y)
    ratio = np.divide(bisect(lens.radial, radius), radius, out=np.ones_like(x), where=radius > 0)
    off = np.hypot(ideal[:, 0] - x * ratio, ideal[:, 1] - y * ratio)
    assert LONGEST_FOCAL_PX * off.max() <= 1e-9  # what the table promises: a thousandth of it


@pytest.mark.parametrize("name", LENSES)
def test_within_99_percent_of_the_fold_no_point_has_to_be_solved_for(name: str) -> None:
    """So the time is that of looking up, and not that of iterating."""
    profile = LENSES[name].radial
    assert shrinkage(profile, images_up_to_99_percent(profile) ** 2)[1].all()


@pytest.mark.parametrize(("k", "most"), [((-0.3,), 24), ((3.0,), 24), ((0.3, -0.1), 3400)])
def test_away_from_folds_a_table_errs_by_so_many_times_the_condition(
    k: tuple[float, ...], most: float
) -> None:
    profile = RadialProfile(k)
    image_radius = np.linspace(0.0, min(0.9 * largest_image_radius(profile), 1.4), 20_000)[1:]
    factor, known = shrinkage(profile, image_radius**2)
    truth = bisect(profile, image_radius)
    condition = image_radius / (truth * slope(profile, truth))
    units = np.abs(factor * image_radius / truth - 1.0) / (2.0**-53 * condition)
    assert known.all()
    assert most / 5 < units.max() <= most


def test_where_a_curve_is_nearly_flat_the_table_ends_and_the_answer_is_right_all_the_same() -> None:
    """The slope 1 − 0.9 s + 0.2025001 s² comes within 4e-7 of zero, at r² = 2.22."""
    profile, flat = RadialProfile((-0.3, 0.04050002)), np.sqrt(0.9 / 0.405)
    image_radius = np.linspace(0.0, evaluate(profile, 2.0), 5000)
    known = shrinkage(profile, image_radius**2)[1]
    ends = image_radius[known].max()
    assert 0.9 * evaluate(profile, flat) < ends < evaluate(profile, flat)
    radius, valid = invert(profile, image_radius)
    assert valid.all()
    np.testing.assert_allclose(evaluate(profile, radius), image_radius, rtol=1e-12)


@pytest.mark.parametrize(("error", "held"), [(0.95e-12, True), (1.05e-12, False)])
def test_a_cell_that_is_off_by_more_than_a_trillionth_ends_the_table_before_it(
    error: float, held: bool
) -> None:
    profile = RadialProfile((-0.3,))
    table = inverse_table(profile, 1.0)
    grid, fold = table.grid, fold_radius(profile)
    doctored = table.coefficients.copy()
    doctored[:, 100] *= 1.0 + error
    reach = radial_table._checked_reach(profile, fold, grid, doctored)
    # Cells are counted from the fold, u = 0, to the axis, u = 1; this one's edge is at 100.5.
    edge = 4 / 9 * fold**2 * (1.0 - (100.5 / 256) ** 2)
    assert reach == pytest.approx(table.reach if held else edge, rel=1e-12)
    doctored[:, -1] *= 1.0 + error
    at_the_axis = radial_table._checked_reach(profile, fold, grid, doctored)
    assert at_the_axis == (table.reach if held else 0.0)
