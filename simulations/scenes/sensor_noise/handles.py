"""Handles of the sensor-noise figure: the patch, in the picture and by its light on the
axis of the plot, and the floor of the noise."""

import math
from collections.abc import Mapping

from simulations.engine.controls import Value
from simulations.engine.handles import Handle, Point
from simulations.engine.plotting.plot import Plot
from simulations.engine.stages import Outputs
from simulations.scenes.sensor_noise.drawing import (
    COLUMNS,
    PATCH_SIDES,
    ROWS,
    floor_place,
    level_place,
    plot_of,
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


def _plot(settings: Settings) -> tuple[Plot, float]:
    """The plot, and electrons per code."""
    camera = sensor_of(settings.bits, settings.iso, settings.read_noise)
    return plot_of(curve_of(camera, settings.dark)), camera.gain_e_per_dn


def _values(plot: Plot, place: Point) -> tuple[float, float]:
    """Mean and variance of a place, clamped to the plot."""
    x = min(max(place[0], plot.x.start), plot.x.end)
    y = min(max(place[1], plot.y.end), plot.y.start)
    return plot.values((x, y))


def _level(settings: Settings, outputs: Outputs) -> Point | None:
    """Only for the wedge, as the light of a reader's patches is not ordered."""
    if outputs["photograph"]:
        return None
    plot, gain = _plot(settings)
    return level_place(plot, float(patch_means_e(settings.exposure)[settings.patch - 1]) / gain)


def _level_pulled(settings: Settings, place: Point) -> Mapping[str, Value]:
    plot, gain = _plot(settings)
    mean_e = _values(plot, place)[0] * gain
    patch = 1.0 + 2.0 * (settings.exposure - math.log2(mean_e / BRIGHTEST_E))
    # Values beyond an end of the axis are drawn at the end.
    beyond = 0.5 * ((place[0] <= plot.x.start) - (place[0] >= plot.x.end))
    return {"patch": patch + beyond}


def _floor(settings: Settings, _outputs: Outputs) -> Point:
    camera = sensor_of(settings.bits, settings.iso, settings.read_noise)
    curve = curve_of(camera, settings.dark)
    return floor_place(plot_of(curve), curve)


def _floor_pulled(settings: Settings, place: Point) -> Mapping[str, Value]:
    """The read noise that, with dark signal and rounding, makes this floor."""
    plot, gain = _plot(settings)
    others = floor_e2(sensor_of(settings.bits, settings.iso, 0.0), settings.dark)
    return {"read_noise": math.sqrt(max(_values(plot, place)[1] * gain**2 - others, 0.0))}


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
