"""The drawings of the sensor-noise scene: labels of the wedge, and the photon-transfer plot."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from simulations.engine.drawing import Point, circle, dot, line, rectangle, text
from simulations.engine.plotting.axis import Axis
from simulations.engine.plotting.labels import Label, Rectangle, place_labels
from simulations.engine.plotting.plot import Plot
from simulations.engine.plotting.scale import Scale
from simulations.engine.plotting.ticks import log_ticks
from simulations.models.arrays import Floats, Mask

WIDTH, HEIGHT = 396.0, 264.0
ROWS, COLUMNS = 4, 6
PATCH_SIDES = (WIDTH / COLUMNS, HEIGHT / ROWS)
DECADES = 4.5
"""Decades of the mean axis, below twice the saturation level."""
LOWEST_DN2 = 0.01
"""Lower end of the variance axis; smaller variances are drawn at it."""


@dataclass(frozen=True, slots=True)
class Curve:
    """The theory of the plot."""

    gain_e_per_dn: float
    floor_dn2: float
    """Variance without light."""
    full_dn: float
    """Level at which the well or the converter is full."""
    dark_dn: float
    """Mean dark signal, which also fills the well but is subtracted from the means."""


def over_wedge(patch: int) -> str:
    """A frame around the chosen patch."""
    width, height = PATCH_SIDES
    corner = (patch % COLUMNS * width + 2, patch // COLUMNS * height + 2)
    styles = ("casing", "image bold")
    return "".join(rectangle(corner, width - 4, height - 4, style) for style in styles)


def over_patch(label: str) -> str:
    """Signal and noise of the enlarged patch."""
    return text((12, HEIGHT - 14), label, "image strong ground")


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
    one_frame_dn2: Floats | None,
) -> str:
    """Measured patches over the theory's three parts.

    ``level_dn`` is the mean that the light of the chosen patch would have in an unlimited well;
    ``one_frame_dn2`` (24,) is drawn as crosses, the variance that a single frame would give.
    """
    plot = plot_of(curve)
    parts = [_frame(plot), *_theory(plot, curve)]
    crosses: list[Point] = []
    if one_frame_dn2 is not None:
        pairs = zip(mean_dn, one_frame_dn2, strict=True)
        crosses = [plot.clamped(float(mean), float(variance)) for mean, variance in pairs]
        parts += map(_cross, crosses)
    for k, (mean, variance) in enumerate(zip(mean_dn, variance_dn, strict=True)):
        at = plot.clamped(float(mean), float(variance))
        parts.append(dot(at, "image", 3.5) if fitted[k] else circle(at, 3.5, "image"))
    chosen = plot.clamped(float(mean_dn[patch]), float(variance_dn[patch]))
    if level_dn is not None:
        foot = level_place(plot, level_dn)
        parts += [line(foot, chosen, "image thin"), dot(foot, "image", 5)]
    parts += [circle(chosen, 8, "casing"), circle(chosen, 8, "image bold")]
    return "".join((*parts, _names(plot, curve, chosen, crosses)))


def _cross(place: Point) -> str:
    x, y = place
    return line((x - 3, y - 3), (x + 3, y + 3), "error") + line(
        (x - 3, y + 3), (x + 3, y - 3), "error"
    )


def level_place(plot: Plot, level_dn: float) -> tuple[float, float]:
    """The handle of the light, on the axis of the mean."""
    return plot.clamped(level_dn, plot.y.low)


def plot_of(curve: Curve) -> Plot:
    """The axes depend on gain and converter only, so that noise and exposure move the points."""
    high_x = 2 * curve.full_dn
    high_y = 10.0 ** math.ceil(math.log10(max(5 * curve.full_dn / curve.gain_e_per_dn, 1.0)))
    return Plot(
        Axis(high_x / 10.0**DECADES, high_x, 56.0, 379.0, log=True),
        Axis(LOWEST_DN2, high_y, 217.0, 26.0, log=True),
    )


def _frame(plot: Plot) -> str:
    means, variances = (log_ticks(axis.low, axis.high, 3) for axis in (plot.x, plot.y))
    small = "muted small"
    return plot.frame(
        Scale("mean", "DN", means, [value for value, _ in means], "", small, centred=True),
        Scale("variance", "DN²", variances, [value for value, _ in variances], "image", small),
    )


def _theory(plot: Plot, curve: Curve) -> Iterator[str]:
    """Floor, shot noise, their sum up to saturation, and the level where all pixels are full."""
    gain, floor_dn2 = curve.gain_e_per_dn, curve.floor_dn2
    full = curve.full_dn - curve.dark_dn
    low, high = plot.x.low, plot.x.high
    means = np.geomspace(low, max(full, low), 60)
    # The straight line starts where it enters the plot.
    start = max(low, LOWEST_DN2 * gain)
    yield line(plot.clamped(start, start / gain), plot.clamped(high, high / gain), "light dashed")
    yield line(plot.clamped(low, floor_dn2), plot.clamped(high, floor_dn2), "error dashed")
    yield plot.curve(means, np.maximum(means / gain + floor_dn2, LOWEST_DN2), "ray bold")
    if full > low:
        yield plot.upright(full, "muted dashed")


def _names(plot: Plot, curve: Curve, chosen: Point, crosses: Sequence[Point]) -> str:
    """Labels of the parts of the theory, where they hide neither the lines nor the chosen patch's;
    and of the crosses of a single frame, next to the highest."""
    gain, floor = curve.gain_e_per_dn, curve.floor_dn2
    low, high = plot.x.low, plot.x.high
    full = max(curve.full_dn - curve.dark_dn, low)
    means = np.geomspace(low, high, 40)
    shot = np.maximum(means / gain, LOWEST_DN2)
    begin = max(low, LOWEST_DN2 * gain)
    middle, *lower = (full * (begin / full) ** share for share in (0.5, 0.65, 0.8))
    labels = [
        Label(plot.clamped(high, floor), "floor", "error small ground", "below left", 6.0),
        Label(plot.clamped(low, floor), "floor + shot noise", "ray small ground", distance=8.0),
        Label(plot.clamped(full, plot.y.high), "full", "muted small ground", "below left", 5.0),
        Label(
            plot.clamped(middle, middle / gain),
            "shot noise: mean / g",
            "light small ground",
            "below right",
            others=[plot.clamped(mean, mean / gain) for mean in lower],
        ),
    ]
    if crosses:
        highest = min(crosses, key=lambda place: place[1])
        labels.append(Label(highest, "one frame", "error small ground", "left", distance=8.0))
    seen: list[Sequence[Point]] = [
        *plot.pieces(means, np.maximum(shot + floor, LOWEST_DN2)),
        *plot.pieces(means, shot),
        [plot.clamped(low, floor), plot.clamped(high, floor)],
        [plot.clamped(full, plot.y.low), plot.clamped(full, plot.y.high)],
        [chosen, (chosen[0], plot.y.start)],
    ]
    inside = Rectangle(plot.x.start + 2, plot.y.end, plot.x.end, plot.y.start - 2)
    return place_labels(labels, inside, seen)
