"""The light in a room where nothing but the camera moves: computed anew, or looked up in maps."""

from functools import partial

import numpy as np
from numpy.typing import ArrayLike

from simulations.engine.ladder import Ladder, Metric, Tier
from simulations.models.arrays import Floats, Planes
from simulations.models.color.srgb import encode_srgb
from simulations.models.error_measures import root_mean_square
from simulations.models.light.raycasting import Sphere
from simulations.models.light.soft_shadows import sphere_occlusion, visibility
from simulations.models.projection.pinhole import intrinsics, look_at
from simulations.world.furniture import HIGH, LOW, ROOM
from simulations.world.light import LAMP_RADIUS_RAD
from simulations.world.light_maps import REACH, TracedLight, light_map, traced_light
from simulations.world.radiance import DAY, Samples, radiance
from simulations.world.room import samples_of
from simulations.world.tracing import Numbers, camera_at

COLUMNS, ROWS = 200, 150
SPACINGS_CM = (32, 16, 8, 4, 2)


def prepare() -> Samples:
    """What a camera sees that stands at the entrance of the room."""
    return _seen((-0.25, -1.2, 1.2), (-0.25, 8.0, 1.2), 0.8)


def draw(index: int) -> Samples:
    """From another place, towards another one, through another lens."""
    rng = np.random.default_rng(index)
    eye = rng.uniform((LOW[0] + 0.5, LOW[1] + 0.5, 0.5), (HIGH[0] - 0.5, 1.5, 3.0))
    target = rng.uniform((-2.0, 2.0, 0.0), (2.0, 6.5, 1.0))
    return _seen(eye, target, rng.uniform(0.5, 1.5))


def _seen(eye: ArrayLike, target: ArrayLike, focal: float) -> Samples:
    """Through a lens as long as ``focal`` times the width of the picture."""
    K = intrinsics(focal * COLUMNS, ((COLUMNS - 1) / 2, (ROWS - 1) / 2))
    return samples_of(camera_at(K, look_at(eye, target, (0.0, 0.0, 1.0))), COLUMNS, ROWS)[0]


class EveryThing(TracedLight):
    """The shares at every point, from every thing, however far away, in float64."""

    def on_flat(self, _surface: Numbers, points: Floats, normals: Floats) -> Floats:
        at = points.T.astype(float)
        facing = np.broadcast_to(normals.T, at.shape).astype(float)
        shares = np.ones((2, len(at)))
        for solid in (thing.solid for thing in ROOM):
            shares[0] *= visibility(solid, at, self.lamp, LAMP_RADIUS_RAD)
            radius = solid.radius if isinstance(solid, Sphere) else 0.6 * min(solid.size)
            hidden = sphere_occlusion(solid.centre, radius, at, facing)
            shares[1] *= 1.0 - np.maximum(hidden - REACH**-2, 0.0)
        return shares

    on_ball = on_flat


def looked_up(samples: Samples, *, spacing_cm: int) -> Planes:
    return radiance(samples, light_map(DAY.angle, spacing_cm / 100), DAY)


def traced(samples: Samples) -> Planes:
    return radiance(samples, traced_light(DAY.angle), DAY)


def reference(samples: Samples) -> Planes:
    known = traced_light(DAY.angle)
    return radiance(samples, EveryThing(known.lamp, known.bounds), DAY)


def _apart(result: Planes, truth: Planes) -> Floats:
    """Differences in codes of 255."""
    return 255.0 * (encode_srgb(result.astype(float)) - encode_srgb(truth.astype(float)))


def rms(result: Planes, truth: Planes, _samples: Samples) -> float:
    return root_mean_square(_apart(result, truth))


def worst(result: Planes, truth: Planes, _samples: Samples) -> float:
    return float(np.abs(_apart(result, truth)).max())


LADDER = Ladder(
    id="standing-light",
    title="Light that stands still",
    workload=f"{COLUMNS} × {ROWS} pixels of the room, of which only the camera moves",
    prepare=prepare,
    tiers=(
        *(
            Tier(
                f"map-{spacing}",
                f"Looked up in a map, nodes {spacing} cm apart",
                "2 × 4 nodes a pixel",
                partial(looked_up, spacing_cm=spacing),
            )
            for spacing in SPACINGS_CM
        ),
        Tier("traced", "Computed in every pixel", "shadows of up to 17 things a pixel", traced),
    ),
    reference=reference,
    reference_label="every thing in every pixel, in float64",
    metrics=(
        Metric("rms", "RMS error", "codes", rms),
        Metric("worst", "Largest error", "codes", worst),
    ),
    draw=draw,
    default_tier="map-2",
    items=COLUMNS * ROWS,
)
