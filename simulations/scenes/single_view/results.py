"""What was measured: readouts, the data sheet, and the file."""

import json
import math

import numpy as np

from simulations.engine.frame import Readout, format_number
from simulations.engine.photograph import Photograph
from simulations.engine.stages import Outputs
from simulations.models.projection.pinhole import field_of_view_rad
from simulations.models.projection.single_view import SingleView
from simulations.models.projection.vanishing_lines import pixel_of
from simulations.scenes.single_view.drawing import with_error
from simulations.scenes.single_view.lines import Drawn
from simulations.scenes.single_view.room import FOCAL_PX
from simulations.scenes.single_view.settings import Settings
from simulations.scenes.single_view.stages import Found, Lengths

NONE, MISSING = "none drawn", "lines missing"


def readouts(settings: Settings, outputs: Outputs) -> tuple[Readout, ...]:
    """The numbers beside the figure; those in sight first, with the truth where it is known."""
    found: Found = outputs["view"]
    lengths: Lengths = outputs["lengths"]
    floor, height = outputs["truth"]
    own = outputs["photograph"] is not None
    return (
        _focal(found, "" if own else f", true {FOCAL_PX:.0f} px"),
        _length("length", "Length on the plane", lengths.floor, floor, lengths.known == "floor"),
        _length(
            "height", "Height above the plane", lengths.height, height, lengths.known == "height"
        ),
        Readout(
            "focal_error",
            "Standard error of f",
            format_number(100.0 * found.focal_error, 2) if found.knows_focal else "unknown",
            "%" if found.knows_focal else "",
            "camera",
        ),
        *_angles(found),
        Readout("distance", "Camera above the plane", *_distance(lengths), "camera"),
        Readout("scatter", "Scatter of the ends", *_scatter(found, settings.sigma), ""),
        Readout("centre_at", "Principal point", *_centre(found.view), "camera"),
    )


def _focal(found: Found, truth: str) -> Readout:
    text, unit = MISSING, ""
    if found.view is not None:
        f = found.view.focal_px
        text, unit = _split((f, f * found.focal_error), "px", 0)
    return Readout("focal", "Focal length", text, unit + truth if unit else unit, "camera")


def _length(
    name: str,
    label: str,
    pairs: tuple[tuple[float, float], ...],
    truth: tuple[float, ...],
    known: bool,
) -> Readout:
    """The first that is measured."""
    if len(pairs) <= known:
        return Readout(name, label, NONE, "", "image")
    text, unit = _split(pairs[known], "m")
    if unit and truth:
        unit += f", true {format_number(truth[known])} m"
    return Readout(name, label, text, unit, "image")


def _distance(lengths: Lengths) -> tuple[str, str]:
    return _split(lengths.distance, "m") if lengths.known else (NONE, "")


def _split(pair: tuple[float, float], unit: str, digits: int = 2) -> tuple[str, str]:
    """The text and the unit of a value with its error."""
    if math.isnan(pair[0]):
        return "beyond the horizon", ""
    text = with_error(*pair, "", digits)
    return text, unit if "±" in text else ""


def _angles(found: Found) -> tuple[Readout, ...]:
    labels = {"pitch": "Looks down (pitch)", "roll": "Leans right (roll)"}
    if found.view is None:
        return tuple(Readout(name, label, MISSING, "", "camera") for name, label in labels.items())
    values = np.degrees((found.view.pitch, found.view.roll))
    errors = found.view.spread(lambda view: np.degrees((view.pitch, view.roll)))
    return tuple(
        Readout(
            name, label, f"{format_number(value, 1)} ± {format_number(error, 1)}", "°", "camera"
        )
        for (name, label), value, error in zip(labels.items(), values, errors, strict=True)
    )


def _scatter(found: Found, sigma: float) -> tuple[str, str]:
    """The error of an end that the lines' own misfit tells."""
    view = found.view
    if view is None or view.spare < 1:
        return "too few lines", ""
    return format_number(sigma * math.sqrt(view.misfit / view.spare), 1), "px"


def _centre(view: SingleView | None) -> tuple[str, str]:
    if view is None:
        return MISSING, ""
    x, y = (format_number(number, 0) for number in view.centre)
    return f"({x}, {y})", "px"


def sheet(settings: Settings, outputs: Outputs) -> tuple[Readout, ...]:
    """The lines of the data sheet; none for what is not drawn."""
    found: Found = outputs["view"]
    lines: Drawn = outputs["lines"]
    shown = {each.name: each for each in readouts(settings, outputs)}
    named = tuple(
        shown[name]
        for name in ("focal", "pitch", "roll", "distance", "length", "height")
        if shown[name].text not in (NONE, MISSING)
    )
    named += _by_the_file(lines, outputs["photograph"])
    if found.view is None or not found.knows_focal:
        return named
    width = lines.size[0]
    angle = math.degrees(field_of_view_rad(found.view.focal_px, width))
    spread = math.degrees(
        float(found.view.spread(lambda view: field_of_view_rad(view.focal_px, width)))
    )
    text = f"{format_number(angle, 1)} ± {format_number(spread, 1)}"
    return (*named, Readout("field_of_view", "Horizontal field of view", text, "°", "camera"))


def _by_the_file(lines: Drawn, photograph: Photograph | None) -> tuple[Readout, ...]:
    """The focal length that EXIF states, on the film of 36 × 24 mm, which is by the diagonal."""
    stated = photograph.facts.get("focal_35mm_mm") if photograph else None
    if not isinstance(stated, int | float) or not stated > 0:
        return ()
    pixels = float(stated) / math.hypot(36.0, 24.0) * math.hypot(*lines.size)
    label = "Focal length by the file"
    return (Readout("focal_by_file", label, format_number(pixels, 0), "px", "camera"),)


def as_json(settings: Settings, outputs: Outputs) -> str:
    """Camera, vanishing points, lines and lengths with standard errors; null for the unknown."""
    found: Found = outputs["view"]
    lines: Drawn = outputs["lines"]
    lengths: Lengths = outputs["lengths"]
    photograph = outputs["photograph"]
    return json.dumps(
        {
            "photograph": photograph.name if photograph else "",
            "width_px": lines.size[0],
            "height_px": lines.size[1],
            "sigma_px": settings.sigma,
            "camera": _camera(found),
            "lines_px": {
                name: np.round(lines.counted(axis), 2).tolist()
                for axis, name in enumerate(("across", "along", "upright"))
            },
            "known_m": settings.known,
            "plane": settings.plane,
            "camera_above_plane_m": _pair(lengths.distance),
            "lengths_m": [_pair(pair) for pair in lengths.floor],
            "heights_m": [_pair(pair) for pair in lengths.height],
        },
        indent=1,
    )


def _camera(found: Found) -> object:
    view = found.view
    if view is None:
        return None
    errors = view.spread(lambda view: np.array([view.pitch, view.roll]))
    points = []
    for point, covariance in zip(view.vanishing, view.vanishing_covariances, strict=True):
        pixel, spread, finite = pixel_of(point, covariance)
        points.append({"pixel": pixel.tolist(), "covariance": spread.tolist()} if finite else None)
    f = view.focal_px
    return {
        "focal_px": _pair((f, f * found.focal_error)) if found.knows_focal else None,
        "principal_point_px": list(view.centre),
        "pitch_rad": _pair((view.pitch, float(errors[0]))),
        "roll_rad": _pair((view.roll, float(errors[1]))),
        "vanishing_points": points,
    }


def _pair(pair: tuple[float, float]) -> object:
    value, error = pair
    return {"value": value, "standard_error": error} if math.isfinite(value + error) else None
