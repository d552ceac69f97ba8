"""What can be taken away: files for other programs, the data sheet, the undistorted photograph."""

from collections.abc import Callable, Iterator

import numpy as np

from simulations.engine.export import Export
from simulations.engine.frame import Readout, format_number
from simulations.engine.photograph import Codes, Photograph
from simulations.engine.reading import Readings, UnfitError
from simulations.engine.stages import Outputs
from simulations.models.calibration import exports
from simulations.models.calibration.exports import Maker, Report
from simulations.models.calibration.standard_errors import rms_of_each
from simulations.models.calibration.undistorted import undistorted
from simulations.scenes.calibration.boards import Boards
from simulations.scenes.calibration.settings import LENSES, Settings
from simulations.scenes.calibration.stages import Result, Trials

OPEN = "This model of the lens needs more photographs, or more tilted ones"
DIGITS = {"fx": 2, "fy": 2, "cx": 2, "cy": 2}
"""Decimals of the data sheet; coefficients of the lens have five."""
UNITS = {"fx": "px", "fy": "px", "cx": "px", "cy": "px"}
LABELS = {
    "fx": "Focal length, across",
    "fy": "Focal length, down",
    "cx": "Principal point, across",
    "cy": "Principal point, down",
    "k1": "k₁",
    "k2": "k₂",
    "p1": "p₁",
    "p2": "p₂",
    "k3": "k₃",
}


def _report(outputs: Outputs) -> Report:
    given: Boards = outputs["boards"]
    trial = _determined(outputs).trial
    each = rms_of_each(outputs["trials"].views, trial.fit).tolist()
    photographs = tuple(zip(given.names, each, strict=False))
    return Report(
        trial.fit.camera,
        given.size,
        trial.uncertainty.errors,
        trial.rms_px,
        trial.fit.poses,
        photographs,
    )


def _determined(outputs: Outputs) -> Result:
    result: Result | None = outputs["result"]
    if result is None:
        trials: Trials = outputs["trials"]
        raise UnfitError(f"{trials.problem or OPEN}.")
    return result


def _lensfun(_settings: Settings, outputs: Outputs) -> str:
    return exports.lensfun_xml(_report(outputs), maker_of(outputs["readings"]))


def maker_of(readings: Readings) -> Maker:
    """From EXIF of the first photograph; a full frame where the crop factor is not known."""
    facts = readings[0].data.get("facts", {}) if readings else {}
    focal, full_frame = facts.get("focal_mm"), facts.get("focal_35mm_mm")
    known = Maker()
    return Maker(
        str(facts.get("make", known.make)),
        str(facts.get("model", known.model)),
        str(facts.get("lens", known.lens)),
        float(focal) if focal else None,
        float(full_frame) / float(focal) if focal and full_frame else 1.0,
    )


def _file(write: Callable[[Report], str]) -> Callable[[Settings, Outputs], str]:
    return lambda _settings, outputs: write(_report(outputs))


EXPORTS: tuple[Export[Settings], ...] = (
    Export("camera", "OpenCV YAML", ".yaml", _file(exports.opencv_yaml)),
    Export("camera-and-poses", "JSON", ".json", _file(exports.as_json)),
    Export("lens", "Lensfun entry", ".xml", _lensfun),
)


def develop(photograph: Photograph, _settings: Settings, outputs: Outputs) -> Codes:
    """The whole photograph without distortion."""
    given: Boards = outputs["boards"]
    camera = _determined(outputs).trial.fit.camera
    return undistorted(photograph.codes, camera.scaled(photograph.codes.shape[1] / given.size[0]))


def _worst(given: Boards, outputs: Outputs) -> Readout:
    """The photograph whose corners fit worst."""
    each = rms_of_each(outputs["trials"].views, outputs["result"].trial.fit)
    index = int(each.argmax())
    words = f"{format_number(float(each[index]), 3)} px, {given.names[index]}"
    return Readout("worst", "Largest error of a photograph", words)


def measured(outputs: Outputs) -> tuple[int, ...]:
    """Numbers of the photographs that the camera was fitted to."""
    given: Boards = outputs["boards"]
    return given.numbers[: len(outputs["trials"].views)]


def sheet(settings: Settings, outputs: Outputs) -> tuple[Readout, ...]:
    """The camera's parameters with standard errors, and how well they predict corners."""
    given: Boards = outputs["boards"]
    result: Result | None = outputs["result"]
    if result is None:
        trials: Trials = outputs["trials"]
        return (Readout("problem", "Calibration", trials.problem or OPEN), *_notes(given))
    trial = result.trial
    values = trial.fit.camera.values(trial.free).tolist()
    width, height = given.size
    degrees = np.degrees(2.0 * np.arctan(0.5 * width / trial.fit.camera.fx))
    lines = [
        Readout("size", "Size of the photographs", f"{width} × {height}", "px"),
        Readout("photographs", "Photographs used", str(len(trial.fit.poses.t))),
        Readout("lens", "Model of the lens", LENSES[settings.lens]),
    ]
    for name, value in zip(trial.free, values, strict=True):
        digits = DIGITS.get(name, 5)
        error = format_number(trial.uncertainty.errors[name], digits)
        words = f"{format_number(value, digits)} ± {error}"
        lines.append(Readout(name, LABELS[name], words, UNITS.get(name, "")))
    if given.focal_px is not None:
        stated = format_number(given.focal_px, 0)
        lines.append(Readout("stated", "Focal length, by the file", stated, "px"))
    return (
        *lines,
        Readout("field", "Field of view across", format_number(float(degrees), 1), "°"),
        Readout("rms", "Error, photographs used", format_number(trial.rms_px, 3), "px"),
        Readout("left_out", "Error, left out", format_number(trial.left_out_px, 3), "px"),
        _worst(given, outputs),
        Readout("covered", "Covered by corners", format_number(100 * result.covered.share, 0), "%"),
        Readout("supported", "Model supported", LENSES[result.supported.lens]),
        Readout("advice", "Next photograph", result.advice),
        *_notes(given),
    )


def _notes(given: Boards) -> Iterator[Readout]:
    return (Readout(f"note{n}", "Note", note) for n, note in enumerate(given.notes, 1))
