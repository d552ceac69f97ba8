"""Light on a room that does not move: worked out at every point of every picture, or looked up in
maps that were made once."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from simulations.engine.ladder import Ladder, Metric, Tier
from simulations.models.arrays import Floats, Mask, Planes
from simulations.models.color.srgb import encode_srgb
from simulations.models.error_measures import root_mean_square
from simulations.models.projection.pinhole import intrinsics, look_at
from simulations.world.furniture import ROOM, WALLS
from simulations.world.light import lamp_direction, lamp_visibility
from simulations.world.light_maps import FINE_M, REACH, light_map
from simulations.world.radiance import ArrivingLight, Lighting
from simulations.world.room import light_of
from simulations.world.still_life import SceneObject
from simulations.world.surfaces import sky_visibility
from simulations.world.tracing import NUMBERED, Numbers

COLUMNS, ROWS = 240, 180
FOCAL_PX = 220.0
COARSE_M = (2 * FINE_M, 8 * FINE_M)


@dataclass(frozen=True, slots=True)
class View:
    """A camera in the room, and the light there."""

    pose: Floats
    """(4, 4) world to camera."""
    lighting: Lighting


def view_of(seed: int) -> View:
    """Cameras near the entrance that look at the still life, and lamps from either side."""
    rng = np.random.default_rng(seed)
    eye = rng.uniform((-2.5, -3.5, 0.9), (2.5, -1.0, 2.2))
    target = rng.uniform((-0.8, 2.5, 0.2), (0.8, 4.0, 0.8))
    return View(look_at(eye, target, (0.0, 0.0, 1.0)), Lighting(float(rng.uniform(-60.0, 60.0))))


@dataclass(frozen=True, slots=True)
class TracedLight:
    """The light, worked out anew at every point."""

    angle: float
    """Of the lamp, degrees."""

    @property
    def bounds(self) -> Floats:
        return light_map(self.angle).bounds

    def on_flat(self, surface: Numbers, points: Floats, normals: Floats) -> Floats:
        shares = np.empty((2, points.shape[1]), np.float32)
        everywhere = np.broadcast_to(surface, points.shape[1:])
        facing = np.broadcast_to(normals, points.shape)
        wall = everywhere < len(WALLS)
        parts: list[tuple[Mask, Sequence[SceneObject]]] = [(wall, ROOM)]
        parts += [
            (
                (everywhere >= first) & (everywhere < first + 6),
                [other for other in ROOM if other is not item],
            )
            for item, first in NUMBERED
        ]
        for where, others in parts:
            if (at := np.flatnonzero(where)).size:
                shares[:, at] = self._shares(points[:, at], facing[:, at], others)
        return shares

    def on_ball(self, surface: Numbers, points: Floats, normals: Floats) -> Floats:
        shares = np.empty((2, points.shape[1]), np.float32)
        for item, first in NUMBERED:
            if (at := np.flatnonzero(surface == first)).size:
                others = [other for other in ROOM if other is not item]
                shares[:, at] = self._shares(points[:, at], normals[:, at], others)
        return shares

    def _shares(self, points: Floats, normals: Floats, others: Sequence[SceneObject]) -> Floats:
        """(2, n) of the lamp and of the surroundings."""
        at, facing = points.T[None], normals.T[None]
        lamp = lamp_visibility(at, lamp_direction(self.angle), others)
        return np.stack([lamp[0], sky_visibility(at, facing, others, REACH)[0]])


def prepare(seed: int = 0) -> View:
    view = view_of(seed)
    for spacing in (FINE_M, *COARSE_M):
        light_map(view.lighting.angle, spacing)  # made once, and kept
    return view


def draw(index: int) -> View:
    """Another camera, and a lamp at another angle."""
    return prepare(index + 1)


def picture(view: View, light: ArrivingLight) -> Planes:
    """(3, H, W) linear RGB."""
    K = intrinsics(FOCAL_PX, ((COLUMNS - 1) / 2, (ROWS - 1) / 2))
    return light_of(K, view.pose, COLUMNS, ROWS, view.lighting, light)


def traced(view: View) -> Planes:
    return picture(view, TracedLight(view.lighting.angle))


def baked(view: View, *, spacing: float) -> Planes:
    return picture(view, light_map(view.lighting.angle, spacing))


def difference(result: Planes, truth: Planes) -> Floats:
    """Codes of 255, not rounded, as displayed."""
    return 255.0 * (encode_srgb(np.clip(result, 0, 1)) - encode_srgb(np.clip(truth, 0, 1)))


def rms_codes(result: Planes, truth: Planes, _view: View) -> float:
    return root_mean_square(difference(result, truth))


def worst_codes(result: Planes, truth: Planes, _view: View) -> float:
    return float(np.abs(difference(result, truth)).max())


LADDER = Ladder(
    id="baked-light",
    title="Light on what does not move",
    workload=f"a picture of the room, {COLUMNS} × {ROWS} pixels; the maps are made before",
    prepare=prepare,
    tiers=(
        Tier("traced", "At every point", "every object near it, for lamp and surroundings", traced),
        *(
            Tier(
                f"baked-{100 * spacing:.0f}",
                f"Maps, {100 * spacing:.0f} cm",
                f"1 look-up, nodes {100 * spacing:.0f} cm apart",
                partial(baked, spacing=spacing),
            )
            for spacing in (FINE_M, *COARSE_M)
        ),
    ),
    reference=traced,
    reference_label="the light at every point, worked out there",
    metrics=(
        Metric("rms", "RMS error", "codes", rms_codes),
        Metric("worst", "Largest error", "codes", worst_codes),
    ),
    draw=draw,
    default_tier=f"baked-{100 * FINE_M:.0f}",
    items=COLUMNS * ROWS,
)
