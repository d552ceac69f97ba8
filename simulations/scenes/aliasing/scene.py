"""Sampling and Aliasing: a shirt or a pattern on a grid of pixels, one row of it, and its spectrum.

Light is 0.5 + 0.5 sin(phase), so that at exactly Nyquist the samples have |sin φ| of the amplitude.
The shirt's stripes have one frequency on its chest, of which the numbers are; the rings of the zone
plate reach the frequency set at the left and right edges of the picture. The filter is the choice
of method, and all are fast: no tiers.
"""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from simulations.engine.accuracy import Accuracy
from simulations.engine.controls import Value
from simulations.engine.frame import (
    Frame,
    Panel,
    Raster,
    Readout,
    Sound,
    format_magnitude,
    format_number,
    readout,
)
from simulations.engine.handles import Handle, Point
from simulations.engine.instrument import Instrument
from simulations.engine.raster import opaque
from simulations.engine.scene import Scene
from simulations.engine.settings import action, choice, slider
from simulations.engine.stages import Outputs, Stage
from simulations.models.color.srgb import encode_srgb_codes
from simulations.models.error_measures import root_mean_square
from simulations.models.sampling import prefilters
from simulations.models.sampling.aliasing import alias_frequency
from simulations.scenes.aliasing import drawing, light
from simulations.scenes.aliasing.light import NYQUIST, Pattern, SampledPhotograph, pattern_of
from simulations.scenes.aliasing.shirt import shirt_light

PATTERNS = {"stripes": "Striped shirt", "zone_plate": "Zone plate"}
FILTERS = {
    "none": "None: a point of each pixel",
    "box": "Box: the pixel's whole area",
    "gaussian": "Gaussian, σ = 0.5 px",
    "sinc": "Windowed sinc, 8 px wide",
}
SIZE = drawing.WIDTH, drawing.HEIGHT
UNITS_PER_PIXEL = drawing.WIDTH / light.SIZE_PX[0]
SOUND_HZ, SOUND_S, PIXELS_PER_S = 8000, 8, 4000  # 0.3 cycles/px is heard as 1200 Hz


@dataclass(frozen=True, slots=True)
class Settings:
    pattern: str = choice("Pattern", PATTERNS)
    frequency: float = slider("Frequency f", 0.3, 0, 1.2, 0.01, unit="cycles/px")
    phase: float = slider("Phase φ", 90, 0, 360, 5, unit="°")
    prefilter: str = choice("Filter before sampling", FILTERS)
    rate: float = slider("Sampling rate", 1, 0.5, 2, 0.05, unit="samples/px")
    sweep: int = action(
        "Sweep the frequency", "Pause", drives="frequency", effect="play", seconds=16.0
    )


def pattern_at(settings: Settings) -> Pattern:
    return pattern_of(settings.pattern, settings.frequency, settings.phase, settings.rate)


def picture(
    photograph: SampledPhotograph | None,
    pattern: str,
    frequency: float,
    phase: float,
    prefilter: str,
    rate: float,
) -> Raster:
    """The sampled picture."""
    if photograph:
        return photograph.raster
    sampled, kernel = pattern_of(pattern, frequency, phase, rate), prefilters.prefilter(prefilter)
    linear = shirt_light(sampled, kernel) if pattern == "stripes" else sampled.picture(kernel)
    return opaque(encode_srgb_codes(linear))


def draw(settings: Settings, outputs: Outputs) -> Frame:
    photograph: SampledPhotograph | None = outputs["own picture"]
    pattern, kernel = pattern_at(settings), prefilters.prefilter(settings.prefilter)
    left = float(prefilters.transfer(kernel, pattern.frequency))
    passed = abs(left)
    if photograph:
        remaining, words = passed, describe_photograph(settings, pattern, passed)
        over = drawing.pixel_frame(photograph, pattern.rate)
        row = drawing.photograph_row(photograph, kernel.weights.size > 1)
    else:
        remaining = amplitude_in_samples(pattern, left)
        words = describe(settings, pattern, passed, remaining)
        ring = drawing.nyquist_ring(pattern) if pattern.kind == "zone_plate" else ""
        over, row = ring + drawing.sample_frame(pattern), drawing.row_of(pattern, kernel)
    title = f"The framed {'light' if photograph else 'wave'} and its samples"
    fold, raster = drawing.spectrum(pattern, kernel, remaining, photograph), outputs["picture"]
    alias, nyquist = pattern.alias * pattern.rate, NYQUIST * pattern.rate
    period = 1.0 / alias if alias > 0.005 else math.inf
    return Frame(
        (
            Panel(
                "picture",
                "The picture, pixel by pixel",
                *SIZE,
                raster,
                overlay=over,
                pixelated=True,
                lead=True,
            ),
            Panel("row", title, *SIZE, overlay=row),
            Panel("spectrum", "The frequency, folded at Nyquist", *SIZE, overlay=fold),
        ),
        (
            readout("alias", "Frequency shown", alias, "cycles/px", role="error"),
            readout("nyquist", "Nyquist frequency", nyquist, "cycles/px", role="camera"),
            readout("period", "One stripe every", period, "px", digits=1, role="error"),
            readout("passed", "The filter passes", passed, "of the wave", digits=3, role="light"),
            readout("kept", "The samples keep", remaining, "of the wave", digits=3, role="image"),
        ),
        words,
        sound=None if photograph else tone(pattern, remaining),
    )


