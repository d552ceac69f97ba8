"""Calibrate a Camera: from photographs of a chequerboard to the camera and its errors.

It also makes files for other programs, the data sheet, and the undistorted photograph.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial

import numpy as np

from simulations.engine.drawing import rectangle
from simulations.engine.export import Export
from simulations.engine.frame import (
    Frame,
    Panel,
    Raster,
    Readout,
    format_number,
    readout,
    value_with_error,
)
from simulations.engine.handles import Handle, Point
from simulations.engine.photograph import Codes, Photograph, Whole
from simulations.engine.raster import opaque
from simulations.engine.reading import Readings, UnfitError
from simulations.engine.scene import Scene
from simulations.engine.settings import choice, slider
from simulations.engine.stages import Outputs
from simulations.models.calibration import exports
from simulations.models.calibration.bundle_adjustment import descend
from simulations.models.calibration.camera import LENSES as MODELS
from simulations.models.calibration.camera import PINHOLE
from simulations.models.calibration.exports import Maker, Report
from simulations.models.calibration.shape_size import stretched
from simulations.models.calibration.standard_errors import rms_of_each
from simulations.models.calibration.undistorted import undistorted
from simulations.scenes._wipe import wiped
from simulations.scenes.calibration import drawing
from simulations.scenes.calibration.board_drawing import board_drawing, board_words
from simulations.scenes.calibration.boards import LEAST, MOST, TRUTH, Boards, read, rendered
from simulations.scenes.calibration.contact_sheet import contact_sheet, middle_of, number_at
from simulations.scenes.calibration.stages import (
    DRAFT,
    SHEET,
    STAGES,
    SUPPORTED,
    Errors,
    Result,
    Shown,
    Trials,
)

LENSES = {
    "none": "No distortion",
    "k1": "k₁",
    "k1k2": "k₁ and k₂",
    "p1p2": "k₁, k₂, p₁, p₂",
    "k3": "k₁, k₂, p₁, p₂, k₃",
    "fisheye": "fisheye, k₁ to k₄ of the angle",
}
"""The models of the lens by their names in `models.calibration.camera.LENSES`."""
BOARDS = {"flat": "flat", "bent": "bent alike everywhere", "warped": "any smooth shape"}
"""The shapes of the board by their names in `models.calibration.board_shape.SHAPES`."""
ERRORS = {"shown": "Of the photograph shown", "all": "Of all photographs used"}
"""The photographs whose errors are drawn."""
DETAILS = {
    "models": "Error by the model of the lens",
    SHEET: "Error of each photograph",
    "board": "Shape of the board",
}
"""What the last panel shows."""
LABELS = {
    "fx": "Focal length, across",
    "fy": "Focal length, down",
    "cx": "Principal point, across",
    "cy": "Principal point, down",
}
"""Label of each parameter in px; the others are coefficients."""
LOWERED = str.maketrans("1234", "₁₂₃₄")
OPEN = "This model of the lens needs more photographs, or more tilted ones"
UNKNOWN = "not determined"
INSIDE = 12.0  # least distance of the handle of the dividing line from the right border


@dataclass(frozen=True, slots=True)
class Settings:
    photographs: int = slider("Photographs", 5, LEAST, MOST, 1)
    lens: str = choice("Model of the lens", LENSES | {SUPPORTED: "the supported one"}, default="k1")
    shown: int = slider("Photograph shown", 3, 1, MOST, 1)
    detail: str = choice("Details", DETAILS)
    without: int = slider("Photograph left out (0: none)", 0, 0, MOST, 1)
    arrows: str = choice("Arrows", ERRORS)
    share: float = slider("Dividing line", 1, 0, 1, 0.01)
    shape: str = choice("Board", BOARDS | {SUPPORTED: "the supported shape"}, default="flat")
    side: float = slider("Width of a square", 25, 1, 100, 0.1, unit="mm")


def true_focal(given: Boards) -> float | None:
    """f_x of the simulated camera."""
    return given.truth.fx if given.truth else None


def draw(settings: Settings, outputs: Outputs) -> Frame:
    """The photograph with the errors of its corners, the models of the lens, and the growth."""
    given: Boards = outputs["boards"]
    trials: Trials = outputs["trials"]
    result: Result | None = outputs["result"]
    grown = detail = drawing.in_words(". ".join((trials.problem or OPEN, *given.notes)))
    if result:
        detail = _detail(settings, outputs, result)
    if result and result.grown:
        focal, truth = focal_words(result), true_focal(given)
        grown = drawing.growth(result.grown, settings.photographs, truth, focal)
    size, picture = (drawing.WIDTH, drawing.HEIGHT), drawing.view_box(given.size)
    raster, over, title = _raster(settings, outputs), _over(settings, outputs), "photograph"
    return Frame(
        (
            Panel(title, "A photograph of the board", *picture, raster, over, lead=True),
            Panel("growth", "Focal length", *size, overlay=grown),
            Panel("detail", DETAILS[settings.detail], *size, overlay=detail),
        ),
        _readouts(settings, trials, result, outputs["errors"]),
        describe(settings, given, trials, result),
    )


def _detail(settings: Settings, outputs: Outputs, result: Result) -> str:
    """The last panel."""
    trials: Trials = outputs["trials"]
    if settings.detail == "models":
        return drawing.model_errors(trials.found, result.supported)
    if settings.detail == "board":
        return board_drawing(result.board, trials.tried, settings.side)
    given: Boards = outputs["boards"]
    used = [is_used(index, settings, trials) for index in range(len(given.views))]
    return contact_sheet(given, outputs["each"], used, settings.without, outputs["looked"].index)


def is_used(index: int, settings: Settings, trials: Trials) -> bool:
    """Whether the camera was fitted to a photograph, counted from 0."""
    before = 0 < settings.without <= index
    return index + 1 != settings.without and index - before < len(trials.views)


def focal_words(result: Result) -> str:
    """The focal length ± its standard error, px."""
    trial = result.trial
    return value_with_error(trial.fit.camera.fx, trial.uncertainty.errors["fx"])


def _raster(settings: Settings, outputs: Outputs) -> Raster | None:
    looked: Shown = outputs["looked"]
    if looked.codes is None:
        return None
    developed = opaque(outputs["developed"])
    return np.ascontiguousarray(wiped(opaque(looked.codes), developed, settings.share))


def _over(settings: Settings, outputs: Outputs) -> str:
    """The errors left of the dividing line; the border of a photograph that is not at hand."""
    size, looked, every = outputs["boards"].size, outputs["looked"], settings.arrows == "all"
    parts = []
    if looked.codes is None:
        width, height = drawing.view_box(size)
        parts.append(rectangle((0.5, 0.5), width - 1.0, height - 1.0, "muted thin"))
    errors: Errors | None = outputs["map" if every else "errors"]
    if errors:
        length = drawing.STROKE if every else drawing.ARROW
        times = drawing.enlargement(errors.rms_px, size, length)
        left = errors.found[:, 0] <= settings.share * size[0]
        found, off = errors.found[left], errors.off[left]
        used = every or is_used(looked.index, settings, outputs["trials"])
        parts.append(drawing.error_arrows(found, off, size, times, many=every))
        parts.append(drawing.enlarged(times, used))
    if outputs["developed"] is not None:
        parts.append(drawing.dividing_line(settings.share, size))
    return "".join(parts)


def _readouts(
    settings: Settings, trials: Trials, result: Result | None, errors: Errors | None
) -> tuple[Readout, ...]:
    """The measured numbers, where the photographs determine them."""
    numbers, words = {}, dict.fromkeys(("supported", "board", "advice"), UNKNOWN)
    if errors:
        numbers["rms_shown"] = errors.rms_px
    if result:
        trial, camera = result.trial, result.trial.fit.camera
        words = {
            "supported": LENSES[result.supported.lens],
            "board": board_words(result.board, settings.side)[0],
            "advice": result.advice,
        }
        numbers |= {
            "focal": camera.fx,
            "focal_error": trial.uncertainty.errors["fx"],
            "formula": float(np.sqrt(trial.uncertainty.covariance[0, 0])),
            "left_out": trial.left_out_px,
            "rms": trial.rms_px,
            "k1": camera.lens.k1,
            "k2": camera.lens.k2,
            "covered": 100.0 * result.covered.share,
            "aic": trial.aic - min(other.aic for other in trials.found),
        }

    def number(name: str, label: str, unit: str, digits: int, role: str = "") -> Readout:
        value = numbers.get(name, np.nan)
        if np.isnan(value):
            return Readout(name, label, UNKNOWN, "", role)
        return readout(name, label, value, unit, digits=digits, role=role)

    return (
        number("focal", "Focal length fₓ", "px", 1, "image"),
        number("focal_error", "Standard error of fₓ", "px", 2, "image"),
        number("formula", "Standard error if all is noise", "px", 2),
        number("left_out", "Error, left out", "px", 4, "error"),
        number("rms", "Error, photographs used", "px", 4, "image"),
        number("rms_shown", "Error, photograph shown", "px", 4),
        number("k1", "k₁", "", 4),
        number("k2", "k₂", "", 4),
        number("aic", "ΔAIC", "", 0),
        number("covered", "Covered by corners", "%", 0),
        Readout("supported", "Model supported", words["supported"]),
        Readout("board", "Board", words["board"]),
        Readout("advice", "Next photograph", words["advice"]),
    )


def describe(settings: Settings, given: Boards, trials: Trials, result: Result | None) -> str:
    """The result, or the reason why there is none."""
    notes = "".join(f" {note}" for note in _notes(given, result))
    if result is None:
        return f"{trials.problem or OPEN}.{notes}"
    trial = result.trial
    focal = focal_words(result)
    truth = f" (true: {format_number(given.truth.fx, 0)} px)" if given.truth else ""
    board = ". ".join(line for line in board_words(result.board, settings.side) if line)
    return (
        f"From {len(trials.views)} photographs of a chequerboard, fₓ = {focal} px{truth}; with the "
        f"model “{LENSES[trial.lens]}”, photographs left out are predicted to "
        f"{format_number(trial.left_out_px, 2)} px, and the model supported is "
        f"“{LENSES[result.supported.lens]}”. The board: {board[0].lower()}{board[1:]}.{notes}"
    )


def _notes(given: Boards, result: Result | None) -> tuple[str, ...]:
    """Of the photographs, and of their pixels if these are not square."""
    odd = stretched(result.trial) if result and not given.truth else ""
    return (*given.notes, odd) if odd else given.notes


def _determined(outputs: Outputs) -> Result:
    result: Result | None = outputs["result"]
    if result is None:
        trials: Trials = outputs["trials"]
        raise UnfitError(f"{trials.problem or OPEN}.")
    return result


def _report(outputs: Outputs) -> Report:
    given: Boards = outputs["used"]
    trial = _determined(outputs).trial
    each = rms_of_each(outputs["trials"].views, trial.fit).tolist()
    return Report(
        trial.fit.camera,
        given.size,
        {name: trial.uncertainty.errors[name] for name in PINHOLE + MODELS[trial.lens]},
        trial.rms_px,
        trial.fit.poses,
        tuple(zip(given.names, each, strict=False)),
    )


def maker_of(readings: Readings) -> Maker:
    """The maker by EXIF of the first photograph; a full frame if the crop factor is not known."""
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
        for n, note in enumerate(_notes(given, outputs["result"]), 1)
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


def _parameters(result: Result) -> Iterator[Readout]:
    """The camera's parameters that were fitted."""
    trial = result.trial
    names = PINHOLE + MODELS[trial.lens]
    for name, value in zip(names, trial.fit.camera.values(names).tolist(), strict=True):
        label = LABELS.get(name, name.translate(LOWERED))
        words = value_with_error(value, trial.uncertainty.errors[name])
        yield Readout(name, label, words, "px" if name in LABELS else "")


