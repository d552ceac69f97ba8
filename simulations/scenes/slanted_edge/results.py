"""What the slanted edge says: readouts, the lines of the data sheet, and files."""

import json
import math
from collections.abc import Iterable, Iterator
from dataclasses import replace

import numpy as np

from simulations.engine.export import Export
from simulations.engine.frame import Readout, format_number, readout
from simulations.engine.photograph import Photograph
from simulations.engine.reading import UnfitError
from simulations.engine.stages import Outputs
from simulations.models.arrays import Floats
from simulations.models.sampling.first_fall import first_fall
from simulations.models.sampling.slanted_edge import FREQUENCIES, EdgeReading
from simulations.models.sensor.resolution import pixel_pitch_um
from simulations.scenes.slanted_edge.rectangle import Box
from simulations.scenes.slanted_edge.settings import Settings
from simulations.scenes.slanted_edge.stages import Place, Sharpness

PER_MM, PER_PX = "cycles/mm", "cycles/px"
NOT_MEASURABLE = "not measurable"


def per_mm(settings: Settings, outputs: Outputs) -> float:
    """Pixels of the picture per millimetre of the sensor."""
    photograph: Photograph | None = outputs["photograph"]
    reduced = 1.0
    if photograph is not None and "full_width" in photograph.facts:
        reduced = float(photograph.facts["full_width"]) / photograph.codes.shape[1]
    return 1000.0 / (settings.pitch * reduced)


def readouts(settings: Settings, outputs: Outputs) -> tuple[Readout, ...]:
    """MTF50 with its error, halos, and where the rectangle is."""
    sharpness: Sharpness = outputs["sharpness"]
    true: Floats = outputs["true"]
    scale = per_mm(settings, outputs)
    known = not np.isnan(true).any()
    middle = off_middle(outputs["box"], outputs)
    formula = scale * first_fall(FREQUENCIES, true, 0.5) if known else math.nan
    return (
        _number("measured", "MTF50, from the edge", scale * sharpness.half.frequency, PER_MM, 1),
        _number("error", "Standard error", scale * sharpness.half.error, PER_MM, 2),
        readout("true", "MTF50, lens × pixel", formula, PER_MM, digits=1, role="ray")
        if known
        else Readout("true", "MTF50, lens × pixel", "unknown", "", "ray"),
        _number("per_px", "MTF50, per pixel", sharpness.half.frequency, PER_PX, 3),
        _number("per_px_error", "Standard error, per pixel", sharpness.half.error, PER_PX, 4),
        _halos(sharpness.reading),
        _slant(sharpness.reading),
        readout("place", "From the middle to the corner", middle, "%", digits=0),
    )


def _number(name: str, label: str, value: float, unit: str, digits: int) -> Readout:
    if np.isnan(value):
        return Readout(name, label, NOT_MEASURABLE, "", "image")
    return readout(name, label, value, unit, digits=digits, role="image")


def _halos(reading: EdgeReading | None) -> Readout:
    if reading is None:
        return Readout("overshoot", "Overshoot", NOT_MEASURABLE)
    size = format_number(100.0 * reading.overshoot, 1)
    if reading.sharpened:
        return Readout("overshoot", "Overshoot", f"{size} %, sharpened", "", "error")
    return Readout("overshoot", "Overshoot", size, "%")


def _slant(reading: EdgeReading | None) -> Readout:
    if reading is None:
        return Readout("slant", "Slant found", NOT_MEASURABLE)
    line = reading.pixels.line
    return readout("slant", "Slant found", math.degrees(line.angle_rad), "°", digits=2)


def off_middle(box: Box, outputs: Outputs) -> float:
    """Distance of a rectangle from the middle of the picture, in % of the half diagonal."""
    height, width = outputs["codes"].shape[:2]
    across, down = 0.5 * (box.left + box.right - width), 0.5 * (box.top + box.bottom - height)
    return 100.0 * math.hypot(across, down) / math.hypot(0.5 * width, 0.5 * height)


def direction(reading: EdgeReading) -> str:
    """Along which the waves run whose contrast was measured."""
    return "columns" if reading.pixels.line.turned else "rows"


def sheet(settings: Settings, outputs: Outputs) -> tuple[Readout, ...]:
    """The lines of the data sheet: of the places that were kept, or else of the rectangle."""
    places: tuple[Place, ...] = outputs["places"] or (Place(outputs["box"], outputs["sharpness"]),)
    found = [place for place in places if place.sharpness.reading is not None]
    lines = [
        line
        for number, place in enumerate(found, 1)
        for line in _lines_of(number, place, settings, outputs)
    ]
    return (*lines, *_pitch_by_file(outputs["photograph"])) if lines else ()


