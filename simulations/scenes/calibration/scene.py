"""Calibrate a Camera: from photographs of a chequerboard to the camera and its errors."""

from functools import partial

import numpy as np

from simulations.engine.accuracy import Accuracy
from simulations.engine.drawing import rectangle
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
from simulations.engine.instrument import Instrument
from simulations.engine.photograph import Whole
from simulations.engine.raster import opaque
from simulations.engine.scene import Scene
from simulations.engine.stages import Outputs
from simulations.models.calibration.bundle_adjustment import descend
from simulations.scenes._wipe import wiped
from simulations.scenes.calibration import drawing
from simulations.scenes.calibration.board_drawing import board_drawing, board_words
from simulations.scenes.calibration.boards import TRUTH, Boards, read, rendered
from simulations.scenes.calibration.contact_sheet import contact_sheet, middle_of, number_at
from simulations.scenes.calibration.results import (
    EXPORTS,
    OPEN,
    develop,
    matrix_of,
    measured,
    notes_of,
    sheet,
)
from simulations.scenes.calibration.settings import DETAILS, LENSES, Settings
from simulations.scenes.calibration.stages import (
    LEVELS,
    STAGES,
    SUPPORTED,
    Errors,
    Result,
    Shown,
    Trials,
)

UNKNOWN = "not determined"
INSIDE = 12.0  # least distance of the handle of the dividing line from the right border


def true_focal(given: Boards) -> float | None:
    """f_x of the simulated camera."""
    return given.truth.fx if given.truth else None


def draw(settings: Settings, outputs: Outputs) -> Frame:
    """The photograph with the errors of its corners, the models of the lens, and the growth."""
    given: Boards = outputs["boards"]
    trials: Trials = outputs["trials"]
    result: Result | None = outputs["result"]
    words = drawing.in_words(". ".join((trials.problem or OPEN, *given.notes)))
    grown, detail = words, _detail(settings, outputs) or words
    if result and result.grown:
        focal, truth = focal_words(result), true_focal(given)
        grown = drawing.growth(result.grown, settings.photographs, truth, focal)
    space = words
    if result:
        shown = -1 if settings.without else outputs["looked"].index
        space = drawing.boards_in_space(trials.views, result.trial.fit.poses, shown)
    size, picture = (drawing.WIDTH, drawing.HEIGHT), drawing.view_box(given.size)
    raster, over, title = _raster(settings, outputs), _over(settings, outputs), "photograph"
    return Frame(
        (
            Panel(title, "A photograph of the board", *picture, raster, over, lead=True),
            Panel("boards", "The boards before the camera", *size, overlay=space),
            Panel("growth", "Focal length", *size, overlay=grown),
            Panel("detail", DETAILS[settings.detail], *size, overlay=detail),
        ),
        _readouts(settings, trials, result, outputs["errors"]),
        describe(settings, given, trials, result),
    )


def _detail(settings: Settings, outputs: Outputs) -> str:
    """The last panel; empty if the photographs do not determine what it shows."""
    trials: Trials = outputs["trials"]
    result: Result | None = outputs["result"]
    if settings.detail == "models":
        best = trials.of(SUPPORTED)
        return drawing.model_errors(trials.found, best) if best else ""
    if settings.detail == "board":
        return board_drawing(result.board, trials.tried, settings.side) if result else ""
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
    numbers, words = {}, dict.fromkeys(("matrix", "supported", "board", "advice"), UNKNOWN)
    if errors:
        numbers["rms_shown"] = errors.rms_px
    if result:
        trial, camera = result.trial, result.trial.fit.camera
        words = {
            "matrix": matrix_of(result),
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
            return Readout(name, label, UNKNOWN, "", role=role)
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
        Readout("matrix", "Intrinsic matrix, px", words["matrix"], role="image"),
        Readout("supported", "Model supported", words["supported"]),
        Readout("board", "Board", words["board"]),
        Readout("advice", "Next photograph", words["advice"]),
    )


def describe(settings: Settings, given: Boards, trials: Trials, result: Result | None) -> str:
    """The result, or the reason why there is none."""
    notes = "".join(f" {note}" for note in notes_of(given, result))
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


def line_at(settings: Settings, outputs: Outputs) -> Point | None:
    if outputs["developed"] is None:
        return None
    width, height = drawing.view_box(outputs["boards"].size)
    return min(settings.share * width, width - INSIDE), drawing.LINE_AT * height


def model_at(settings: Settings, outputs: Outputs) -> Point | None:
    """On the axis for a model without errors: those with errors can still be reached."""
    trials: Trials = outputs["trials"]
    if not trials.found or settings.detail != "models":
        return None
    plot, trial = drawing.error_plot(trials.found), trials.of(settings.lens)
    if trial is None:
        return plot.clamped(drawing.place_of(settings.lens), plot.y.low)
    return plot.clamped(drawing.place_of(trial.lens), trial.left_out_px)


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
            drives=("share",),
            at=line_at,
            pull=lambda _, place: {"share": place[0] / drawing.WIDTH},
            role="image",
        ),
        Handle(
            "model", "detail", "Model of the lens", ("lens",), model_at, model_pulled, role="error"
        ),
        Handle(
            "left-out",
            "detail",
            "Photograph left out",
            drives=("without",),
            at=left_out_at,
            pull=lambda _, place: {"without": number_at(place)},
            reach="press",
            role="error",
        ),
        Handle(
            "count",
            "growth",
            "Count of photographs",
            drives=("photographs",),
            at=count_at,
            pull=lambda _, place: {"photographs": drawing.count_of(float(place[0]))},
            reach="press",
            role="image",
        ),
    ),
    instrument=Instrument(
        photograph=Whole(1.0),
        read=read,
        samples={
            f"true {TRUTH.fx:.0f} px, board {index + 1}.png": partial(rendered, index)
            for index in range(12)
        },
        develop=develop,
        exports=EXPORTS,
        sheet=sheet,
        measured=measured,
    ),
    accuracy=Accuracy(levels=LEVELS),
    formula=descend,
)
