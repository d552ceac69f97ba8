"""Chapter 11: where the models break."""

from math import sqrt

import numpy as np
from support.worked_numbers import Says

from simulations.models.distortion.lens_model import (
    Distortion,
    fold_radius,
    largest_distorted_radius,
    undistort,
)

CHAPTER = "11-where-the-models-break"
LARGEST, SMALLEST = np.finfo(float).max, np.nextafter(0.0, 1.0)


def power(value: float, digits: int = 1) -> str:
    mantissa, _, exponent = f"{value:.{digits}e}".partition("e")
    return rf"{mantissa}\cdot 10^{{{int(exponent)}}}"


def squares_that_overflow() -> Says:
    assert power(LARGEST) == r"1.8\cdot 10^{308}"
    yield rf"$\sqrt{{1.8\cdot 10^{{308}}}} = {power(sqrt(LARGEST))}$ is infinite"
    below = 1.5e-162
    assert below**2 == 0.0 < (1.05 * below) ** 2 < 2 * SMALLEST
    yield r"any below $1.5\cdot 10^{-162}$ is zero"
    single = float(np.finfo(np.float32).max)
    yield rf"beyond ${power(sqrt(single))}$"
    yield rf"in $r^4$ beyond $4\cdot 10^{{{np.floor(np.log10(single**0.25)):.0f}}}$"
    assert 4e9 < single**0.25 < 4.5e9


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
    radii = np.linspace(0, np.sqrt(1 / 0.3), 10_001)
    assert (radii * (1 - 0.3 * radii**2)).max() < 0.75
    yield "No ideal radius gives 0.75"
