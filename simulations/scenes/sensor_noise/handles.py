"""What of the sensor-noise figure can be grabbed: the patch, in the picture and by its light on the
axis of the plot, and the floor of the noise."""

import math
from collections.abc import Mapping

from simulations.engine.controls import Value
from simulations.engine.handles import Handle, Point
from simulations.engine.stages import Outputs
from simulations.scenes.sensor_noise.drawing import (
    COLUMNS,
    LEFT,
    PATCH_SIDES,
    RIGHT,
    ROWS,
    Axes,
    axes_for,
    floor_place,
    level_place,
)
from simulations.scenes.sensor_noise.settings import Settings
from simulations.scenes.sensor_noise.stages import (
    BRIGHTEST_E,
    curve_of,
    floor_e2,
    patch_means_e,
    sensor_of,
)


def _patch(settings: Settings, _outputs: Outputs) -> Point:
    row, column = divmod(settings.patch - 1, COLUMNS)
    return ((column + 0.5) * PATCH_SIDES[0], (row + 0.5) * PATCH_SIDES[1])


def _patch_pulled(_settings: Settings, place: Point) -> Mapping[str, Value]:
    column = min(max(math.floor(place[0] / PATCH_SIDES[0]), 0), COLUMNS - 1)
    row = min(max(math.floor(place[1] / PATCH_SIDES[1]), 0), ROWS - 1)
    return {"patch": row * COLUMNS + column + 1}


def _axes(settings: Settings) -> tuple[Axes, float]:
    """The axes of the plot, and electrons per code."""
    camera = sensor_of(settings.bits, settings.iso, settings.read_noise)
    return axes_for(curve_of(camera, settings.dark)), camera.gain_e_per_dn


def _level(settings: Settings, outputs: Outputs) -> Point | None:
    """Of the wedge alone: the light of a reader's patches is in no order."""
    if outputs["photograph"]:
        return None
    axes, gain = _axes(settings)
    return level_place(axes, float(patch_means_e(settings.exposure)[settings.patch - 1]) / gain)


def _level_pulled(settings: Settings, place: Point) -> Mapping[str, Value]:
    axes, gain = _axes(settings)
    mean_e = axes.values(place)[0] * gain
    patch = 1.0 + 2.0 * (settings.exposure - math.log2(mean_e / BRIGHTEST_E))
    # All that lies beyond an end of the axis is drawn there: not short of it.
    beyond = 0.5 * ((place[0] <= LEFT) - (place[0] >= RIGHT))
    return {"patch": patch + beyond}


def _floor(settings: Settings, _outputs: Outputs) -> Point:
    camera = sensor_of(settings.bits, settings.iso, settings.read_noise)
    curve = curve_of(camera, settings.dark)
    return floor_place(axes_for(curve), curve)


def _floor_pulled(settings: Settings, place: Point) -> Mapping[str, Value]:
    """The read noise that adds to dark signal and rounding what is missing to this floor."""
    axes, gain = _axes(settings)
    others = floor_e2(sensor_of(settings.bits, settings.iso, 0.0), settings.dark)
    return {"read_noise": math.sqrt(max(axes.values(place)[1] * gain**2 - others, 0.0))}


HANDLES: tuple[Handle[Settings], ...] = (
    Handle("patch", "wedge", "Patch", ("patch",), _patch, _patch_pulled, "press", "image"),
    Handle(
        "level",
        "transfer",
        "Light of the patch",
        ("patch",),
        _level,
        _level_pulled,
        "press",
        "image",
        reversed=("patch",),
    ),
    Handle(
        "floor",
        "transfer",
        "Floor of the noise",
        ("read_noise",),
        _floor,
        _floor_pulled,
        role="error",
    ),
)
