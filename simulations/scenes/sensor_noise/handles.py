"""Handles of the sensor-noise figure: the light of the chosen patch on the axis of the plot, and
the patch in the picture."""

import math
from collections.abc import Mapping

from simulations.engine.controls import Value
from simulations.engine.handles import Handle, Point
from simulations.engine.plotting.plot import Plot
from simulations.engine.stages import Outputs
from simulations.scenes.sensor_noise.drawing import (
    COLUMNS,
    HEIGHT,
    PATCH_SIDES,
    ROWS,
    WIDTH,
    level_place,
    plot_of,
)
from simulations.scenes.sensor_noise.settings import Settings
from simulations.scenes.sensor_noise.stages import (
    curve_of,
    patch_means_e,
    sensor_of,
)


def _middle(_settings: Settings, _outputs: Outputs) -> Point:
    return WIDTH / 2, HEIGHT / 2


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
    """The exposure at which the chosen patch receives the light of this mean."""
    plot, gain = _plot(settings)
    at_0_ev = float(patch_means_e(0.0)[settings.patch - 1])
    return {"exposure": math.log2(_values(plot, place)[0] * gain / at_0_ev)}


HANDLES: tuple[Handle[Settings], ...] = (
    Handle("level", "transfer", "Light", ("exposure",), _level, _level_pulled, "press", "image"),
    Handle("patch", "wedge", "Patch to look at", ("patch",), _middle, _patch_pulled, "aim"),
)
