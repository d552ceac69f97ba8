"""Sampling and Aliasing: a pattern on a grid of pixels, one row of it, and its spectrum.

Light is 0.5 + 0.5 sin(phase), so that at exactly Nyquist the samples have |sin φ| of the amplitude.
Stripes have one frequency everywhere; the rings of the zone plate reach the frequency set at the
left and right edges of the picture.
"""

import math
from collections.abc import Iterator

import numpy as np

from simulations.engine.frame import (
    Frame,
    Panel,
    Raster,
    Readout,
    format_magnitude,
    format_number,
    readout,
)
from simulations.engine.scene import Scene
from simulations.engine.stages import Outputs
from simulations.models.arrays import Floats, Mask
from simulations.models.error_measures import root_mean_square
from simulations.models.pixel_grid import centred
from simulations.models.sampling.aliasing import alias_frequency
from simulations.models.sampling.prefilters import Prefilter, prefilter, transfer
from simulations.scenes.aliasing import row, spectrum
from simulations.scenes.aliasing.handles import HANDLES
from simulations.scenes.aliasing.own import PHOTOGRAPH_PX, Own, ideal_own
from simulations.scenes.aliasing.pattern import STAGES, Pattern, pattern_of
from simulations.scenes.aliasing.settings import Settings

NYQUIST = 0.5
"""Cycles per sample."""

GUARD = 0.1
"""Parts of the zone plate whose frequency is this close to Nyquist are left out of the error."""


def draw(settings: Settings, outputs: Outputs) -> Frame:
    """The picture, one row of it with the wave, and the folded frequency."""
    own: Own | None = outputs["own picture"]
    pattern = pattern_of(settings.pattern, settings.frequency, settings.phase, settings.rate)
    kernel = prefilter(settings.prefilter)
    left = float(transfer(kernel, pattern.frequency))
    remaining = abs(left) if own else amplitude_in_samples(pattern, left)
    wave = "light" if own else "wave"
    over_picture, over_row = _overlays(pattern, kernel, own)
    return Frame(
        panels=(
            _panel("picture", "The picture, pixel by pixel", over_picture, outputs["picture"]),
            _panel("row", f"The framed pixels: the {wave} and its samples", over_row),
            _panel(
                "spectrum",
                "The frequency, folded at Nyquist",
                spectrum.draw(pattern, kernel, remaining, own),
            ),
        ),
        readouts=_readouts(pattern, abs(left), remaining),
        description=(
            describe_own(settings, pattern, abs(left))
            if own
            else describe(settings, pattern, abs(left), remaining)
        ),
    )


def _overlays(pattern: Pattern, kernel: Prefilter, own: Own | None) -> tuple[str, str]:
    """Over the picture, and of the row."""
    if own:
        return row.mark_own(own, pattern.rate), row.draw_own(own, kernel.weights.size > 1)
    ring = row.nyquist_ring(pattern) if pattern.kind == "zone_plate" else ""
    return ring + row.mark(pattern), row.draw(pattern, kernel)


def _panel(name: str, title: str, overlay: str, raster: Raster | None = None) -> Panel:
    is_picture = raster is not None
    return Panel(name, title, row.WIDTH, row.HEIGHT, raster, overlay, is_picture, lead=is_picture)


def _readouts(pattern: Pattern, passed: float, remaining: float) -> tuple[Readout, ...]:
    alias, nyquist = pattern.alias * pattern.rate, NYQUIST * pattern.rate
    return (
        readout("alias", "Frequency shown", alias, "cycles/px", role="error"),
        readout("nyquist", "Nyquist frequency", nyquist, "cycles/px", role="camera"),
        readout("period", "One stripe every", _period(alias), "px", digits=1, role="error"),
        readout("passed", "The filter passes", passed, "of the wave", digits=3, role="light"),
        Readout("kept", "The samples keep", format_number(remaining, 3), "of the wave", "image"),
    )


def _period(frequency: float) -> float:
    return 1.0 / frequency if frequency > 0.005 else math.inf


def amplitude_in_samples(pattern: Pattern, left: float) -> float:
    """The amplitude of the wave in the samples; exactly at a fold it depends on the phase.

    At whole numbers of cycles per pixel all samples of the stripes are equal: no wave is left. The
    zone plate has each frequency at one place only, so it needs no such special case.
    """
    twice = 2.0 * pattern.frequency
    if pattern.kind == "stripes" and math.isclose(twice, round(twice), abs_tol=1e-9):
        odd = round(twice) % 2 == 1
        return abs(left * math.sin(pattern.phase_rad)) if odd else 0.0
    return abs(left)