def tone(pattern: Pattern, remaining: float) -> Sound:
    """The wave that the samples show, as it is heard where a row of pixels passes by."""
    turns = 2 * np.pi * pattern.alias * pattern.rate * PIXELS_PER_S / SOUND_HZ
    wave = np.sin(turns * np.arange(SOUND_HZ * SOUND_S))
    return Sound((0.3 * min(remaining, 1.0) * wave).astype(np.float32), SOUND_HZ)


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
    subject = "A shirt's stripes" if stripes else "Rings that at the left and right edges reach"
    true = f"{subject} {'of ' if stripes else ''}{format_number(frequency)} cycles per pixel"
    if settings.rate != 1:
        true += f" at {rate_in_words(settings)}"
    strength = f"{format_number(100 * remaining, 0)} % of their amplitude"
    if frequency == 0:
        return (
            f"{subject} of no frequency: the picture has the same tone everywhere."
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


def describe_photograph(settings: Settings, pattern: Pattern, passed: float) -> str:
    """The description for a reader's picture."""
    nyquist, alias = NYQUIST * pattern.rate, pattern.alias * pattern.rate
    sampled = (
        f"Your own picture at {rate_in_words(settings)}: detail of more than "
        f"{format_number(nyquist)} cycles per pixel appears as coarser detail. "
        f"A wave of {format_number(settings.frequency)}"
    )
    strength = f"with {format_number(100 * passed, 0)} % of its amplitude"
    if pattern.frequency <= NYQUIST:
        return f"{sampled} is shown truly, {strength}."
    return f"{sampled} is shown as one of {format_number(alias)}, {strength}."


def rate_in_words(settings: Settings) -> str:
    rate = format_number(settings.rate)
    return f"{rate} samples a pixel" if settings.rate != 1 else "one sample a pixel"


def estimate(settings: Settings, outputs: Outputs, _tier: str) -> Iterator[Readout]:
    """RMS difference from the ideal picture, in one step."""
    photograph: SampledPhotograph | None = outputs["own picture"]
    if photograph:
        off = photograph.linear - light.ideal_photograph(outputs["photograph"], settings.rate)
    else:
        pattern = pattern_at(settings)
        truth, certain = light.ideal(pattern)
        off = (pattern.picture(prefilters.prefilter(settings.prefilter)) - truth)[certain]
    text = format_magnitude(root_mean_square(off), 1e-9)
    yield Readout("error", "RMS off what pixels can show", text, "of range", role="error")


def crest_at(settings: Settings, outputs: Outputs) -> Point | None:
    return None if outputs["photograph"] else drawing.crest(pattern_at(settings))


def crest_pulled(settings: Settings, place: Point) -> Mapping[str, Value]:
    pixels = drawing.ROW.values(place)[0]
    turns = drawing.crest_turns(math.radians(settings.phase))
    return {"frequency": turns / pixels if pixels > 0 else math.inf}


def stripes_at(settings: Settings, outputs: Outputs) -> Point | None:
    """A zero crossing of the wave, which moves left as the phase grows."""
    if outputs["photograph"] or settings.pattern != "stripes" or settings.frequency == 0:
        return None
    pixels = light.FRAMED_AT - settings.phase / 360 / settings.frequency
    return (pixels * UNITS_PER_PIXEL, 0.0)


def stripes_pulled(settings: Settings, place: Point) -> Mapping[str, Value]:
    phase = 360 * settings.frequency * (light.FRAMED_AT - place[0] / UNITS_PER_PIXEL)
    return {"phase": phase if -1e-6 <= phase <= 360 + 1e-6 else phase % 360}


def ring_at(settings: Settings, outputs: Outputs) -> Point | None:
    """The leftmost point of the ring, if it is in the picture."""
    if outputs["photograph"] or settings.pattern != "zone_plate":
        return None
    return drawing.ring(pattern_at(settings))


def ring_pulled(settings: Settings, place: Point) -> Mapping[str, Value]:
    radius = drawing.WIDTH / 2 - float(place[0])
    ratio = settings.rate * drawing.WIDTH / 4
    return {"frequency": ratio / radius if radius > 0 else math.inf}


def wave_at(settings: Settings, _outputs: Outputs) -> Point:
    return drawing.SPECTRUM.at(settings.frequency, 1.0)


def fold_at(settings: Settings, _outputs: Outputs) -> Point:
    return drawing.SPECTRUM.at(NYQUIST * settings.rate, 0.0)


F = ("frequency",)
# The pulls save a search that would sample a picture for each frequency.
HANDLES: tuple[Handle[Settings], ...] = (
    Handle("frequency", "spectrum", "Frequency", F, wave_at, reach="press", role="world"),
    Handle(
        "crest", "row", "Crest of the wave", F, crest_at, crest_pulled, role="world", reversed=F
    ),
    Handle(
        "stripes",
        "picture",
        "Stripes",
        drives=("phase",),
        at=stripes_at,
        pull=stripes_pulled,
        reach="drag",
        reversed=("phase",),
    ),
    Handle("ring", "picture", "Ring at Nyquist", F, ring_at, ring_pulled, role="camera"),
    Handle("nyquist", "spectrum", "Limit at Nyquist", ("rate",), fold_at, role="camera"),
)
SCENE = Scene(
    "aliasing",
    "Sampling and Aliasing",
    Settings,
    draw,
    (
        Stage("own light", light.photograph_light),
        Stage("own picture", light.sample_photograph, ("own light",)),
        Stage("picture", picture, ("own picture",)),
    ),
    HANDLES,
    instrument=Instrument(photograph=light.PHOTOGRAPH_PX),
    accuracy=Accuracy(estimate=estimate),
    formula=alias_frequency,
)
