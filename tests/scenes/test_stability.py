"""The stability figure: its exact reference, and its error curves against theory."""

from fractions import Fraction
from math import asin, atan, isclose, sin

import numpy as np
import pytest
from support.frames import texts_at

from simulations.models.distortion.lens_model import Distortion, undistort
from simulations.models.lens.thin_lens import circle_of_confusion_mm
from simulations.scenes.stability import errors as exact
from simulations.scenes.stability.errors import DISTANCES, errors_of, unit_of
from simulations.scenes.stability.pictures import COLUMNS, painted, pictures, room
from simulations.scenes.stability.scene import FORMATS, FORMULAS, SCENE


def as_float(fixed: int) -> float:
    return float(Fraction(fixed, exact.ONE))


@pytest.mark.parametrize("ratio", [0.0, 1e-300, 1e-9, 0.3, 1.0, 7.5, 1e9])
def test_fixed_point_arctangent_is_correct(ratio: float) -> None:
    assert isclose(as_float(exact.arctangent(exact.fixed(ratio))), atan(ratio), abs_tol=1e-60)


def test_arctangent_of_one_is_correct_beyond_a_double() -> None:
    quarter = 4 * exact.arctangent(exact.ONE)
    digits = "31415926535897932384626433832795028841971693993751"
    assert str(quarter * 10**49 >> exact.BITS) == digits


def test_exact_pixel_and_blur_are_correct() -> None:
    rows = exact.ROWS.tolist()
    point, centre = (1e9 + 3.5, 2e8, 7e8 + 5.25), (1e9, 2e8, 7e8)
    away = [Fraction(p) - Fraction(c) for p, c in zip(point, centre, strict=True)]
    x, z = (sum(Fraction(r) * d for r, d in zip(row, away, strict=True)) for row in rows)
    assert isclose(as_float(exact.exact_pixel(rows, point, centre)), float(x / z), rel_tol=1e-15)
    disc = float(circle_of_confusion_mm(50.0, 2.0, 2000.0, 2000.5))
    assert isclose(50 * as_float(exact.exact_blur(0.5, 40.0, 40.01)), disc, rel_tol=1e-11)


@pytest.mark.parametrize("seen", [0.1, 0.5, 0.7])
def test_exact_ideal_radius_solves_the_cubic(seen: float) -> None:
    """r = 2 r_f sin(asin(r_d / r_d,max) / 3), and the book's own inverse."""
    found = as_float(exact.exact_radius(exact.K1, seen, seen))
    third = asin(seen / exact.LARGEST_SEEN) / 3
    assert isclose(found, 2 * exact.FOLD * sin(third), rel_tol=1e-13)
    assert isclose(found, float(undistort([seen, 0.0], Distortion(k1=-0.3))[0][0]))


@pytest.mark.parametrize("formula", FORMULAS)
@pytest.mark.parametrize("digits", FORMATS)
def test_error_curves_agree_with_theory(formula: str, digits: str) -> None:
    """Numbers nearer than four spacings may be equal. Differences of exact inputs keep every digit;
    written otherwise, they are on the line of the rounded inputs."""
    errors, u = errors_of(formula, digits), unit_of(digits)
    curves = errors.written, errors.rearranged, errors.bound
    assert all(np.array_equal(np.isnan(curve), 8 * u > DISTANCES) for curve in curves)
    assert np.nanmax(errors.rearranged / errors.bound) <= 5
    if formula in ("blur", "origin"):
        assert np.nanmax(errors.rearranged) < 8 * u
        between = (DISTANCES < 0.1) & (100 * u < DISTANCES)
        ratio = errors.written[between] / errors.bound[between]
        assert 0.3 < ratio.min() < ratio.max() < 30


def test_arccosine_magnifies_errors_by_one_over_the_angle() -> None:
    errors, between = errors_of("angle", "float64"), (DISTANCES > 1e-7) & (DISTANCES < 0.1)
    excess = errors.written[between] / errors.bound[between] * DISTANCES[between]
    assert 0.5 < excess.min() < excess.max() < 10
    assert 6.5 < float(texts_at(SCENE, formula="angle", power=-4)["digits"]) < 7.5


def test_error_bound_near_the_fold_has_slope_minus_one_half() -> None:
    errors, near = errors_of("fold", "float64"), DISTANCES < 1e-3
    assert (errors.rearranged[near] > 0.1 * errors.bound[near]).all()
    slope = np.polyfit(np.log(DISTANCES[near]), np.log(errors.bound[near]), 1)[0]
    assert slope == pytest.approx(-0.5, abs=0.01)
    assert (errors.written[near] > 1e5 * errors.rearranged[near]).all()


@pytest.mark.parametrize("formula", FORMULAS)
def test_rearranged_formula_is_accurate_where_the_printed_one_fails(formula: str) -> None:
    truth = painted(room(COLUMNS // 2)).astype(int)
    worst = [
        [np.abs(one.astype(int) - truth).max() for one in pictures(formula, digits, power, 100)]
        for digits, power in (("float64", -2.0), ("float64", -4.0), ("float32", -6.0))
    ]
    assert max(worst[0]) <= 1
    assert worst[1][1] <= 1
    assert worst[2][0] > 20
