"""Handles of the calibration: the dividing line, the model of the lens, and the count."""

from collections.abc import Mapping

from simulations.engine.controls import Value
from simulations.engine.handles import Handle, Point
from simulations.engine.stages import Outputs
from simulations.scenes.calibration import plots
from simulations.scenes.calibration.boards import Boards
from simulations.scenes.calibration.drawing import LINE_AT, WIDTH, view_box
from simulations.scenes.calibration.settings import Settings
from simulations.scenes.calibration.stages import Result

INSIDE = 12.0
"""Least distance of that handle from the right border."""


def _line(settings: Settings, outputs: Outputs) -> Point | None:
    given: Boards = outputs["boards"]
    if outputs["developed"] is None:
        return None
    width, height = view_box(given.size)
    return min(settings.share * width, width - INSIDE), LINE_AT * height


def _line_pulled(_settings: Settings, place: Point) -> Mapping[str, Value]:
    return {"share": place[0] / WIDTH}


def _model(settings: Settings, outputs: Outputs) -> Point | None:
    result: Result | None = outputs["result"]
    if result is None:
        return None
    plot = plots.error_plot(outputs["trials"].found)
    return plot.clamped(plots.place_of(settings.lens), result.trial.left_out_px)


def _model_pulled(_settings: Settings, place: Point) -> Mapping[str, Value]:
    return {"lens": plots.lens_at(place)}


def _count(settings: Settings, outputs: Outputs) -> Point | None:
    result: Result | None = outputs["result"]
    if result is None or result.grown is None:
        return None
    given: Boards = outputs["boards"]
    return plots.place_of_count(result.grown, settings.photographs, given.true_focal)


def _count_pulled(_settings: Settings, place: Point) -> Mapping[str, Value]:
    return {"photographs": plots.count_at(place)}


HANDLES: tuple[Handle[Settings], ...] = (
    Handle("line", "photograph", "Dividing line", ("share",), _line, _line_pulled, role="image"),
    Handle(
        "model", "models", "Model of the lens", ("lens",), _model, _model_pulled, "press", "error"
    ),
    Handle(
        "count",
        "growth",
        "Count of photographs",
        ("photographs",),
        _count,
        _count_pulled,
        "press",
        "image",
    ),
)
