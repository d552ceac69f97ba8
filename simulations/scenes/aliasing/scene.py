"""Sampling and Aliasing: a pattern on a grid of pixels, one row of it, and its spectrum.

Light is 0.5 + 0.5 sin(phase), so that at exactly Nyquist the samples keep |sin φ| of the wave.
Stripes have one frequency everywhere; the rings of the zone plate reach the frequency set at
the left and right edges of the picture.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from simulations.engine.frame import (
    Frame,
    Panel,
    Readout,
    format_magnitude,
    format_number,
    readout,
)
from simulations.engine.scene import Scene
from simulations.engine.settings import choice, slider
from simulations.engine.stages import Outputs
from simulations.models.arrays import Floats, Mask
from simulations.models.error_measures import root_mean_square
from simulations.models.pixel_grid import centred
from simulations.models.sampling.prefilters import prefilter, transfer
from simulations.scenes.aliasing import row, spectrum
from simulations.scenes.aliasing.pattern import PATTERNS, STAGES, Pattern, pattern_of

NYQUIST = 0.5
"""Cycles per pixel, at one sample a pixel."""

GUARD = 0.1
"""Of the zone plate, parts whose frequency is as close to Nyquist as this are not judged."""

FILTERS = {
    "none": "None: a point of each pixel",
    "box": "Box: the pixel's whole area",
    "box-2": "Box, by 2 × 2 points",
    "box-4": "Box, by 4 × 4 points",
    "box-8": "Box, by 8 × 8 points",
    "gaussian": "Gaussian, σ = 0.5 px",
    "sinc": "Windowed sinc, 8 px wide",
}


@dataclass(frozen=True, slots=True)
class Settings:
    """What the reader may change."""

    pattern: str = choice("Pattern", PATTERNS)
    frequency: float = slider("Frequency f", 0.3, 0, 1.2, 0.01, unit="cycles/px")
    phase: float = slider("Phase φ", 90, 0, 360, 5, unit="°")
    prefilter: str = choice("Filter before sampling", FILTERS)


def draw(settings: Settings, outputs: Outputs) -> Frame:
    """The picture, one row of it against the wave, and where the frequency folds to."""
    pattern = pattern_of(settings.pattern, settings.frequency, settings.phase)
    kernel = prefilter(settings.prefilter)
    left = float(transfer(kernel, settings.frequency))
    kept = amplitude_in_samples(pattern, left)
    width, height = row.WIDTH, row.HEIGHT
    return Frame(
        panels=(
            Panel(
                "picture",
                "The sampled picture",
                width,
                height,
                outputs["picture"],
                row.mark(pattern),
                pixelated=True,
            ),
            Panel(
                "row",
                "The marked pixels: the wave and its samples",
                width,
                height,
                overlay=row.draw(pattern, kernel),
            ),
            Panel(
                "spectrum",
                "Where its frequency ends up",
                width,
                height,
                overlay=spectrum.draw(pattern, kernel, kept),
            ),
        ),
        readouts=_readouts(pattern, abs(left), kept),
        description=describe(settings, pattern.alias, abs(left), kept),
    )


def _readouts(pattern: Pattern, passed: float, kept: float) -> tuple[Readout, ...]:
    frequency, alias = pattern.frequency, pattern.alias
    return (
        readout("frequency", "True frequency f", frequency, "cycles/px", role="world"),
        readout("nyquist", "Nyquist frequency", NYQUIST, "cycles/px"),
        readout("alias", "Frequency shown", alias, "cycles/px", role="error"),
        readout("period", "One stripe every", _period(alias), "px", digits=1, role="error"),
        readout("passed", "The filter passes", passed, "of the wave", digits=3, role="light"),
        Readout("kept", "The samples keep", format_number(kept, 3), "of the wave", "image"),
    )


def _period(frequency: float) -> float:
    return 1.0 / frequency if frequency > 0.005 else math.inf


def amplitude_in_samples(pattern: Pattern, left: float) -> float:
    """What the samples hold of the wave's amplitude; exactly at a fold the phase decides.

    At whole numbers of cycles per pixel every sample of the stripes is the same: no wave is
    left. The zone plate has each of its frequencies at one place only, so there is no such
    special case.
    """
    twice = 2.0 * pattern.frequency
    if pattern.kind == "stripes" and math.isclose(twice, round(twice), abs_tol=1e-9):
        odd = round(twice) % 2 == 1
        return abs(left * math.sin(pattern.phase_rad)) if odd else 0.0
    return abs(left)


def describe(settings: Settings, alias: float, passed: float, kept: float) -> str:
    """What the picture shows instead of what, and how strongly."""
    frequency, stripes = settings.frequency, settings.pattern == "stripes"
    what = "Stripes" if stripes else "Rings that at the left and right edges reach"
    true = f"{what} {'of ' if stripes else ''}{format_number(frequency)} cycles per pixel"
    strength = f"{format_number(100 * kept, 0)} % of their amplitude"
    if frequency == 0:
        return (
            f"{what} of no frequency: the picture has the same tone everywhere."
            if stripes
            else "Rings without an end: the whole picture is the centre of the zone plate."
        )
    if stripes and math.isclose(frequency, NYQUIST):
        return (
            f"{true}, exactly at Nyquist: two samples a cycle keep |sin φ| of what the filter "
            f"passes, here {strength} (φ = {format_number(settings.phase, 0)}°)."
        )
    if stripes and alias < 0.005:
        return f"{true}: every sample falls on the same place of the wave, and the picture is flat."
    if frequency <= NYQUIST:
        side = "below Nyquist" if frequency < NYQUIST else "which is Nyquist"
        return f"{true}, {side}: the picture shows them truly, with {strength}."
    where = "" if stripes else " there"
    return (
        f"{true}, above Nyquist: the picture shows false ones of {format_number(alias)} cycles "
        f"per pixel{where} instead, with {format_number(100 * passed, 0)} % of the amplitude."
    )


def ideal(pattern: Pattern) -> tuple[Floats, Mask]:
    """The light (height, width) that pixels can show of a pattern, and where that is certain.

    Waves below Nyquist along both axes as they are, without any filter; even grey in place of
    all others. The pattern is written out here once more, from its definition.
    """
    x = pattern.first + np.arange(pattern.width)
    y = centred(pattern.height)[:, None]
    f = pattern.frequency
    if pattern.kind == "stripes":
        wave = np.sin(pattern.phase_rad + 2 * np.pi * f * (x + 0 * y))
        held = np.full(wave.shape, f < NYQUIST)
        return np.where(held, 0.5 + 0.5 * wave, 0.5), np.ones(wave.shape, bool)
    highest = 2 * f / pattern.width * np.maximum(np.abs(x), np.abs(y))
    wave = np.sin(pattern.phase_rad + 2 * np.pi * f / pattern.width * (x * x + y * y))
    light: Floats = np.where(highest < NYQUIST, 0.5 + 0.5 * wave, 0.5)
    return light, np.abs(highest - NYQUIST) > GUARD


def estimate(settings: Settings, _outputs: Outputs, _tier: str) -> Iterator[Readout]:
    """RMS of what the picture shows too much or too little of; found at once."""
    pattern = pattern_of(settings.pattern, settings.frequency, settings.phase)
    truth, judged = ideal(pattern)
    off = (pattern.picture(prefilter(settings.prefilter)) - truth)[judged]
    text = format_magnitude(root_mean_square(off), 1e-9)
    yield Readout("error", "RMS off what pixels can show", text, "of range", "error")


# The filter is the choice of method, and all its entries are quick: no tiers, no draft.
SCENE = Scene(
    id="aliasing",
    title="Sampling and Aliasing",
    settings=Settings,
    draw=draw,
    stages=STAGES,
    estimate=estimate,
)
