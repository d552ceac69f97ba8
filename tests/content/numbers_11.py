"""Chapter 11: where the models break."""

from math import sqrt

import numpy as np
from support.worked_numbers import Says

from simulations.models.distortion.lens_model import (
    Distortion,
    fold_radius,
    largest_distorted_radius,
    undistort,
    undistort_clamped,
)
from simulations.models.geometry import quaternions, rotations
from simulations.models.lens.thin_lens import circle_of_confusion_mm

CHAPTER = "11-where-the-models-break"
LARGEST, SMALLEST = np.finfo(float).max, np.nextafter(0.0, 1.0)


def power(value: float, digits: int = 1) -> str:
    mantissa, _, exponent = f"{value:.{digits}e}".partition("e")
    return rf"{mantissa}\cdot 10^{{{int(exponent)}}}"


def three_points_for_a_library() -> Says:
    """OpenCV's own answers are asked in tests/hard_cases/test_library_column.py."""
    for (x, y, z), divisor in (((1, 0, 0), 1), ((1, 0.5, -2), -2)):
        yield f"| $({x:g}, {y:g}, {z})$"
        yield f"$({320 + 800 * x / divisor:.0f}, {240 + 800 * y / divisor:.0f})$"


def squares_that_overflow() -> Says:
    yield r"as large as $1.8\cdot 10^{308}$"
    assert power(LARGEST) == r"1.8\cdot 10^{308}"
    yield rf"$\sqrt{{1.8\cdot 10^{{308}}}} = {power(sqrt(LARGEST))}$ is infinite"
    below = 1.5e-162
    assert below**2 == 0.0 < (1.05 * below) ** 2 < 2 * SMALLEST
    yield r"any below $1.5\cdot 10^{-162}$ is zero"
    single = float(np.finfo(np.float32).max)
    yield rf"beyond ${power(sqrt(single))}$, and where something is squared twice"
    yield rf"in $r^4$, beyond $4\cdot 10^{{{np.floor(np.log10(single**0.25)):.0f}}}$"
    assert 4e9 < single**0.25 < 4.5e9


def a_dot_product_that_rounds_to_one() -> Says:
    """acos of the dot product of unit quaternions that are 1.5e-9 rad apart, over random pairs."""
    apart, pairs = 3e-9, 200_000
    rng = np.random.default_rng(0)
    axes = rng.standard_normal((pairs, 3))
    turn = apart * axes / np.linalg.norm(axes, axis=-1, keepdims=True)
    start = quaternions.normalise(rng.standard_normal((pairs, 4)))
    end = quaternions.multiply(quaternions.from_rotation_vector(turn), start)
    end = quaternions.normalise(end)
    with np.errstate(invalid="ignore"):
        found = np.arccos((start * end).sum(axis=-1))
    some = found[found > 0]
    zero, nan, more = (100 * np.mean(each) for each in (found == 0, np.isnan(found), found > 0))
    yield rf"{zero:.0f} % gave 0, {more:.0f} % at least ${power(some.min(), 2)}$"
    yield f"and {nan:.0f} % NaN"
    assert some.min() > 0.99 * 10 * apart / 2
    yield "0, or at least ten times too much"
    yield rf"differs from 1 by ${power((apart / 2) ** 2 / 2)}$"
    spacing = 1 - np.nextafter(1.0, 0.0)
    assert 90 < spacing / ((apart / 2) ** 2 / 2) < 110
    yield "just below 1 are a hundred times as far apart"
    lengths = (np.linalg.norm(end + sign * start, axis=-1) for sign in (-1, 1))
    assert np.abs(4 * np.arctan2(*lengths) / apart - 1).max() < 5e-7
    yield "all come out right to six digits"


def a_value_that_does_not_fit_a_byte() -> Says:
    """Its whole part must not fit either, or a cast, which drops the fraction, would do."""
    value = 256.3
    yield f"A pixel's value is {value}."
    assert np.uint8(np.rint(np.clip(value, 0, 255))) == 255
    assert np.trunc(value) == np.rint(value) == 256
    yield f"The remainder is {value % 256:.1f}, which rounds to {np.rint(value % 256):.0f}."


def a_tree_with_the_lens_at_infinity() -> Says:
    disc = float(circle_of_confusion_mm(50, 2, np.inf, 10_000))
    yield rf"25\cdot 50/(1 - 0)\cdot(1/10\,000 - 0) = {disc:g}$ mm"


def past_the_fold() -> Says:
    lens = Distortion(k1=-0.3)
    fold = fold_radius(lens)
    yield f"folds at the ideal radius $r = {fold:.3f}$"
    yield f"farther out than $r_d = {largest_distorted_radius(lens):.3f}$"
    squared = 1.1409**2
    yield rf"$1.1409\cdot(1 - 0.3\cdot {squared:.4f}) = {1.1409 * (1 - 0.3 * squared):.3f}$"
    ideal, valid = undistort([0.75, 0.0], lens)
    assert not valid
    assert np.isnan(ideal).all()
    yield "`undistort` returns NaN, with the mask False"
    border, valid = undistort_clamped([0.75, 0.0], lens)
    assert not valid
    yield f"it puts the point on the fold, at {border[0]:.3f}, and its mask is False as well"
    radii = np.linspace(0, np.sqrt(1 / 0.3), 10_001)
    assert (radii * (1 - 0.3 * radii**2)).max() < 0.75
    yield "No ideal radius gives 0.75"


def a_trace_above_three() -> Says:
    yield "so it can come out a little above 3"
    turns = rotations.exponential(np.random.default_rng(1).standard_normal((1000, 3)))
    traces = np.trace(np.swapaxes(turns, 1, 2) @ turns, axis1=1, axis2=2)
    assert 3 < traces.max() < 3 + 1e-14


WORKED = (
    a_trace_above_three,
    three_points_for_a_library,
    squares_that_overflow,
    a_dot_product_that_rounds_to_one,
    a_value_that_does_not_fit_a_byte,
    a_tree_with_the_lens_at_infinity,
    past_the_fold,
)
