"""The stability figure: its reference is exact, and its curves lie where theory has them."""

import re
from fractions import Fraction
from math import asin, atan, isclose, pi

import numpy as np
import pytest
from support.frames import texts_of

from simulations.engine.stages import StageCache
from simulations.models.arrays import Floats
from simulations.models.distortion.lens_model import Distortion, undistort
from simulations.models.lens.thin_lens import circle_of_confusion_mm
from simulations.scenes.stability import formulas, truth
from simulations.scenes.stability.errors import DISTANCES, NEAREST_SPACINGS, errors_of
from simulations.scenes.stability.scene import SCENE
from simulations.scenes.stability.settings import FORMATS, FORMULAS

EVERY = [(formula, digits) for formula in FORMULAS for digits in FORMATS]


def unit(digits: str) -> float:
    return float(np.finfo(np.dtype(digits)).eps) / 2


def there(values: Floats) -> Floats:
    return values[~np.isnan(values)]


def as_float(fixed: int) -> float:
    return float(Fraction(fixed, truth.ONE))


@pytest.mark.parametrize("ratio", [0.0, 1e-300, 1e-9, 0.3, 1.0, 7.5, 1e9])
def test_the_arctangent_in_whole_numbers_is_the_library_s(ratio: float) -> None:
    assert isclose(as_float(truth.arctangent(truth.fixed(ratio))), atan(ratio), abs_tol=1e-60)


def test_the_arctangent_has_far_more_places_than_a_double() -> None:
    quarter = 4 * truth.arctangent(truth.ONE)
    digits = "31415926535897932384626433832795028841971693993751"
    assert str(quarter * 10**49 >> truth.BITS) == digits
    assert isclose(as_float(quarter), pi)


def test_the_exact_pixel_and_blur_are_those_of_fractions() -> None:
    rows = ((0.8, 0.0, 0.6), (-0.6, 0.0, 0.8))
    point, centre = (1e9 + 3.5, 2e8, 7e8 + 5.25), (1e9, 2e8, 7e8)
    away = [Fraction(p) - Fraction(c) for p, c in zip(point, centre, strict=True)]
    x, z = (sum(Fraction(r) * d for r, d in zip(row, away, strict=True)) for row in rows)
    assert isclose(as_float(truth.pixel(rows, point, centre)), float(x / z), rel_tol=1e-15)
    focal, focus, depth = 50.0, 2000.0, 2000.5
    disc = float(circle_of_confusion_mm(focal, 2.0, focus, depth))
    ours = focal * as_float(truth.blur(0.5, focus / focal, depth / focal))
    assert isclose(ours, disc, rel_tol=1e-11)


def test_the_exact_ideal_radius_is_the_sine_of_a_third() -> None:
    """r = 2 r_f sin(asin(r_d / r_d,max) / 3), and the book's own inverse agrees."""
    for seen in (0.1, 0.5, 0.7):
        found = as_float(truth.ideal_radius(formulas.K1, seen, seen))
        third = asin(seen / formulas.LARGEST_SEEN) / 3
        assert isclose(found, 2 * formulas.FOLD * np.sin(third), rel_tol=1e-13)
        assert isclose(found, float(undistort([seen, 0.0], Distortion(k1=-0.3))[0][0]))


@pytest.mark.parametrize(("formula", "digits"), EVERY)
def test_curves_end_where_the_format_has_no_inputs_that_near(formula: str, digits: str) -> None:
    errors = errors_of(formula, digits)
    near = NEAREST_SPACINGS * 2 * unit(digits) > DISTANCES
    for curve in (errors.written, errors.rearranged, errors.bound):
        assert np.array_equal(np.isnan(curve), near)


@pytest.mark.parametrize(("formula", "digits"), EVERY)
def test_what_is_rearranged_is_never_worse_than_the_data_deserve(formula: str, digits: str) -> None:
    errors = errors_of(formula, digits)
    assert (there(errors.rearranged) <= 5 * there(errors.bound)).all()


@pytest.mark.parametrize("digits", FORMATS)
def test_differences_of_exact_inputs_keep_every_digit(digits: str) -> None:
    for formula in ("blur", "origin"):
        assert there(errors_of(formula, digits).rearranged).max() < 8 * unit(digits)


@pytest.mark.parametrize("digits", FORMATS)
def test_stable_formulas_as_written_lie_on_the_line(digits: str) -> None:
    for formula in ("blur", "origin"):
        errors = errors_of(formula, digits)
        between = (DISTANCES < 0.1) & (100 * unit(digits) < DISTANCES)
        ratio = errors.written[between] / errors.bound[between]
        assert 0.3 < ratio.min() < ratio.max() < 30


def test_the_arccosine_lies_above_the_line_by_one_over_the_angle() -> None:
    errors = errors_of("angle", "float64")
    between = (DISTANCES > 1e-7) & (DISTANCES < 0.1)
    excess = errors.written[between] / errors.bound[between] * DISTANCES[between]
    assert 0.5 < excess.min() < excess.max() < 10


def test_near_the_fold_no_formula_comes_far_below_the_line() -> None:
    errors = errors_of("fold", "float64")
    near = DISTANCES < 1e-3
    assert (errors.rearranged[near] > 0.1 * errors.bound[near]).all()
    slope = np.polyfit(np.log(DISTANCES[near]), np.log(errors.bound[near]), 1)[0]
    assert slope == pytest.approx(-0.5, abs=0.01)
    assert (errors.written[near] > 1e5 * errors.rearranged[near]).all()


def readout(**given: object) -> str:
    return texts_of(SCENE.render(SCENE.check(given), "", StageCache()))["digits"]


def test_digits_are_counted_from_the_curve_as_written() -> None:
    assert 6.5 < float(readout(formula="angle", power=-4)) < 7.5


def test_the_bars_are_as_long_as_the_digits_that_are_right() -> None:
    """16 cells in float64; of an angle of 10⁻⁴ the arccosine has seven digits, atan2 all."""
    frame = SCENE.render(SCENE.check({"formula": "angle", "power": -4}), "", StageCache())
    bars = re.findall(
        r'class="(error|image) solid faint" [^>]*width="([\d.]+)"', frame.panels[1].overlay
    )
    assert [role for role, _ in bars] == ["error", "image"]
    written, rearranged = (16 * float(width) / 368 for _, width in bars)
    assert written == pytest.approx(float(texts_of(frame)["digits"]), abs=0.06)
    assert rearranged > 15


def test_a_mark_without_inputs_has_no_bars() -> None:
    given = SCENE.check({"formula": "angle", "digits": "float32", "power": -12})
    overlay = SCENE.render(given, "", StageCache()).panels[1].overlay
    assert "solid faint" not in overlay
    assert overlay.count("no inputs") == 2
