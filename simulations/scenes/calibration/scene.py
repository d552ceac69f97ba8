"""Calibrate a Camera: from photographs of a chequerboard to the camera and its errors."""

from dataclasses import replace

import numpy as np

from simulations.engine.frame import Frame, Panel, Raster, Readout, format_number, readout
from simulations.engine.photograph import Whole
from simulations.engine.raster import opaque
from simulations.engine.scene import Scene
from simulations.engine.stages import Outputs
from simulations.models.calibration.bundle_adjustment import descend
from simulations.scenes._wipe.wipe import wiped
from simulations.scenes.calibration import drawing, plots
from simulations.scenes.calibration.boards import Boards
from simulations.scenes.calibration.files import EXPORTS, OPEN, develop, measured, sheet
from simulations.scenes.calibration.handles import HANDLES
from simulations.scenes.calibration.reading import read
from simulations.scenes.calibration.settings import LENSES, Settings
from simulations.scenes.calibration.stages import DRAFT, STAGES, Errors, Looked, Result, Trials

UNKNOWN = "not determined"


def draw(settings: Settings, outputs: Outputs) -> Frame:
    """The photograph with the errors of its corners, the models of the lens, and the growth."""
    given: Boards = outputs["boards"]
    trials: Trials = outputs["trials"]
    result: Result | None = outputs["result"]
    problem = ". ".join((trials.problem or OPEN, *given.notes))
    width, height = drawing.view_box(given.size)
    return Frame(
        panels=(
            Panel(
                "photograph",
                "A photograph of the board",
                width,
                height,
                _raster(settings, outputs),
                _over(settings, outputs),
                lead=True,
            ),
            Panel(
                "models",
                "Error by the model of the lens",
                plots.WIDTH,
                plots.HEIGHT,
                overlay=plots.model_errors(trials.found, result.supported)
                if result
                else plots.said(problem),
            ),
            Panel(
                "growth",
                "Focal length by the photographs",
                plots.WIDTH,
                plots.HEIGHT,
                overlay=plots.growth(result.grown, settings.photographs, given.true_focal)
                if result and result.grown
                else plots.said(problem),
            ),
        ),
        readouts=tuple(map(_known, _readouts(result, outputs["errors"]))),
        description=describe(settings, given, trials, result),
    )


def _raster(settings: Settings, outputs: Outputs) -> Raster | None:
    looked: Looked = outputs["looked"]
    if looked.codes is None:
        return None
    developed = outputs["developed"]
    return np.ascontiguousarray(wiped(opaque(looked.codes), opaque(developed), settings.share))


def _over(settings: Settings, outputs: Outputs) -> str:
    given: Boards = outputs["boards"]
    parts = [] if outputs["looked"].codes is not None else [drawing.empty(given.size)]
    every = settings.arrows == "all"
    errors: Errors | None = outputs["map" if every else "errors"]
    if errors:
        length = drawing.STROKE if every else drawing.ARROW
        times = drawing.enlargement(errors.rms_px, given.size, length)
        left = errors.found[:, 0] <= settings.share * given.size[0]
        draw_them = drawing.strokes if every else drawing.corners
        parts.append(draw_them(errors.found[left], errors.off[left], given.size, times))
        count = len(outputs["trials"].views)
        parts.append(drawing.legend(times, every or outputs["looked"].index < count))
    if outputs["developed"] is not None:
        parts.append(drawing.dividing_line(settings.share, given.size))
    return "".join(parts)


def _readouts(result: Result | None, errors: Errors | None) -> tuple[Readout, ...]:
    """The measured numbers; undefined where the photographs do not determine them."""
    nan = float("nan")
    trial = result.trial if result else None
    camera = trial.fit.camera if trial else None
    sure = trial.uncertainty.errors if trial else {}
    return (
        readout(
            "focal", "Focal length fₓ", camera.fx if camera else nan, "px", digits=1, role="image"
        ),
        readout("focal_error", "Standard error of fₓ", sure.get("fx", nan), "px", role="image"),
        readout(
            "left_out",
            "Error, left out",
            trial.left_out_px if trial else nan,
            "px",
            digits=4,
            role="error",
        ),
        readout(
            "rms",
            "Error, photographs used",
            trial.rms_px if trial else nan,
            "px",
            digits=4,
            role="image",
        ),
        readout(
            "rms_shown", "Error, photograph shown", errors.rms_px if errors else nan, "px", digits=4
        ),
        readout("k1", "k₁", camera.lens.k1 if camera else nan, digits=4),
        readout("k2", "k₂", camera.lens.k2 if camera else nan, digits=4),
        readout(
            "covered",
            "Covered by corners",
            100.0 * result.covered.share if result else nan,
            "%",
            digits=0,
        ),
        Readout(
            "supported", "Model supported", LENSES[result.supported.lens] if result else UNKNOWN
        ),
        Readout("advice", "Next photograph", result.advice if result else UNKNOWN),
    )


def _known(shown: Readout) -> Readout:
    """Without a number that the photographs do not determine."""
    undefined = shown.text == format_number(float("nan"))
    return replace(shown, text=UNKNOWN, unit="") if undefined else shown


def describe(settings: Settings, given: Boards, trials: Trials, result: Result | None) -> str:
    """What was found, or why nothing was."""
    count = len(trials.views)
    notes = "".join(f" {note}" for note in given.notes)
    if result is None:
        return f"{trials.problem or OPEN}.{notes}"
    trial = result.trial
    words = (
        f"From {count} photographs of a chequerboard, fₓ = {format_number(trial.fit.camera.fx, 1)} "
        f"± {format_number(trial.uncertainty.errors['fx'], 1)} px"
    )
    if given.truth:
        words += f" (true: {format_number(given.truth.fx, 0)} px)"
    return (
        f"{words}; with the model “{LENSES[settings.lens]}”, photographs left out are predicted to "
        f"{format_number(trial.left_out_px, 2)} px, and the model supported is "
        f"“{LENSES[result.supported.lens]}”.{notes}"
    )


SCENE = Scene(
    id="calibration",
    title="Calibrate a Camera",
    settings=Settings,
    draw=draw,
    formula=descend,
    stages=STAGES,
    handles=HANDLES,
    photograph=Whole(1.0),
    read=read,
    own_drafts={DRAFT: ("photographs", "shown")},
    develop=develop,
    exports=EXPORTS,
    sheet=sheet,
    measured=measured,
)
