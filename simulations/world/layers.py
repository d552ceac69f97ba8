"""The lit still life in layers of one depth each, which a lens blurs one by one."""

from dataclasses import dataclass

import numpy as np

from simulations.models.arrays import Floats, Planes
from simulations.models.lens.depth_of_field import Layer
from simulations.models.light.raycasting import Vector
from simulations.world.light import lamp_direction, radiance
from simulations.world.still_life import WALL_DISTANCE
from simulations.world.surfaces import Surface


@dataclass(frozen=True, slots=True)
class LitScene:
    """Radiance at the lens, in layers of one depth each."""

    base: Planes
    """(3, H, W) wall and floor without the objects, linear RGB."""
    base_depth: Floats
    """(H, W) metres along the optical axis."""
    layers: tuple[Layer, ...]
    """The objects, farthest first."""
    depths: tuple[float, ...]
    """Depths of the layers, metres."""


def light(parts: tuple[Surface, ...], light_angle_deg: float, bounced: float = 1.0) -> LitScene:
    """Shade wall, floor and objects; ``bounced`` is the share of the light from the floor."""
    lamp = lamp_direction(light_angle_deg)
    wall, floor, *items = parts
    height = max(part.top + part.coverage.shape[0] for part in (wall, floor))
    width = wall.coverage.shape[1]
    base = np.zeros((3, height, width), np.float32)
    depth = np.zeros((height, width))
    for part in (wall, floor):
        rows = slice(part.top, part.top + part.coverage.shape[0])
        base[:, rows] += _premultiplied(part, lamp, bounced)[:3]
        depth[rows] += part.depth * part.coverage
    depth[depth == 0.0] = WALL_DISTANCE  # no ray reaches these pixels, which stay black
    lit = ((part, _premultiplied(part, lamp, bounced)) for part in items)
    layers = tuple(Layer(planes, part.top, part.left) for part, planes in lit)
    return LitScene(base, depth, layers, tuple(float(part.depth[0, 0]) for part in items))


def _premultiplied(part: Surface, lamp: Vector, bounced: float) -> Planes:
    """(4, h, w) radiance times coverage, then coverage."""
    planes = np.empty((4, *part.coverage.shape), np.float32)
    planes[3] = part.coverage
    np.multiply(radiance(part, lamp, bounced), planes[3], out=planes[:3])
    return planes
