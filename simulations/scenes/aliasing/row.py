"""Twenty pixels of one row: the wave, the filtered wave, the samples and the alias."""

import math
from collections.abc import Iterator

import numpy as np

from simulations.engine.drawing import Point, circle, dot, rectangle, text
from simulations.engine.plotting.axis import Axis
from simulations.engine.plotting.legend import Entry, legend
from simulations.engine.plotting.plot import Plot
from simulations.engine.plotting.scale import Scale
from simulations.models.arrays import Floats
from simulations.models.sampling.prefilters import Prefilter, prefilter, transfer
from simulations.scenes.aliasing.own import FIRST, Own
from simulations.scenes.aliasing.pattern import SHOWN, Pattern, samples_shown

WIDTH, HEIGHT = 400.0, 300.0
PLOT = Plot(Axis(0.0, SHOWN - 1.0, 22.0, 386.0), Axis(-1.15, 1.15, 248.0, 68.0))
PIXELS = Scale(
    "pixels from the left of the frame",
    ticks=[(n, "" if n % 5 else str(n)) for n in range(SHOWN)],
    style="muted small",
    tick_style="muted small",
)
FINE = 24
"""Points of a curve per pixel."""


def mark(pattern: Pattern) -> str:
    """The frame around the shown samples, over the picture."""
    unit = WIDTH / pattern.width
    # The middle of an even count of rows is between two of them: the upper one is marked.
    row = (pattern.height - 1) // 2
    return _frame(pattern.start * unit, row * unit, samples_shown(pattern.rate) * unit, unit)


def mark_own(own: Own, rate: float) -> str:
    """The frame around the pixels of the reader's picture that are shown."""
    unit = WIDTH / own.linear.shape[1]
    return _frame(FIRST * rate * unit, own.row * unit, SHOWN * rate * unit, unit)


def _frame(left: float, top: float, width: float, height: float) -> str:
    corner, size = (left + 1.0, top - 2.0), (width - 2.0, height + 4.0)
    return rectangle(corner, *size, "casing") + rectangle(corner, *size, "ray")


def nyquist_ring(pattern: Pattern) -> str:
    """The ring of the zone plate at the Nyquist frequency, if there is one."""
    place = ring(pattern)
    if place is None:
        return ""
    middle, radius = (WIDTH / 2, HEIGHT / 2), WIDTH / 2 - place[0]
    circles = (circle(middle, radius, f"{style} dashed") for style in ("casing", "camera"))
    label = text((place[0] + 12, place[1] + 4), "Nyquist", "camera ground small")
    return "".join((*circles, dot(place, "camera", 5), label))


def ring(pattern: Pattern) -> tuple[float, float] | None:
    """The leftmost point of that ring."""
    # Half a cycle per sample is at a quarter of the width, over the frequency, from the middle.
    radius = WIDTH / 4 / pattern.frequency if pattern.frequency else math.inf
    return (WIDTH / 2 - radius, HEIGHT / 2) if radius <= WIDTH / 2 else None


def frequency_of_ring(place: Point, rate: float) -> float:
    """Frequency of the plate's edge, in cycles per pixel, for which the Nyquist ring starts at a
    place."""
    radius = WIDTH / 2 - float(place[0])
    return rate * WIDTH / 4 / radius if radius > 0 else math.inf


def draw(pattern: Pattern, kernel: Prefilter) -> str:
    """SVG markup of the second panel."""
    x = _fine(pattern.rate)
    at = pattern.first + pattern.start
    samples = np.arange(samples_shown(pattern.rate))
    filtered = kernel.weights.size > 1
    behind = pattern.wave(kernel, at + x) if filtered else None
    alias = alias_curve(pattern, kernel, at)
    parts = [
        *_curves(x / pattern.rate, pattern.wave(prefilter("none"), at + x), behind, alias),
        *_dots(samples / pattern.rate, pattern.wave(kernel, at + samples)),
        dot(knob, "world", 5) if (knob := crest(pattern)) else "",
    ]
    return "".join((*parts, _legend(filtered, alias is not None)))


def draw_own(own: Own, filtered: bool) -> str:
    """SVG markup of the second panel for the reader's picture."""
    x = np.linspace(0, SHOWN - 1, own.curve.size)
    behind = 2 * own.filtered - 1 if filtered else None
    parts = [*_curves(x, 2 * own.curve - 1, behind, None), *_dots(own.places, 2 * own.samples - 1)]
    return "".join((*parts, _legend(filtered, aliased=False, name="light")))


def crest(pattern: Pattern) -> tuple[float, float] | None:
    """The second crest of the stripes, if it is on the panel."""
    if pattern.kind != "stripes" or pattern.frequency == 0.0:
        return None
    pixels = crest_turns(pattern.phase_rad) / (pattern.frequency * pattern.rate)
    return PLOT.at(pixels, 1.0) if pixels <= SHOWN - 1 else None


def crest_turns(phase_rad: float) -> float:
    """Cycles of that crest from the left of the panel."""
    return 1.25 - phase_rad / (2 * math.pi)


def pixels_at(place: Point) -> float:
    """Distance of a place from the left of the panel, in pixels."""
    return PLOT.values(place)[0]


def _fine(rate: float) -> Floats:
    """Places of the curves, in samples."""
    return np.linspace(0, SHOWN - 1, FINE * (SHOWN - 1) + 1) * rate


def _curves(
    x: Floats, wave: Floats, filtered: Floats | None, alias: Floats | None
) -> Iterator[str]:
    """``x`` in pixels."""
    yield PLOT.level(0.0, "muted thin")
    yield PLOT.x_axis(PIXELS)
    yield PLOT.curve(x, wave, "world thin" if filtered is None else "world thin faint")
    if filtered is not None:
        yield PLOT.curve(x, filtered, "light thin")
    if alias is not None:
        yield PLOT.curve(x, alias, "error dashed")


def _dots(x: Floats, samples: Floats) -> Iterator[str]:
    for place, value in zip(x.tolist(), samples.tolist(), strict=True):
        yield dot(PLOT.at(place, value), "image", 4.0)


def alias_curve(pattern: Pattern, kernel: Prefilter, at: float) -> Floats | None:
    """The slowest wave through the samples, at the places of the curves; None if it is the true
    wave.

    Between two samples the nearest whole frequency k is subtracted. At a sample the phase 2π k (x −
    x_sample) is a whole number of turns, so that the pieces meet there.
    """
    x = _fine(pattern.rate)
    between = np.minimum(np.floor(x + 1e-9), math.ceil(x[-1] - 1e-9) - 1)
    whole = np.rint(pattern.local_frequency(at + between + 0.5))
    if not whole.any():
        return None
    # exp(-2πi k x) moves the filtered wave's spectrum: exact for pure waves, and accurate enough
    # for the slow chirp of the zone plate.
    local = pattern.local_frequency(at + x) if pattern.chirp else pattern.base
    phase = pattern.phase_rad + math.pi * (at + x) * (2 * pattern.base + pattern.chirp * (at + x))
    return transfer(kernel, local) * np.sin(phase - 2 * math.pi * whole * x)


def _legend(filtered: bool, aliased: bool, name: str = "wave") -> str:
    """The legend in one line; the places of curves that are not drawn stay empty."""
    entries = (
        Entry(name, "world"),
        Entry("samples", "image", "dot"),
        Entry("alias", "error dashed", shown=aliased),
        Entry(f"filtered {name}", "light", shown=filtered),
    )
    return legend((PLOT.x.start, 22.0), entries, room=PLOT.x.end - PLOT.x.start)
