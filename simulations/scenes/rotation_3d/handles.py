"""What of the rotation figure can be grabbed: the beads of the rings, the nose, and the ground.

The view is turned by the ground, like a globe: what is near follows the finger.
"""

import math
from collections.abc import Mapping
from functools import lru_cache, partial

import numpy as np

from simulations.engine.controls import Value
from simulations.engine.handles import Handle, Point
from simulations.engine.stages import Outputs
from simulations.models.arrays import Floats
from simulations.models.geometry.quaternion_blends import BLENDS
from simulations.scenes.rotation_3d import rings, sphere
from simulations.scenes.rotation_3d.aircraft import view_from
from simulations.scenes.rotation_3d.settings import Settings
from simulations.scenes.rotation_3d.stages import attitude

UNITS_PER_DEGREE = 2.0
"""Of dragging the ground, in view box units."""
CLOSE = 3.0
"""Two places of a ring, seen nearly edge on, are as good as one another within this."""
TURNS = {"yaw": 180, "pitch": 90, "roll": 180}
"""How far each angle goes to both sides, in degrees."""


def _bead(index: int, settings: Settings, _outputs: Outputs) -> Point:
    ring = _rings(settings)[index]
    return _pair(rings.on_screen(ring.at(ring.angle_rad), _view(settings)))


def _bead_pulled(index: int, settings: Settings, place: Point) -> Mapping[str, Value]:
    ring = _rings(settings)[index]
    limit = TURNS[ring.name]
    degrees = np.arange(-limit, limit + 1)
    track = rings.on_screen(ring.at(np.radians(degrees)), _view(settings))
    present = round(math.degrees(ring.angle_rad))
    apart = np.abs(np.remainder(degrees - present + 180, 360) - 180)
    return {ring.name: float(degrees[_nearest(track, place, apart)])}


def _nearest(track: Floats, place: Point, apart: Floats) -> int:
    """The index of the place of a track (n, 2…) that is nearest, of equals the least far ``apart``.

    Where a ring is seen edge on, its front and its back have the same places; the bead does not
    jump from one to the other.
    """
    off = np.hypot(track[:, 0] - place[0], track[:, 1] - place[1])
    close = np.flatnonzero(off <= off.min() + CLOSE)
    index = int(close[np.argmin(apart[close])])
    while True:
        around = range(max(index - 1, 0), min(index + 2, len(off)))
        best = min(around, key=lambda i: float(off[i]))
        if off[best] >= off[index]:
            return index
        index = best


def _nose(settings: Settings, outputs: Outputs) -> Point:
    blend = outputs["ways"][settings.blend](settings.t)
    return _pair(sphere.on_screen(blend[:, 0], _view(settings)))


def _nose_pulled(settings: Settings, place: Point, tier: str) -> Mapping[str, Value]:
    way = _way(settings.yaw, settings.pitch, settings.roll, settings.blend, tier)
    track = sphere.on_screen(way, _view(settings))
    shares = np.arange(len(way))
    index = _nearest(track, place, np.abs(shares - round(100 * settings.t)))
    return {"t": index / 100}


@lru_cache(maxsize=4)
def _way(yaw: float, pitch: float, roll: float, blend: str, tier: str) -> Floats:
    """The nose (101, 3) at each hundredth of the chosen way."""
    here = attitude(yaw, pitch, roll)
    ways = sphere.ways(here.angles_rad, here.R, here.q, BLENDS[tier])
    return ways[blend](np.linspace(0.0, 1.0, 101))[:, :, 0]


def _ground(settings: Settings, _outputs: Outputs) -> Point:
    return UNITS_PER_DEGREE * settings.azimuth, UNITS_PER_DEGREE * settings.elevation


def _ground_pulled(_settings: Settings, place: Point) -> Mapping[str, Value]:
    turn, tilt = (value / UNITS_PER_DEGREE for value in place)
    return {"azimuth": (turn + 180.0) % 360.0 - 180.0, "elevation": tilt}


def _rings(settings: Settings) -> tuple[rings.Ring, rings.Ring, rings.Ring]:
    angles = (math.radians(value) for value in (settings.yaw, settings.pitch, settings.roll))
    return rings.rings(*angles)


def _view(settings: Settings) -> Floats:
    return view_from(settings.azimuth, settings.elevation)


def _pair(place: Floats) -> Point:
    return float(place[0]), float(place[1])


def _ring(index: int, name: str, role: str) -> Handle[Settings]:
    at, pull = partial(_bead, index), partial(_bead_pulled, index)
    return Handle(name, "attitude", f"{name.capitalize()} ring", (name,), at, pull, role=role)


def _turned(panel: str) -> Handle[Settings]:
    return Handle(
        f"view-{panel}",
        panel,
        "View",
        ("azimuth", "elevation"),
        _ground,
        _ground_pulled,
        reach="drag",
        reversed=("elevation",),
    )


HANDLES: tuple[Handle[Settings], ...] = (
    _ring(0, "yaw", "world"),
    _ring(1, "pitch", "light"),
    _ring(2, "roll", "ray"),
    _turned("attitude"),
    Handle("nose", "blend", "Nose on its way", ("t",), _nose, _nose_pulled, role="camera"),
    _turned("blend"),
)
