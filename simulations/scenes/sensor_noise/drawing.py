"""The drawings of the sensor-noise scene: labels of the wedge, and the photon-transfer plot."""

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from simulations.engine.drawing import Point, circle, dot, line, path, polyline, rectangle, text
from simulations.models.arrays import Floats, Mask

WIDTH, HEIGHT = 396.0, 264.0
ROWS, COLUMNS = 4, 6
PATCH_SIDES = (WIDTH / COLUMNS, HEIGHT / ROWS)
LEFT, RIGHT, TOP, BOTTOM = 56.0, 379.0, 22.0, 217.0
DECADES = 4.5
"""Of the mean axis, below twice the saturation level."""
LOWEST_DN2 = 0.01
"""Foot of the variance axis; smaller variances are drawn on it."""


@dataclass(frozen=True, slots=True)
class Curve:
    """What theory says of the plot."""

    gain_e_per_dn: float
    floor_dn2: float
    """Variance without light."""
    full_dn: float
    """Level at which well or converter is full."""
    dark_dn: float
    """Mean dark signal, which fills the well as well but is taken off the means."""


@dataclass(frozen=True, slots=True)
class Axes:
    """Logarithmic axes: the mean below, the variance at the left, both in decades."""

    low_x: float
    high_x: float
    low_y: float
    high_y: float

    def place(self, mean: float, variance: float) -> tuple[float, float]:
        """View box coordinates; what lies outside is drawn on the border."""
        x = (math.log10(max(mean, 1e-12)) - self.low_x) / (self.high_x - self.low_x)
        y = (math.log10(max(variance, 1e-12)) - self.low_y) / (self.high_y - self.low_y)
        across, up = min(max(x, 0.0), 1.0), min(max(y, 0.0), 1.0)
        return LEFT + (RIGHT - LEFT) * across, BOTTOM - (BOTTOM - TOP) * up

    def values(self, place: Point) -> tuple[float, float]:
        """Mean and variance at a place of the plot; what lies outside is brought to the border."""
        across = min(max((float(place[0]) - LEFT) / (RIGHT - LEFT), 0.0), 1.0)
        up = min(max((BOTTOM - float(place[1])) / (BOTTOM - TOP), 0.0), 1.0)
        return (
            10.0 ** (self.low_x + across * (self.high_x - self.low_x)),
            10.0 ** (self.low_y + up * (self.high_y - self.low_y)),
        )


