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
from simulations.models.geometry import rotations
from simulations.scenes.stability.errors import DISTANCES, errors_of

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


def units_of_rounding() -> Says:
    for kind, said in ((np.float64, r"1.1\cdot 10^{-16}"), (np.float32, r"6.0\cdot 10^{-8}")):
        assert power(float(np.finfo(kind).eps) / 2) == said
        yield f"${said}$ in {np.dtype(kind)}"


def a_cosine_of_half_a_small_angle() -> Says:
    """cos θ/2 lies θ²/8 below 1, and dθ = 4 dc / θ for a cosine that is off by dc."""
    theta, u = 1e-4, float(np.finfo(float).eps) / 2
    assert np.isclose(2 * np.sin(theta / 4) ** 2, theta**2 / 8, rtol=1e-6)
    yield r"that cosine lies $\theta^2/8$ below 1"
    yield r"is a share $8u/\theta^2$ of what the cosine says"
    errors = errors_of("angle", "float64")
    assert 0.3 < errors.written[DISTANCES.tolist().index(1e-4)] / (4 * u / theta**2) < 3
    yield "Seven: see"


def two_columns_that_are_close() -> Says:
    left, right = 412.3, 411.9
    yield f"{left} px and {right} px"
    assert 900 < left / (left - right) < 1100
    yield r"$\kappa \approx 1000$"


def a_chance_of_a_photon() -> Says:
    assert 1 - np.exp(-1e-17) == 0.0
    assert -np.expm1(-1e-17) == 1e-17
    yield r"For $\lambda = 10^{-17}$ that computes to 0"
    yield r"gives $-\mathrm{expm1}(-\lambda) = 10^{-17}$"
    assert np.isclose(np.hypot(3e200, 4e200), 5e200)
    yield "for two components that is what `hypot` does"


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


def a_trace_above_three() -> Says:
    yield "a computed trace can come out a little above 3"
    turns = rotations.exponential(np.random.default_rng(1).standard_normal((1000, 3)))
    traces = np.trace(np.swapaxes(turns, 1, 2) @ turns, axis1=1, axis2=2)
    assert 3 < traces.max() < 3 + 1e-14


WORKED = (
    a_trace_above_three,
    squares_that_overflow,
    units_of_rounding,
    a_cosine_of_half_a_small_angle,
    two_columns_that_are_close,
    a_chance_of_a_photon,
    past_the_fold,
)