def line_at(settings: Settings, outputs: Outputs) -> Point | None:
    if outputs["developed"] is None:
        return None
    width, height = drawing.view_box(outputs["boards"].size)
    return min(settings.share * width, width - INSIDE), drawing.LINE_AT * height


def model_at(settings: Settings, outputs: Outputs) -> Point | None:
    result: Result | None = outputs["result"]
    if result is None or settings.detail != "models":
        return None
    plot = drawing.error_plot(outputs["trials"].found)
    return plot.clamped(drawing.place_of(result.trial.lens), result.trial.left_out_px)


def model_pulled(_settings: Settings, place: Point) -> dict[str, str]:
    """The model whose column is nearest."""
    lenses = list(LENSES)
    index = int(drawing.ACROSS.value(float(place[0])) // 1)
    return {"lens": lenses[min(max(index, 0), len(lenses) - 1)]}


def left_out_at(settings: Settings, outputs: Outputs) -> Point | None:
    if outputs["each"] is None:
        return None
    return middle_of(settings.without if settings.without <= len(outputs["each"]) else 0)


def count_at(settings: Settings, outputs: Outputs) -> Point | None:
    result: Result | None = outputs["result"]
    if result is None or result.grown is None:
        return None
    plot = drawing.growth_plot(result.grown, true_focal(outputs["boards"]))
    return plot.clamped(*drawing.grown_at(result.grown, settings.photographs))


SCENE = Scene(
    "calibration",
    "Calibrate a Camera",
    Settings,
    draw,
    STAGES,
    handles=(
        Handle(
            "line",
            "photograph",
            "Dividing line",
            ("share",),
            line_at,
            lambda _, place: {"share": place[0] / drawing.WIDTH},
            role="image",
        ),
        Handle(
            "model",
            "detail",
            "Model of the lens",
            ("lens",),
            model_at,
            model_pulled,
            role="error",
        ),
        Handle(
            "left-out",
            "detail",
            "Photograph left out",
            ("without",),
            left_out_at,
            lambda _, place: {"without": number_at(place)},
            "press",
            "error",
        ),
        Handle(
            "count",
            "growth",
            "Count of photographs",
            ("photographs",),
            count_at,
            lambda _, place: {"photographs": drawing.count_of(float(place[0]))},
            "press",
            "image",
        ),
    ),
    photograph=Whole(1.0),
    read=read,
    samples={
        f"true {TRUTH.fx:.0f} px, board {index + 1}.png": partial(rendered, index)
        for index in range(12)
    },
    develop=develop,
    exports=(
        Export("camera", "OpenCV YAML", ".yaml", _file(exports.opencv_yaml)),
        Export("camera-and-poses", "JSON", ".json", _file(exports.as_json)),
        Export("lens", "Lensfun entry", ".xml", _lensfun),
    ),
    sheet=sheet,
    measured=measured,
    own_drafts={DRAFT: ("photographs", "shown", "without")},
    formula=descend,
)
