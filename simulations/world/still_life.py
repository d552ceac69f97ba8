"""The still life: balls and boxes on a chequered floor, from 1.7 to 8 metres away.

World axes: x right, y away from the camera, z up, metres; the floor is z = 0. Each object is ray
cast and lit by itself, including its hidden parts, so that blur by a lens can reveal them later.
"""

from dataclasses import KW_ONLY, dataclass

import numpy as np

from simulations.models.arrays import Floats, Mask
from simulations.models.light.raycasting import Box, Sphere, Vector
from simulations.models.projection import pinhole


@dataclass(frozen=True, slots=True)
class SceneObject:
    """An object of the still life."""

    name: str
    solid: Sphere | Box
    albedo: Vector
    """Linear RGB reflectance."""
    _: KW_ONLY
    second_albedo: Vector | None = None
    """Colour of the stripes, if there are any."""
    stripe_count: int = 0
    gloss: float = 0.0
    """Strength of the highlight."""
    shininess: float = 60.0


def resting(x: float, y: float, radius: float) -> Sphere:
    """A ball on the floor."""
    return Sphere((x, y, radius), radius)


OBJECTS = (
    SceneObject("red ball", resting(-0.30, 1.85, 0.15), (0.62, 0.05, 0.045), gloss=0.35),
    SceneObject("blue box", Box((0.52, 2.55, 0.17), (0.34, 0.34, 0.34), 0.5), (0.06, 0.19, 0.46)),
    SceneObject(
        "striped ball",
        resting(-0.10, 3.25, 0.33),
        (0.80, 0.40, 0.04),
        second_albedo=(0.80, 0.74, 0.62),
        stripe_count=9,
        gloss=0.12,
    ),
    SceneObject(
        "green ball", resting(-1.15, 4.4, 0.44), (0.10, 0.36, 0.15), gloss=0.15, shininess=25
    ),
    SceneObject("pearl", resting(1.15, 5.1, 0.55), (0.74, 0.71, 0.69), gloss=0.4, shininess=90),
    SceneObject("plum box", Box((-1.75, 6.5, 0.6), (0.8, 0.7, 1.2), -0.35), (0.33, 0.10, 0.26)),
)
"""The objects, nearest first. No two overlap."""

WALL_DISTANCE = 8.0  # distance of the back wall, metres along y
WALL_HEIGHT = 4.0
"""Height up to which the wall hides the sky from the floor, metres; it is drawn infinitely high."""

EYE: Vector = (0.0, 0.0, 0.5)
TARGET: Vector = (0.0, 4.0, 0.32)
WORLD_TO_CAMERA = pinhole.look_at(EYE, TARGET, (0.0, 0.0, 1.0))
"""(4, 4) pose; camera axes x right, y down, z forward."""


@dataclass(frozen=True, slots=True, kw_only=True)
class WorldRays:
    """The rays of all pixels, in the world."""

    directions: Floats
    """(H, W, 3) unit vectors."""
    valid: Mask
    """(H, W) false where the lens sends no ray to the pixel."""
    eye: Vector = EYE
    """Origin of all rays: the lens's centre, or another point of its opening."""
    back: float = 0.0
    """Distance of the lens behind `EYE`, along its axis: metres."""
    area: bool = True
    """Whether a pixel takes the mean over its area, or a sample in its middle."""
    float32_from: float | None = None
    """Distance of the origin of float32 coordinates of the hit points, metres; ``None`` for
    float64."""

    def as_stored(self, points: Floats) -> Floats:
        """World points (..., 3), rounded to the precision in which they are stored."""
        if self.float32_from is None:
            return points
        origin = self.float32_from * np.array([0.6, 0.64, 0.48])
        return np.asarray((points + origin).astype(np.float32) - origin)


def eye(back: float = 0.0, right: float = 0.0, down: float = 0.0) -> Vector:
    """A point of the lens, metres from its centre, after a step back along the axis."""
    across = WORLD_TO_CAMERA[:3, :3]
    x, y, z = np.asarray(EYE) + right * across[0] + down * across[1] - back * across[2]
    return (float(x), float(y), float(z))


def view(rays_camera: Floats, valid: Mask | None = None, back: float = 0.0) -> WorldRays:
    """``rays_camera`` (H, W, 3) with z = 1, rotated to the world and scaled to unit length."""
    legal = np.ones(rays_camera.shape[:2], bool) if valid is None else valid
    return WorldRays(
        directions=_unit(rays_camera) @ WORLD_TO_CAMERA[:3, :3],
        valid=legal,
        eye=eye(back),
        back=back,
    )


def view_through(
    rays_camera: Floats, valid: Mask, at: tuple[float, float], focus: float, back: float = 0.0
) -> WorldRays:
    """The view from the point ``at`` = (right, down) of the lens, metres from its centre.

    Every ray meets the one through the lens's centre at the depth ``focus``, metres, as a thin lens
    images both to the same pixel.
    """
    right, down = at
    turned = rays_camera - np.array([right / focus, down / focus, 0.0])
    return WorldRays(
        directions=_unit(turned) @ WORLD_TO_CAMERA[:3, :3],
        valid=valid,
        eye=eye(back, right, down),
        back=back,
    )


def _unit(vectors: Floats) -> Floats:
    return vectors / np.sqrt(np.einsum("...i,...i", vectors, vectors))[..., None]


def depth_along_axis(points: Floats) -> Floats:
    """Distance (...) of world points (..., 3) from `EYE`, along the optical axis: metres."""
    return points @ WORLD_TO_CAMERA[2, :3] + WORLD_TO_CAMERA[2, 3]


def object_depth(item: SceneObject) -> float:
    """Depth of the object's centre along the optical axis, metres."""
    return float(depth_along_axis(np.asarray(item.solid.centre)))