def describe(settings: Settings, pattern: Pattern, passed: float, remaining: float) -> str:
    """The true and the apparent wave, and its amplitude."""
    frequency, stripes = settings.frequency, settings.pattern == "stripes"
    alias = pattern.alias * pattern.rate
    what = "Stripes" if stripes else "Rings that at the left and right edges reach"
    true = f"{what} {'of ' if stripes else ''}{format_number(frequency)} cycles per pixel"
    if settings.rate != 1:
        true += f" at {_rate(settings)}"
    strength = f"{format_number(100 * remaining, 0)} % of their amplitude"
    if frequency == 0:
        return (
            f"{what} of no frequency: the picture has the same tone everywhere."
            if stripes
            else "Rings without an end: the whole picture is the centre of the zone plate."
        )
    if stripes and math.isclose(pattern.frequency, NYQUIST):
        return (
            f"{true}, exactly at Nyquist: two samples a cycle keep |sin φ| of what the filter "
            f"passes, here {strength} (φ = {format_number(settings.phase, 0)}°)."
        )
    if stripes and alias < 0.005:
        return f"{true}: every sample falls on the same place of the wave, and the picture is flat."
    if pattern.frequency <= NYQUIST:
        side = "below Nyquist" if pattern.frequency < NYQUIST else "which is Nyquist"
        return f"{true}, {side}: the picture shows them truly, with {strength}."
    where = "" if stripes else " there"
    return (
        f"{true}, above Nyquist: the picture shows false ones of {format_number(alias)} cycles "
        f"per pixel{where} instead, with {format_number(100 * passed, 0)} % of the amplitude."
    )


def describe_own(settings: Settings, pattern: Pattern, passed: float) -> str:
    """The description for a reader's picture."""
    nyquist, alias = NYQUIST * pattern.rate, pattern.alias * pattern.rate
    sampled = (
        f"Your own picture at {_rate(settings)}: detail of more than {format_number(nyquist)} "
        f"cycles per pixel appears as coarser detail. A wave of {format_number(settings.frequency)}"
    )
    strength = f"with {format_number(100 * passed, 0)} % of its amplitude"
    if pattern.frequency <= NYQUIST:
        return f"{sampled} is shown truly, {strength}."
    return f"{sampled} is shown as one of {format_number(alias)}, {strength}."


def _rate(settings: Settings) -> str:
    rate = format_number(settings.rate)
    return f"{rate} samples a pixel" if settings.rate != 1 else "one sample a pixel"


def ideal(pattern: Pattern) -> tuple[Floats, Mask]:
    """The ideal picture (height, width) of a pattern, and where it is certain.

    Waves below Nyquist along both axes are unfiltered; all others are even grey. The pattern is
    computed again here, from its definition.
    """
    x = pattern.first + np.arange(pattern.width)
    y = centred(pattern.height)[:, None]
    f = pattern.frequency
    if pattern.kind == "stripes":
        wave = np.sin(pattern.phase_rad + 2 * np.pi * f * (x + 0 * y))
        resolved = np.full(wave.shape, f < NYQUIST)
        return np.where(resolved, 0.5 + 0.5 * wave, 0.5), np.ones(wave.shape, bool)
    highest = 2 * f / pattern.width * np.maximum(np.abs(x), np.abs(y))
    wave = np.sin(pattern.phase_rad + 2 * np.pi * f / pattern.width * (x * x + y * y))
    light: Floats = np.where(highest < NYQUIST, 0.5 + 0.5 * wave, 0.5)
    return light, np.abs(highest - NYQUIST) > GUARD


def estimate(settings: Settings, outputs: Outputs, _tier: str) -> Iterator[Readout]:
    """RMS difference from the ideal picture, in one step."""
    own: Own | None = outputs["own picture"]
    if own:
        off = own.linear - ideal_own(outputs["photograph"], settings.rate)
    else:
        pattern = pattern_of(settings.pattern, settings.frequency, settings.phase, settings.rate)
        truth, certain = ideal(pattern)
        off = (pattern.picture(prefilter(settings.prefilter)) - truth)[certain]
    text = format_magnitude(root_mean_square(off), 1e-9)
    yield Readout("error", "RMS off what pixels can show", text, "of range", "error")


# The filter is the choice of method, and all are fast: no tiers, no draft.
SCENE = Scene(
    id="aliasing",
    title="Sampling and Aliasing",
    settings=Settings,
    draw=draw,
    formula=alias_frequency,
    stages=STAGES,
    handles=HANDLES,
    photograph=PHOTOGRAPH_PX,
    estimate=estimate,
)