def _lines_of(number: int, place: Place, settings: Settings, outputs: Outputs) -> Iterator[Readout]:
    """MTF50 in both units, and halos if there are any."""
    reading, half, scale = place.sharpness.reading, place.sharpness.half, per_mm(settings, outputs)
    assert reading is not None
    middle = format_number(off_middle(place.box, outputs), 0)
    where = f"{middle} % from the middle to the corner, along the {direction(reading)}"
    yield Readout(
        f"mtf50_{number}", f"MTF50, {where}", with_error(half.frequency, half.error, 4), PER_PX
    )
    yield Readout(
        f"mtf50_mm_{number}",
        f"The same with pixels of {format_number(settings.pitch, 1)} µm",
        with_error(scale * half.frequency, scale * half.error, 1),
        PER_MM,
    )
    if reading.sharpened:
        yield replace(_halos(reading), name=f"overshoot_{number}")


def with_error(value: float, error: float, digits: int) -> str:
    """To ``digits`` decimals, or as many as a smaller error has before its first digit."""
    if 0.0 < error < math.inf:
        digits = max(digits, -math.floor(math.log10(error)))
    return f"{format_number(value, digits)} ± {format_number(error, digits)}"


def _pitch_by_file(photograph: Photograph | None) -> Iterable[Readout]:
    """Of a photograph whose file says the focal length and its full-frame equivalent."""
    names = ("focal_mm", "focal_35mm_mm", "full_width", "full_height")
    facts = {} if photograph is None else photograph.facts
    given = [float(facts[name]) for name in names if name in facts]
    if len(given) == len(names) and min(given) > 0:
        yield readout("pitch", "Pixel pitch by the file", pixel_pitch_um(*given), "µm")


def _csv(head: str, *columns: Floats) -> str:
    rows = zip(*(column.tolist() for column in columns), strict=True)
    return "\n".join((head, *(",".join(f"{value:.6g}" for value in row) for row in rows), ""))


def _reading(outputs: Outputs) -> EdgeReading:
    sharpness: Sharpness = outputs["sharpness"]
    if sharpness.reading is None:
        raise UnfitError(sharpness.refusal)
    return sharpness.reading


def _mtf_file(settings: Settings, outputs: Outputs) -> str:
    reading, scale = _reading(outputs), per_mm(settings, outputs)
    contrast, error = reading.transfer(FREQUENCIES)
    head = "cycles_per_px,cycles_per_mm,contrast,standard_error"
    return _csv(head, FREQUENCIES, scale * FREQUENCIES, contrast, error)


def _esf_file(_settings: Settings, outputs: Outputs) -> str:
    curve = _reading(outputs).curve
    ends = math.floor(4 * curve.reach) - 1
    distance = np.arange(-ends, ends + 1) / 4
    spread, error = curve.spread(distance), curve.spread_error(distance)
    head = "distance_px,light,standard_error,slope_per_px"
    return _csv(head, distance, spread, error, curve.slope(distance))


def _json_file(settings: Settings, outputs: Outputs) -> str:
    _reading(outputs)
    photograph = outputs["photograph"]
    shown = Place(outputs["box"], outputs["sharpness"])
    found = {
        "picture": photograph.name if photograph else "simulated",
        "codes": settings.response,
        "pixel_pitch_um": 1000.0 / per_mm(settings, outputs),
        "rectangle": _facts_of(shown, outputs),
        "kept": [
            _facts_of(place, outputs) for place in outputs["places"] if place.sharpness.reading
        ],
    }
    return json.dumps(found, ensure_ascii=False, indent=1, allow_nan=False)


def _facts_of(place: Place, outputs: Outputs) -> dict[str, object]:
    reading, half, box = place.sharpness.reading, place.sharpness.half, place.box
    assert reading is not None
    return {
        "rectangle_px": [box.left, box.top, box.right, box.bottom],
        "share_from_middle_to_corner": off_middle(box, outputs) / 100.0,
        "waves_along": direction(reading),
        "slant_deg": math.degrees(reading.pixels.line.angle_rad),
        "mtf50_cycles_per_px": half.frequency,
        "mtf50_standard_error": half.error,
        "overshoot": reading.overshoot,
        "sharpened": reading.sharpened,
        "noise_of_step": reading.curve.noise,
    }


EXPORTS: tuple[Export[Settings], ...] = (
    Export("mtf", "MTF, CSV", ".csv", _mtf_file),
    Export("esf", "Light across the edge, CSV", ".csv", _esf_file),
    Export("sharpness", "Results, JSON", ".json", _json_file),
)
