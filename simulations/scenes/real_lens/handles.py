"""Handles of the figure of a real lens: the marked ray, from the side and on the curve,
both surfaces, the object, and the opening."""

from collections.abc import Mapping

from simulations.engine.controls import Value
from simulations.engine.handles import Handle, Point
from simulations.engine.stages import Outputs
from simulations.scenes.real_lens import plots, section
from simulations.scenes.real_lens.settings import Settings
from simulations.scenes.real_lens.stages import object_mm


def _view(settings: Settings) -> section.View:
    return section.view_of(object_mm(settings.vergence))


def _ray(settings: Settings, _outputs: Outputs) -> Point:
    return section.entry_mark(_view(settings), settings.height, object_mm(settings.vergence))


def _ray_pulled(settings: Settings, place: Point) -> Mapping[str, Value]:
    distance = object_mm(settings.vergence)
    return {"height": section.height_of(_view(settings), place, distance)}


def _front(settings: Settings, _outputs: Outputs) -> Point:
    return section.surface_mark(_view(settings), settings, front=True)


def _front_pulled(settings: Settings, place: Point) -> Mapping[str, Value]:
    return {"front": section.bulge_of(_view(settings), place, settings.thickness, front=True)}


def _back(settings: Settings, _outputs: Outputs) -> Point:
    return section.surface_mark(_view(settings), settings, front=False)


def _back_pulled(settings: Settings, place: Point) -> Mapping[str, Value]:
    return {"back": section.bulge_of(_view(settings), place, settings.thickness, front=False)}


def _opening(settings: Settings, _outputs: Outputs) -> Point:
    return plots.opening_mark(settings.opening)


def _opening_pulled(_settings: Settings, place: Point) -> Mapping[str, Value]:
    return {"opening": plots.height_at(place)}


def _object(settings: Settings, _outputs: Outputs) -> Point | None:
    return section.object_mark(object_mm(settings.vergence))


def _object_pulled(_settings: Settings, place: Point) -> Mapping[str, Value]:
    return {"vergence": 1000.0 / section.object_of(place)}


def _on_curve(settings: Settings, outputs: Outputs) -> Point:
    return plots.mark(outputs["glass"], outputs["marked"], settings.height)


def _on_curve_pulled(_settings: Settings, place: Point) -> Mapping[str, Value]:
    return {"height": plots.height_at(place)}


HANDLES: tuple[Handle[Settings], ...] = (
    Handle("ray", "lens", "Marked ray", ("height",), _ray, _ray_pulled, role="ray"),
    Handle(
        "front",
        "lens",
        "Front surface",
        ("front",),
        _front,
        _front_pulled,
        role="camera",
    ),
    Handle(
        "back",
        "lens",
        "Back surface",
        ("back",),
        _back,
        _back_pulled,
        role="camera",
        reversed=("back",),
    ),
    Handle(
        "object",
        "lens",
        "Object",
        ("vergence",),
        _object,
        _object_pulled,
        role="world",
        reversed=("vergence",),
    ),
    Handle("opening", "aberration", "Edge of the opening", ("opening",), _opening, _opening_pulled),
    Handle(
        "curve",
        "aberration",
        "Marked ray",
        ("height",),
        _on_curve,
        _on_curve_pulled,
        "press",
        "ray",
    ),
)
