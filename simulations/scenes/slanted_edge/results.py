"""The numbers of the slanted edge: readouts, the lines of the data sheet, and files."""

import json
import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace

import numpy as np

from simulations.engine.export import Export
from simulations.engine.frame import Readout, format_number, readout, value_with_error
from simulations.engine.photograph import Photograph
from simulations.engine.reading import UnfitError
from simulations.engine.stages import Outputs
from simulations.models.arrays import Floats
from simulations.models.sampling.first_fall import first_fall
from simulations.models.sampling.slanted_edge import FREQUENCIES, EdgeReading
from simulations.models.sensor.photon_transfer_file import camera_of
from simulations.scenes.slanted_edge.edge import KeptEdge, Settings, Sharpness, pitch_um

PER_MM, PER_PX = "cycles/mm", "cycles/px"
NOT_MEASURABLE = "not measurable"


def per_mm(settings: Settings) -> float:
    """Pixels per millimetre of the sensor."""
    return 1000.0 / settings.pitch


def readouts(settings: Settings, outputs: Outputs) -> tuple[Readout, ...]:
    """MTF50 with its error, halos, and where the rectangle is."""
    measured: Sharpness = outputs["sharpness"]
    half, reading, scale = measured.half, measured.reading, per_mm(settings)
    true: Floats = outputs["true"]
    formula = math.nan if np.isnan(true).any() else scale * first_fall(FREQUENCIES, true, 0.5)
    slant = math.degrees(reading.pixels.line.angle_rad) if reading else math.nan
    contrast = contrast_of(reading, settings.wave) if reading else math.nan
    found = (
        ("measured", "MTF50, from the edge", scale * half.frequency, PER_MM, 1, "image"),
        ("error", "Standard error", scale * half.error, PER_MM, 2, "image"),
        ("true", "MTF50, lens × pixel", formula, PER_MM, 1, "ray"),
        ("contrast", "Contrast of the wave", contrast, "", 2, "image"),
        ("per_px", "MTF50, per pixel", half.frequency, PER_PX, 3, "image"),
        ("per_px_error", "Standard error, per pixel", half.error, PER_PX, 4, "image"),
        ("slant", "Slant found", slant, "°", 2, ""),
    )
    *numbers, angle = (
        Readout(name, label, "unknown" if name == "true" else NOT_MEASURABLE, "", role=role)
        if np.isnan(value)
        else readout(name, label, value, unit, digits=digits, role=role)
        for name, label, value, unit, digits, role in found
    )
    away = outputs["box"].off_middle
    middle = readout("place", "From the middle to the corner", away, "%", digits=0)
    return (*numbers, overshoot_readout(measured), angle, middle)


def contrast_of(reading: EdgeReading, frequency: float) -> float:
    """The MTF at a frequency in cycles per pixel."""
    return float(reading.transfer([frequency])[0][0])


def overshoot_readout(measured: Sharpness) -> Readout:
    if measured.reading is None:
        return Readout("overshoot", "Overshoot", NOT_MEASURABLE)
    size = format_number(100.0 * measured.reading.overshoot, 1)
    if measured.sharpened:
        return Readout("overshoot", "Overshoot", f"{size} %, sharpened", "", role="error")
    return Readout("overshoot", "Overshoot", size, "%")


def is_by_cells(outputs: Outputs) -> bool:
    """Whether the picture is a raw file, whose colours are measured by their own cells."""
    return outputs["photograph"] is not None and outputs["photograph"].mosaic is not None


def direction(reading: EdgeReading) -> str:
    """The direction of the waves whose contrast was measured."""
    return "columns" if reading.pixels.line.turned else "rows"


def sheet(settings: Settings, outputs: Outputs) -> tuple[Readout, ...]:
    """The lines of the data sheet: of the places that were kept, or else of the rectangle.

    A pixel pitch that nobody set is that of the file, if it says one.
    """
    photograph = outputs["photograph"]
    by_file = pitch_um(photograph)
    if by_file and settings.pitch == Settings().pitch:
        settings = replace(settings, pitch=by_file)
    shown = KeptEdge(outputs["box"], outputs["sharpness"])
    places: tuple[KeptEdge, ...] = outputs["places"] or (shown,)
    found = [place for place in places if place.sharpness.reading is not None]
    lines = [
        line
        for number, place in enumerate(found, 1)
        for line in lines_of(number, place, settings, outputs)
    ]
    taken = (*taken_with(photograph), *pitch_by_file(photograph))
    return (*lines[:2], *taken, *lines[2:]) if lines else ()


def lines_of(
    number: int, place: KeptEdge, settings: Settings, outputs: Outputs
) -> Iterator[Readout]:
    """MTF50 in both units, and halos if there are any."""
    reading, half, scale = place.sharpness.reading, place.sharpness.half, per_mm(settings)
    assert reading is not None
    middle = format_number(place.box.off_middle, 0)
    where = f"{middle} % of the way from the middle to the corner"
    of = " of the green cells" if is_by_cells(outputs) else ""
    label = f"MTF50{of}, {where}, along the {direction(reading)}"
    value = value_with_error(half.frequency, half.error)
    yield Readout(f"mtf50_{number}", label, value, PER_PX)
    label = f"The same with pixels of {format_number(settings.pitch, 2)} µm"
    value = value_with_error(scale * half.frequency, scale * half.error)
    yield Readout(f"mtf50_mm_{number}", label, value, PER_MM)
    if place.sharpness.tone:
        dark, light = reading.pixels.levels
        apart = format_number(light / max(dark, 1e-3), 1)
        words = format_number(100.0 * place.sharpness.tone / half.frequency, 1)
        known = "found by exposures" if outputs["tone"].strength else "unknown"
        label = f"Of its error, the tone curve, {known}, with an edge of {apart} : 1"
        yield Readout(f"tone_{number}", label, words, "%")
    if place.sharpness.unseen:
        words = format_number(100.0 * place.sharpness.unseen / half.frequency, 0)
        label = "Of its error, sharpening that would not show"
        yield Readout(f"unseen_{number}", label, words, "%")
    if place.sharpness.colour:
        words = format_number(100.0 * place.sharpness.colour / half.frequency, 1)
        yield Readout(f"colour_{number}", "Of its error, how much the colours differ", words, "%")
    if place.sharpness.sharpened:
        yield replace(overshoot_readout(place.sharpness), name=f"overshoot_{number}")
    yield from colours(number, place.sharpness.channels)


