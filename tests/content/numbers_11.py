"""Chapter 11: where the models break."""

from math import acos, cos, sqrt

import numpy as np
from support.worked_numbers import Says

from simulations.models.distortion import Distortion, fold_radius, largest_distorted_radius
from simulations.models.optics import circle_of_confusion_mm

CHAPTER = "11-where-the-models-break"
LARGEST, SMALLEST = np.finfo(float).max, np.nextafter(0.0, 1.0)


def power(value: float, digits: int = 1) -> str:
    mantissa, _, exponent = f"{value:.{digits}e}".partition("e")
    return rf"{mantissa}\cdot 10^{{{int(exponent)}}}"


def three_points_for_a_library() -> Says:
    """OpenCV's own answers are asked in tests/extremes/test_library_column.py."""
    for (x, y, z), divisor in (((1, 0, 0), 1), ((1, 0.5, -2), -2)):
        yield f"| $({x:g}, {y:g}, {z})$"
        yield f"$({320 + 800 * x / divisor:.0f}, {240 + 800 * y / divisor:.0f})$"


def squares_that_overflow() -> Says:
    yield r"reaches $1.8\cdot 10^{308}$"
    assert power(LARGEST) == r"1.8\cdot 10^{308}"
    yield rf"$\sqrt{{1.8\cdot 10^{{308}}}} = {power(sqrt(LARGEST))}$ is infinite"
    below = 1.5e-162
    assert below**2 == 0.0 < (1.05 * below) ** 2 < 2 * SMALLEST
    yield r"any below $1.5\cdot 10^{-162}$ is zero"
    single = float(np.finfo(np.float32).max)
    yield rf"beyond ${power(sqrt(single))}$, and after two squarings"
    yield rf"beyond $4\cdot 10^{{{np.floor(np.log10(single**0.25)):.0f}}}$"
    assert 4e9 < single**0.25 < 4.5e9


def cosines_that_are_flat() -> Says:
    spacing = 1 - np.nextafter(1.0, 0.0)
    yield rf"Neighbouring numbers just below 1 are ${power(spacing)}$ apart"
    yield rf"\frac{{\theta^2}}{{2}} \approx {power(spacing / 2)} "
    yield rf"\theta \approx {power(sqrt(spacing), 2)}$$"
    assert acos(cos(1.04e-8)) == 0 < acos(cos(1.07e-8))
    assert np.isclose(3e-9**2 / 8, 1.1e-18, rtol=0.03)
    yield rf"$1 - {power(3e-9**2 / 8)}$ rounds to 1"


def a_tree_with_the_lens_at_infinity() -> Says:
    disc = float(circle_of_confusion_mm(50, 2, np.inf, 10_000))
    yield rf"25\cdot 50/(1 - 0)\cdot(1/10\,000 - 0) = {disc:g}$ mm"


def past_the_fold() -> Says:
    lens = Distortion(k1=-0.3)
    fold = fold_radius(lens)
    yield f"folds at $r = {fold:.3f}$"
    yield f"farther out than {largest_distorted_radius(lens):.3f}"
    squared = 1.1409**2
    yield rf"$1.1409\cdot(1 - 0.3\cdot {squared:.4f}) = {1.1409 * (1 - 0.3 * squared):.3f}$"
    yield f"Ours returns the fold circle, {fold:.3f}"


WORKED = (
    three_points_for_a_library,
    squares_that_overflow,
    cosines_that_are_flat,
    a_tree_with_the_lens_at_infinity,
    past_the_fold,
)
