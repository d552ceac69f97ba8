"""Handles of the rotation figure: the line of sight on its path, and the background."""

from collections.abc import Mapping
from functools import lru_cache

import numpy as np

from simulations.engine.controls import Value
from simulations.engine.handles import Handle, Point
from simulations.engine.stages import Outputs
from simulations.models.arrays import Floats
from simulations.models.geometry.quaternion_blends import BLENDS
from simulations.scenes._turned_camera.body import view_from
from simulations.scenes._turned_camera.turning import background, nearest, pair
from simulations.scenes.rotation_3d import progress, sphere
from simulations.scenes.rotation_3d.settings import Settings
from simulations.scenes.rotation_3d.stages import orientation


def _sight(settings: Settings, outputs: Outputs) -> Point:
    blend = outputs["paths"][settings.blend](settings.t)
    return pair(sphere.on_screen(blend[:, 2], _view(settings)))


def _sight_pulled(settings: Settings, place: Point, tier: str) -> Mapping[str, Value]:
    path = _path(settings.pan, settings.tilt, settings.roll, settings.blend, tier)
    track = sphere.on_screen(path, _view(settings))
    shares = np.arange(len(path))
    index = nearest(track, place, np.abs(shares - round(100 * settings.t)))
    return {"t": index / 100}


@lru_cache(maxsize=4)
def _path(pan: float, tilt: float, roll: float, blend: str, tier: str) -> Floats:
    """The line of sight (101, 3) at each hundredth of the chosen path."""
    here = orientation(pan, tilt, roll)
    paths = sphere.paths(here.angles_rad, here.C, here.q, BLENDS[tier])
    return paths[blend](np.linspace(0.0, 1.0, 101))[:, :, 2]


def _mark(settings: Settings, outputs: Outputs) -> Point:
    return progress.mark(outputs["paths"], settings.blend, settings.t)


def _mark_pulled(_settings: Settings, place: Point) -> Mapping[str, Value]:
    return {"t": progress.progress_at(place[0])}


def _view(settings: Settings) -> Floats:
    return view_from(settings.azimuth, settings.elevation)


HANDLES: tuple[Handle[Settings], ...] = (
    Handle("sight", "blend", "Line of sight", ("t",), _sight, _sight_pulled, role="camera"),
    Handle(
        "progress", "progress", "Mark on the curves", ("t",), _mark, _mark_pulled, "press", "camera"
    ),
    background("blend"),
)
