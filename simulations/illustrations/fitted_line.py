"""A line fitted to five points: a slope, residuals, the lines of other noise, and their errors."""

import math

import numpy as np

from simulations.engine.drafting import label
from simulations.engine.drawing import dot, path
from simulations.engine.illustration import Illustration, Panel
from simulations.engine.plotting import Axis, Plot, Scale
from simulations.models.arrays import Floats

COLUMNS = np.array([1000.0, 1010.0, 1020.0, 1030.0, 1040.0])
NOISE_PX, LINES, SEED = 0.5, 60, 4
TRUE = (210.0, 0.1)
"""Row at the middle column, and slope."""
WIDTH, HEIGHT = 400.0, 224.0


def design(origin: float, unit: float = 1.0) -> Floats:
    """A (5, 2) of a line whose columns are counted from ``origin`` in ``unit`` px."""
    return np.stack([np.ones(len(COLUMNS)), (COLUMNS - origin) / unit], axis=1)


def covariance(origin: float) -> Floats:
    """σ² (AᵀA)⁻¹ (2, 2) of the row at ``origin`` and the slope."""
    A = design(origin)
    return np.asarray(NOISE_PX**2 * np.linalg.inv(A.T @ A))


def condition(origin: float, unit: float = 1.0) -> float:
    """Largest over smallest singular value of the design matrix."""
    return float(np.linalg.cond(design(origin, unit)))


def rows() -> Floats:
    """(lines, 5) measured rows of the same edge, each time with other noise."""
    noise = np.random.default_rng(SEED).normal(0.0, NOISE_PX, (LINES, len(COLUMNS)))
    return np.asarray(design(COLUMNS[2]) @ TRUE + noise)


def fitted_lines(origin: float) -> Floats:
    """(lines, 2): row at ``origin`` and slope of the line fitted to each."""
    return np.asarray(np.linalg.lstsq(design(origin), rows().T, rcond=None)[0].T)


def distance(height_px: Floats | float) -> Floats:
    """Metres to a door of 2 m by a camera of 800 px."""
    return np.asarray(1600.0 / height_px)


def _slope() -> Panel:
    plot = Plot(Axis(60, 160, 48, 388), Axis(8, 28, 172, 28))
    heights, near = np.linspace(60, 160, 101), np.linspace(70, 130, 2)
    marks = [
        plot.frame(Scale("y", "px", ticks=(80, 100, 120, 140)), Scale("Z", "m", ticks=4)),
        plot.curve(heights, distance(heights), "world bold"),
        plot.curve(near, distance(100.0) - 0.16 * (near - 100), "error dashed"),
        dot(plot.at(100, 16), "world", 4.5),
        label((180, 60), "−0.16 m for each px", "error"),
    ]
    return Panel("slope", "A slope", WIDTH, HEIGHT, overlay="".join(marks))


def _residuals() -> Panel:
    plot = Plot(Axis(995, 1045, 48, 388), Axis(206.5, 213.5, 14, 172))
    measured = rows()[0]
    fitted = design(COLUMNS[2]) @ fitted_lines(COLUMNS[2])[0]
    marks = [
        plot.frame(Scale("column", ticks=(1000, 1020, 1040)), Scale("row", ticks=(208, 210, 212))),
        path(
            [
                [plot.at(x, a), plot.at(x, b)]
                for x, a, b in zip(COLUMNS, measured, fitted, strict=True)
            ],
            "error bold",
        ),
        plot.curve(COLUMNS, fitted, "image bold"),
        *(dot(plot.at(x, y), "world", 4.5) for x, y in zip(COLUMNS, measured, strict=True)),
        label((56, 164), "residuals", "error"),
    ]
    return Panel("residuals", "Least squares", WIDTH, HEIGHT, overlay="".join(marks))


def _lines() -> Panel:
    plot = Plot(Axis(0, 1100, 48, 388), Axis(60, 240, 14, 172))
    ends = np.array([0.0, 1100.0])
    marks = [
        plot.frame(Scale("column", ticks=(500, 1020)), Scale("row", ticks=(100, 150, 200))),
        *(
            plot.curve(ends, row + slope * ends, "image thin faint")
            for row, slope in fitted_lines(0.0)
        ),
        *(dot(plot.at(x, 210 + (x - 1020) / 10), "world", 2.5) for x in COLUMNS),
        label((58, 166), f"± {math.sqrt(covariance(0.0)[0, 0]):.0f} px", "error"),
        label((384, 108), f"± {math.sqrt(covariance(1020.0)[0, 0]):.1f} px", "error", "end"),
    ]
    return Panel("lines", "Sixty edges of other noise", WIDTH, HEIGHT, overlay="".join(marks))


def _clouds() -> Panel:
    plot = Plot(Axis(-3.2, 3.2, 118, 278), Axis(-3.2, 3.2, 172, 28))
    marks = [plot.frame(Scale("row, σ", ticks=(-2, 0, 2)), Scale("slope, σ", ticks=(-2, 0, 2)))]
    for origin, style, radius in ((1020.0, "image", 3.0), (0.0, "error", 2.0)):
        off = (fitted_lines(origin) - (210.0 + (origin - 1020.0) / 10, 0.1)) / np.sqrt(
            np.diag(covariance(origin))
        )
        marks += [dot(plot.at(x, y), style, radius) for x, y in off]
    marks.append(label((290, 40), "row at 1020", "image"))
    marks.append(label((290, 164), "row at 0", "error"))
    return Panel("clouds", "How they err together", WIDTH, HEIGHT, overlay="".join(marks))


def draw() -> Illustration:
    words = (
        "Four drawings. Distance over height in the picture, with its tangent at 100 px and 16 m. "
        "Five measured points and the line with the least sum of squared residuals. Sixty such "
        "lines fan out to the left: ±0.2 px among the points, ±16 px at column 0. Errors of row "
        "and slope, in standard errors: a round cloud with the row at column 1020, a slanting "
        "stroke with the row at column 0."
    )
    return Illustration((_slope(), _residuals(), _lines(), _clouds()), words)
