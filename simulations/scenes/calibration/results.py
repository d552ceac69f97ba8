"""What the calibration gives away: files, the data sheet, and photographs without distortion."""

from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np

from simulations.engine.export import Export
from simulations.engine.frame import Readout, format_number, matrix_text, readout, value_with_error
from simulations.engine.photograph import Codes, Photograph
from simulations.engine.reading import Readings, UnfitError
from simulations.engine.stages import Outputs
from simulations.models.calibration import exports
from simulations.models.calibration.board_shape import FLAT
from simulations.models.calibration.bundle_adjustment import refine
from simulations.models.calibration.camera import LENSES as MODELS
from simulations.models.calibration.camera import PINHOLE
from simulations.models.calibration.exports import Maker, Report
from simulations.models.calibration.shape_size import stretched
from simulations.models.calibration.standard_errors import rms_of_each, rms_px
from simulations.models.calibration.undistorted import undistorted
from simulations.scenes.calibration.board_drawing import board_words
from simulations.scenes.calibration.boards import Boards
from simulations.scenes.calibration.settings import LENSES, Settings
from simulations.scenes.calibration.stages import Result, Trials

LABELS = {
    "fx": "Focal length, across",
    "fy": "Focal length, down",
    "cx": "Principal point, across",
    "cy": "Principal point, down",
}
"""Label of each parameter in px; the others are coefficients."""
LOWERED = str.maketrans("123456", "₁₂₃₄₅₆")
OPEN = "This model needs a wider lens, more photographs, or more tilted ones"


def notes_of(given: Boards, result: Result | None) -> tuple[str, ...]:
    """Of the photographs, of those that differ, and of their pixels if these are not square."""
    odd = (result.mixed, stretched(result.trial)) if result and not given.truth else ()
    return (*given.notes, *filter(None, odd))


def _determined(outputs: Outputs) -> Result:
    result: Result | None = outputs["result"]
    if result is None:
        trials: Trials = outputs["trials"]
        raise UnfitError(f"{trials.problem or OPEN}.")
    return result


def _report(outputs: Outputs) -> Report:
    given: Boards = outputs["used"]
    trial, views = _determined(outputs).trial, outputs["trials"].views
    fit, names = trial.fit, PINHOLE + MODELS[trial.lens]
    shape = fit.poses.shape
    if shape.terms:
        fit = refine(views, fit.camera, replace(fit.poses, shape=FLAT), (), draft=True)
    each = rms_of_each(views, fit).tolist()
    return Report(
        camera=fit.camera,
        size=given.size,
        errors={name: trial.uncertainty.errors[name] for name in names},
        covariance=trial.uncertainty.covariance[: len(names), : len(names)],
        rms_px=rms_px(views, fit),
        poses=fit.poses,
        bent=(shape, trial.rms_px) if shape.terms else None,
        photographs=tuple(zip(given.names, each, strict=False)),
        views=views,
        taken=given.taken,
    )


def maker_of(readings: Readings) -> Maker:
    """The maker by EXIF of the first photograph."""
    facts = readings[0].data.get("facts", {}) if readings else {}
    focal, full_frame = facts.get("focal_mm"), facts.get("focal_35mm_mm")
    known = Maker()
    return Maker(
        str(facts.get("make", known.make)),
        str(facts.get("model", known.model)),
        str(facts.get("lens", known.lens)),
        float(focal) if focal else None,
        float(full_frame) / float(focal) if focal and full_frame else None,
    )


def _file(write: Callable[[Report], str]) -> Callable[[Settings, Outputs], str]:
    return lambda _settings, outputs: write(_report(outputs))


def _lensfun(_settings: Settings, outputs: Outputs) -> str:
    return exports.lensfun_xml(_report(outputs), maker_of(outputs["readings"]))


def develop(photograph: Photograph, _settings: Settings, outputs: Outputs) -> Codes:
    """The whole photograph without distortion."""
    given: Boards = outputs["boards"]
    camera = _determined(outputs).trial.fit.camera
    return undistorted(photograph.codes, camera.scaled(photograph.codes.shape[1] / given.size[0]))


def measured(outputs: Outputs) -> tuple[int, ...]:
    """Numbers of the photographs that the camera was fitted to."""
    given: Boards = outputs["used"]
    return given.numbers[: len(outputs["trials"].views)]


def sheet(settings: Settings, outputs: Outputs) -> tuple[Readout, ...]:
    """The camera's parameters with standard errors, and how well they predict corners."""
    given: Boards = outputs["used"]
    notes = [
        Readout(f"note{n}", "Note", note)
        for n, note in enumerate(notes_of(given, outputs["result"]), 1)
    ]
    if outputs["result"] is None:
        problem = outputs["trials"].problem or OPEN
        return (Readout("problem", "Calibration", problem), *notes)
    result: Result = outputs["result"]
    trial, (width, height) = result.trial, given.size
    degrees = float(np.degrees(trial.fit.camera.field_rad(width)))
    each = rms_of_each(outputs["trials"].views, trial.fit)
    worst = f"{format_number(float(each.max()), 3)} px, {given.names[int(each.argmax())]}"
    main, *parameters = _parameters(result)
    return (
        main,
        Readout("photographs", "Photographs used", str(len(trial.fit.poses.t))),
        Readout("size", "Size of the photographs", f"{width} × {height}", "px"),
        Readout("lens", "Model of the lens", LENSES[trial.lens]),
        *parameters,
        *(
            [readout("stated", "Focal length, by the file", given.focal_px, "px", digits=0)]
            if given.focal_px is not None
            else []
        ),
        readout("field", "Field of view across", degrees, "°", digits=1),
        readout("rms", "Error, photographs used", trial.rms_px, "px", digits=3),
        readout("left_out", "Error, left out", trial.left_out_px, "px", digits=3),
        Readout("worst", "Largest error of a photograph", worst),
        readout("covered", "Covered by corners", 100 * result.covered.share, "%", digits=0),
        Readout("supported", "Model supported", LENSES[result.supported.lens]),
        *(
            Readout(f"board{index}", "Board", words)
            for index, words in enumerate(board_words(result.board, settings.side))
            if words
        ),
        Readout("advice", "Next photograph", result.advice),
        *notes,
    )


def matrix_of(result: Result) -> str:
    """The intrinsic matrix with its standard errors, px."""
    words = {
        each.name: each.text.replace("under ", "<").replace(" ", "") for each in _parameters(result)
    }
    return matrix_text(
        ((words["fx"], "0", words["cx"]), ("0", words["fy"], words["cy"]), ("0", "0", "1"))
    )


def _parameters(result: Result) -> Iterator[Readout]:
    """The camera's parameters that were fitted."""
    trial = result.trial
    names = PINHOLE + MODELS[trial.lens]
    for name, value in zip(names, trial.fit.camera.values(names).tolist(), strict=True):
        label = LABELS.get(name, name.translate(LOWERED))
        words = value_with_error(value, trial.uncertainty.errors[name])
        yield Readout(name, label, words, "px" if name in LABELS else "")


EXPORTS: tuple[Export[Settings], ...] = (
    Export("camera", "OpenCV YAML", ".yaml", _file(exports.opencv_yaml)),
    Export("camera-and-poses", "JSON", ".json", _file(exports.as_json)),
    Export("lens", "Lensfun entry", ".xml", _lensfun),
    Export("camera-info", "ROS camera_info", ".yaml", _file(exports.ros_yaml)),
    Export("cameras", "COLMAP cameras.txt", ".txt", _file(exports.colmap_text)),
)
