"""Twenty pixels of one row: the wave, what the filter leaves of it, the samples, the alias."""

import math
from collections.abc import Iterator

import numpy as np

from simulations.engine.drawing import Point, dot, line, path, polyline, rectangle, text
from simulations.models.arrays import Floats
from simulations.models.sampling.prefilters import Prefilter, prefilter, transfer
from simulations.scenes.aliasing.pattern import SHOWN, Pattern

WIDTH, HEIGHT = 400.0, 300.0
LEFT, RIGHT = 22.0, 386.0
MIDDLE, AMPLITUDE = 158.0, 78.0
FINE = 24
"""Points of a curve between two samples."""


def mark(pattern: Pattern) -> str:
    """The frame around the shown pixels, over the picture."""
    unit = WIDTH / pattern.width
    # An even count of rows has its middle between two of them: the upper one is marked.
    row = (pattern.height / 2 - 1) * unit
    corner = (pattern.start * unit + 1.0, row - 2.0)
    size = (SHOWN * unit - 2.0, unit + 4.0)
    return rectangle(corner, *size, "casing") + rectangle(corner, *size, "ray")


def draw(pattern: Pattern, kernel: Prefilter) -> str:
    """SVG markup of the second panel."""
    x = np.linspace(0, SHOWN - 1, FINE * (SHOWN - 1) + 1)
    at = pattern.first + pattern.start
    samples = pattern.wave(kernel, at + np.arange(SHOWN))
    filtered = kernel.weights.size > 1
    true = pattern.wave(prefilter("none"), at + x)
    alias = alias_curve(pattern, kernel, at)
    parts = [*_axis(), _curve(x, true, "world thin faint" if filtered else "world thin")]
    if filtered:
        parts.append(_curve(x, pattern.wave(kernel, at + x), "light thin"))
    if alias is not None:
        parts.append(_curve(x, alias, "error dashed"))
    parts += [dot(_place(n, float(value)), "image", 4.0) for n, value in enumerate(samples)]
    return "".join((*parts, *_legend(filtered, alias is not None)))


def alias_curve(pattern: Pattern, kernel: Prefilter, at: float) -> Floats | None:
    """The slowest wave through the samples, at the places of the curves; None where it is true.

    Between two samples the frequency k that is nearest is taken off. On a sample the phase
    2π k (x − x_sample) is a whole number of turns, so that the pieces meet there.
    """
    x = np.linspace(0, SHOWN - 1, FINE * (SHOWN - 1) + 1)
    between = np.minimum(np.floor(x + 1e-9), SHOWN - 2)
    whole = np.rint(pattern.local_frequency(at + between + 0.5))
    if not whole.any():
        return None
    # exp(-2πi k x) moves the filtered wave's spectrum: exact for pure waves, and for the slow
    # chirp of the zone plate as good as the eye can tell.
    local = pattern.local_frequency(at + x) if pattern.chirp else pattern.base
    phase = pattern.phase_rad + math.pi * (at + x) * (2 * pattern.base + pattern.chirp * (at + x))
    return transfer(kernel, local) * np.sin(phase - 2 * math.pi * whole * x)


def _axis() -> Iterator[str]:
    yield line(_place(0, 0.0), _place(SHOWN - 1, 0.0), "muted thin")
    ticks = [[_place(n, -1.14), _place(n, -1.2)] for n in range(SHOWN)]
    yield path(ticks, "muted thin")
    for n in range(0, SHOWN, 5):
        x, y = _place(n, -1.2)
        yield text((x, y + 16), str(n), "muted small", "middle")
    yield text((RIGHT, HEIGHT - 12), "pixels from the left of the frame", "muted small", "end")


def _curve(x: Floats, wave: Floats, style: str) -> str:
    return polyline([_place(a, b) for a, b in zip(x.tolist(), wave.tolist(), strict=True)], style)


def _legend(filtered: bool, aliased: bool) -> Iterator[str]:
    """One line of signs; what is not drawn is left out, and its place stays empty."""
    y = 22.0
    yield line((LEFT, y - 4.5), (LEFT + 20, y - 4.5), "world")
    yield text((LEFT + 26, y), "wave", "world")
    yield dot((LEFT + 82, y - 4.5), "image", 4.0)
    yield text((LEFT + 92, y), "samples", "image")
    if aliased:
        yield line((LEFT + 160, y - 4.5), (LEFT + 184, y - 4.5), "error dashed")
        yield text((LEFT + 190, y), "alias", "error")
    if filtered:
        yield line((LEFT + 240, y - 4.5), (LEFT + 262, y - 4.5), "light")
        yield text((LEFT + 268, y), "filtered wave", "light")


def _place(n: float, value: float) -> Point:
    return (LEFT + (RIGHT - LEFT) * n / (SHOWN - 1), MIDDLE - AMPLITUDE * value)