def over_wedge(means_e: Floats, patch: int, *, all_labels: bool) -> str:
    """Mean electrons on each patch, or on the chosen one, and a frame around that."""
    width, height = PATCH_SIDES
    labels = [
        text(
            ((k % COLUMNS + 0.5) * width, (k // COLUMNS + 1) * height - 7),
            format_electrons(float(mean)),
            "halo",
            "middle",
        )
        for k, mean in enumerate(means_e)
        if all_labels or k == patch
    ]
    corner = (patch % COLUMNS * width + 2, patch // COLUMNS * height + 2)
    frame = [rectangle(corner, width - 4, height - 4, style) for style in ("casing", "image bold")]
    return "".join((*frame, *labels))


def over_patch(label: str) -> str:
    """What is in the enlarged patch, and how much of it is noise."""
    return text((12, HEIGHT - 14), label, "image strong halo")


def format_electrons(mean_e: float) -> str:
    """``625``, ``40k``."""
    if mean_e >= 1000:
        return f"{mean_e / 1000:.3g}k"
    return f"{mean_e:.3g}"


def transfer_plot(
    curve: Curve,
    mean_dn: Floats,
    variance_dn: Floats,
    fitted: Mask,
    patch: int,
    level_dn: float | None,
) -> str:
    """Measured patches over the theory's three parts.

    ``level_dn`` is the mean that the light of the chosen patch would have in a cell without end.
    """
    axes = axes_for(curve)
    parts = [*_frame(axes), *_theory(axes, curve)]
    for k, (mean, variance) in enumerate(zip(mean_dn, variance_dn, strict=True)):
        at = axes.place(float(mean), float(variance))
        parts.append(dot(at, "image", 3.5) if fitted[k] else circle(at, 3.5, "image"))
    chosen = axes.place(float(mean_dn[patch]), float(variance_dn[patch]))
    if level_dn is not None:
        foot = level_place(axes, level_dn)
        parts += [line(foot, chosen, "image thin"), dot(foot, "image", 5)]
    parts += [circle(chosen, 8, "casing"), circle(chosen, 8, "image bold")]
    parts.append(dot(floor_place(axes, curve), "error", 5))
    return "".join(parts)


def level_place(axes: Axes, level_dn: float) -> tuple[float, float]:
    """On the axis of the mean."""
    return (axes.place(level_dn, 1.0)[0], BOTTOM)


def floor_place(axes: Axes, curve: Curve) -> tuple[float, float]:
    """The right end of the floor."""
    return axes.place(10.0**axes.high_x, curve.floor_dn2)


def axes_for(curve: Curve) -> Axes:
    """Fixed by gain and converter, so that noise and exposure move the points and not the axes."""
    high_x = math.log10(2 * curve.full_dn)
    high_y = math.ceil(math.log10(max(5 * curve.full_dn / curve.gain_e_per_dn, 1.0)))
    return Axes(high_x - DECADES, high_x, math.log10(LOWEST_DN2), high_y)


def _frame(axes: Axes) -> Iterator[str]:
    grid = []
    for power in range(math.ceil(axes.low_x), math.floor(axes.high_x) + 1):
        x = axes.place(10.0**power, 1)[0]
        grid.append([(x, TOP), (x, BOTTOM)])
        yield text((x, BOTTOM + 17), _power(power), "muted small", "middle")
    for power in range(math.ceil(axes.low_y), math.floor(axes.high_y) + 1):
        y = axes.place(1, 10.0**power)[1]
        grid.append([(LEFT, y), (RIGHT, y)])
        yield text((LEFT - 7, y + 4), _power(power), "muted small", "end")
    yield path(grid, "muted thin faint")
    yield path([[(LEFT, TOP), (LEFT, BOTTOM), (RIGHT, BOTTOM)]], "muted")
    yield text(((LEFT + RIGHT) / 2, BOTTOM + 38), "mean, DN", "", "middle")
    yield text((LEFT + 6, TOP - 8), "variance, DN²", "image")


def _power(power: int) -> str:
    return f"{10.0**power:g}" if -3 < power < 4 else f"10{_superscript(power)}"


def _superscript(power: int) -> str:
    return str(power).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))


def _theory(axes: Axes, curve: Curve) -> Iterator[str]:
    """Floor, shot noise, their sum up to saturation, and the level where all pixels are full."""
    full = curve.full_dn - curve.dark_dn
    low, high = 10.0**axes.low_x, 10.0**axes.high_x
    means = np.geomspace(low, max(full, low), 60)
    total = [axes.place(float(m), float(m) / curve.gain_e_per_dn + curve.floor_dn2) for m in means]
    # The straight line starts where it enters the plot.
    start = max(low, LOWEST_DN2 * curve.gain_e_per_dn)
    yield line(
        axes.place(start, start / curve.gain_e_per_dn),
        axes.place(high, high / curve.gain_e_per_dn),
        "light dashed",
    )
    yield line(axes.place(low, curve.floor_dn2), axes.place(high, curve.floor_dn2), "error dashed")
    yield polyline(total, "ray bold")
    if full > low:
        x = axes.place(full, 1)[0]
        yield line((x, TOP), (x, BOTTOM), "muted dashed")
        yield text((x - 5, TOP + 12), "full", "muted small halo", "end")
    floor = axes.place(low, curve.floor_dn2)
    yield text((LEFT + 8, max(floor[1] - 6, TOP + 12)), "floor", "error small halo")
    middle = math.sqrt(max(full, low) * start)
    slope = axes.place(middle, middle / curve.gain_e_per_dn)
    label = (min(slope[0] + 10, RIGHT - 114), min(slope[1] + 18, BOTTOM - 6))
    yield text(label, "shot noise: mean / g", "light small halo")