def colours(number: int, each: Sequence[EdgeReading]) -> Iterator[Readout]:
    """MTF50 of each channel, and how far red and blue are off green; none for a grey file."""
    if not each:
        return
    halves = [one.half_contrast() for one in each]
    words = "; ".join(value_with_error(half.frequency, half.error) for half in halves)
    yield Readout(f"channels_{number}", "MTF50 of red; green; blue, ± noise", words, PER_PX)
    (red, by_red), (green, by_green), (blue, by_blue) = (one.curve.middle for one in each)
    words = "; ".join(
        value_with_error(off - green, math.hypot(error, by_green))
        for off, error in ((red, by_red), (blue, by_blue))
    )
    label = "Lateral colour: red; blue off green, towards the light side"
    yield Readout(f"lateral_{number}", label, words, "px")


def taken_with(photograph: Photograph | None) -> Iterator[Readout]:
    """Camera, lens and how it was set, by the file."""
    facts = {} if photograph is None else photograph.facts
    camera, lens = camera_of(facts), [str(facts["lens"])] if "lens" in facts else []
    units = (("f_number", "f/{:g}"), ("focal_mm", "{:g} mm"))
    words = [*filter(None, [camera]), *lens]
    words += [form.format(facts[name]) for name, form in units if name in facts]
    if words:
        yield Readout("taken", "Taken with", ", ".join(words))


def pitch_by_file(photograph: Photograph | None) -> Iterable[Readout]:
    pitch = pitch_um(photograph)
    if pitch is not None:
        yield readout("pitch", "Pixel pitch by the file", pitch, "µm")


def csv(head: str, *columns: Floats) -> str:
    rows = zip(*(column.tolist() for column in columns), strict=True)
    return "\n".join((head, *(",".join(f"{value:.6g}" for value in row) for row in rows), ""))


def reading_of(outputs: Outputs) -> EdgeReading:
    measured: Sharpness = outputs["sharpness"]
    if measured.reading is None:
        raise UnfitError(measured.refusal)
    return measured.reading


def mtf_file(settings: Settings, outputs: Outputs) -> str:
    reading, scale = reading_of(outputs), per_mm(settings)
    head = "cycles_per_px,cycles_per_mm,contrast,standard_error_by_noise"
    return csv(head, FREQUENCIES, scale * FREQUENCIES, *reading.transfer(FREQUENCIES))


def esf_file(_settings: Settings, outputs: Outputs) -> str:
    curve = reading_of(outputs).curve
    ends = math.floor(4 * curve.reach) - 1
    distance = np.arange(-ends, ends + 1) / 4
    spread, error = curve.spread(distance), curve.spread_error(distance)
    head = "distance_px,light,standard_error,slope_per_px"
    return csv(head, distance, spread, error, curve.slope(distance))


def json_file(settings: Settings, outputs: Outputs) -> str:
    reading_of(outputs)
    photograph = outputs["photograph"]
    shown = KeptEdge(outputs["box"], outputs["sharpness"])
    measured_places = [place for place in outputs["places"] if place.sharpness.reading]
    found = {
        "picture": photograph.name if photograph else "simulated",
        "codes": settings.response,
        "pixel_pitch_um": 1000.0 / per_mm(settings),
        "rectangle": facts_of(shown, outputs),
        "kept": [facts_of(place, outputs) for place in measured_places],
    }
    return json.dumps(found, ensure_ascii=False, indent=1, allow_nan=False)


def facts_of(place: KeptEdge, outputs: Outputs) -> dict[str, object]:
    reading, half, box = place.sharpness.reading, place.sharpness.half, place.box
    assert reading is not None
    return {
        "rectangle_px": [box.left, box.top, box.right, box.bottom],
        "share_from_middle_to_corner": box.off_middle / 100.0,
        "waves_along": direction(reading),
        "slant_deg": math.degrees(reading.pixels.line.angle_rad),
        "mtf50_cycles_per_px": half.frequency if math.isfinite(half.frequency) else None,
        "mtf50_standard_error": half.error if math.isfinite(half.error) else None,
        "measured_of": "green cells" if is_by_cells(outputs) else "luminance",
        "overshoot": reading.overshoot,
        "of_which_tone_curve": place.sharpness.tone,
        "of_which_colours": place.sharpness.colour,
        "of_which_unseen_sharpening": place.sharpness.unseen,
        "sharpened": place.sharpness.sharpened,
        "noise_of_step": reading.curve.noise,
    }


EXPORTS: tuple[Export[Settings], ...] = (
    Export("mtf", "MTF, CSV", ".csv", mtf_file),
    Export("esf", "Light across the edge, CSV", ".csv", esf_file),
    Export("sharpness", "Results, JSON", ".json", json_file),
)
