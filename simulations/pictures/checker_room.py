"""A room full of straight lines: chequered floor, beams, panels, a window.

It is a box, seen from inside, with walls parallel to the picture's axes. Camera axes: x right, y
down, z into the picture; lengths in metres; the eye is at the origin. Linear RGB, 1 = paper white.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats, Mask, centred
from simulations.models.geometry.quaternions import check_rotation
from simulations.models.require import as_whole, require_positive
from simulations.pictures.patterns import band, blend, checker, stripes

LOW = (-2.35, -1.75, -1.0)  # left wall, ceiling, and a wall behind the eye (never seen)
HIGH = (2.75, 1.35, 5.2)  # right wall, floor, back wall
TRIM_M = 0.09  # mouldings along every edge of the room, in one colour on both sides
WINDOW = (-1.15, 0.85, -1.2, 0.38)  # left, right, top, bottom of the window in the back wall

PLASTER, TRIM, OCHRE = (0.62, 0.56, 0.47), (0.80, 0.77, 0.70), (0.52, 0.31, 0.12)
SLATE, CREAM, WOOD = (0.050, 0.075, 0.095), (0.72, 0.66, 0.55), (0.12, 0.062, 0.030)
TEAL, BRICK, CEILING = (0.075, 0.20, 0.21), (0.42, 0.10, 0.055), (0.72, 0.69, 0.63)
SKY_TOP, SKY_LOW = (0.30, 0.55, 0.95), (0.98, 0.95, 0.86)


@dataclass(frozen=True, slots=True, kw_only=True)
class Hits:
    """The points at which the rays of some pixels meet a wall."""

    x: Floats
    y: Floats
    z: Floats
    size_x: Floats
    """Extent of a pixel's footprint on the wall along x, in metres; likewise y, z."""
    size_y: Floats
    size_z: Floats


def checker_room(width: int, height: int, focal_px: float, turn: ArrayLike | None = None) -> Floats:
    """The room through a pinhole whose axis meets the centre of the picture.

    ``turn`` (3, 3) takes directions in the room to the camera's; without it, the camera looks
    straight at the back wall. The wall behind the eye must stay out of the picture.

    Returns
    -------
    (height, width, 3) float32 linear RGB. Raises ValueError unless sizes and ``focal_px`` are
    positive.
    """
    width, height = as_whole("width", width, 1), as_whole("height", height, 1)
    require_positive("focal_px", focal_px)
    x = np.broadcast_to(centred(width).astype(np.float32) / focal_px, (height, width))
    y = np.broadcast_to((centred(height).astype(np.float32) / focal_px)[:, None], x.shape)
    back = np.eye(3) if turn is None else check_rotation(turn).T
    across, down = (back[:, :2].T / focal_px).astype(np.float32)
    rays = [np.float32(a) * x + np.float32(b) * y + np.float32(c) for a, b, c in back]
    # Never exactly parallel to a wall, which the ray would not meet.
    ray_x, ray_y, ray_z = (np.where(ray == 0.0, np.float32(1e-6), ray) for ray in rays)
    wall_x = np.where(ray_x < 0.0, LOW[0], HIGH[0]).astype(np.float32)
    wall_y = np.where(ray_y < 0.0, LOW[1], HIGH[1]).astype(np.float32)
    wall_z = np.where(ray_z < 0.0, np.inf, HIGH[2]).astype(np.float32)
    depth_x, depth_y, depth_z = wall_x / ray_x, wall_y / ray_y, np.abs(wall_z / ray_z)
    nearest = np.minimum(np.minimum(depth_x, depth_y), depth_z)
    picture = np.zeros((height, width, 3), np.float32)
    surfaces: tuple[tuple[Mask, int, Callable[[Hits], Floats]], ...] = (
        (nearest == depth_z, 2, _back_wall),
        ((nearest == depth_y) & (ray_y > 0.0), 1, _floor),
        ((nearest == depth_y) & (ray_y < 0.0), 1, _ceiling),
        ((nearest == depth_x) & (ray_x < 0.0), 0, _left_wall),
        ((nearest == depth_x) & (ray_x > 0.0), 0, _right_wall),
    )
    for mask, axis, paint in surfaces:
        ray = [part[mask] for part in (ray_x, ray_y, ray_z)]
        picture[mask] = paint(_hits(ray, nearest[mask], axis, across, down))
    return picture


def _hits(ray: list[Floats], depth: Floats, axis: int, across: Floats, down: Floats) -> Hits:
    """Hit points P = c · ray / ray_axis, and the footprints of pixels from its derivatives.

    ``across`` and ``down`` (3,) are the changes of a ray from a pixel to the next.
    """
    sizes = []
    for i in range(3):
        slope = ray[i] / ray[axis]
        steps = (np.abs(step[i] - slope * step[axis]) for step in (across, down))
        sizes.append(np.maximum(depth * sum(steps), np.float32(1e-6)))
    (x, y, z), (size_x, size_y, size_z) = (component * depth for component in ray), sizes
    return Hits(x=x, y=y, z=z, size_x=size_x, size_y=size_y, size_z=size_z)


def _floor(p: Hits) -> Floats:
    tiles = checker(p.x + 0.25, p.z, 0.5, p.size_x, p.size_z)
    colour = blend(_flat(CREAM, p.x), SLATE, tiles)
    colour = colour * _daylight(p, (0.0, -1.0, 0.0))[..., None]
    # The reflection of the window in polished stone: its mirror image, faint and stretched.
    mirror = band(p.x / p.z, -0.17, 0.13, 0.05) * band(1.0 / p.z, 0.235, 0.40, 0.06)
    colour = colour + np.asarray((0.20, 0.21, 0.22), np.float32) * mirror[..., None]
    return _with_trim(colour, p, "xz")


def _ceiling(p: Hits) -> Floats:
    colour: Floats = _flat(CEILING, p.x) * _daylight(p, (0.0, 1.0, 0.0))[..., None]
    beams = stripes(p.z - 0.45, 0.9, 0.17, p.size_z)
    colour = blend(colour, np.asarray(WOOD) * 1.3, beams)
    return _with_trim(colour, p, "xz")


def _back_wall(p: Hits) -> Floats:
    colour: Floats = _flat(PLASTER, p.x) * _daylight(p, (0.0, 0.0, -1.0))[..., None]
    colour = blend(colour, np.asarray(TEAL) * 0.8, band(p.y, 0.62, HIGH[1], p.size_y))
    panel = (1.0 - stripes(p.x - LOW[0], 0.85, 0.16, p.size_x)) * band(p.y, 0.76, 1.14, p.size_y)
    colour = blend(colour, np.asarray(TEAL) * 1.25, panel)
    colour = blend(colour, np.asarray(TRIM) * 0.62, band(p.y, 0.56, 0.62, p.size_y))
    left, right, top, bottom = WINDOW
    colour = blend(colour, np.asarray(TRIM) * 0.8, _rectangle(p, left, right, top, bottom))
    sky = _sky(np.clip((p.y - top) / (bottom - top), 0.0, 1.0))
    inner = _rectangle(p, left + 0.07, right - 0.07, top + 0.07, bottom - 0.07)
    pane_x, pane_y = (right - left) / 4.0, (bottom - top) / 3.0
    bars = _glazing_bars(p.x - left, pane_x, p.size_x, p.y - top, pane_y, p.size_y)
    colour = blend(colour, sky, inner * (1.0 - bars))
    colour = _framed(colour, p, (1.35, 2.2, -0.8, 0.2), OCHRE)
    colour = _framed(colour, p, (-2.0, -1.5, -0.65, 0.1), BRICK)
    return _with_trim(colour, p, "xy")


def _left_wall(p: Hits) -> Floats:
    colour = _panelled_wall(p, (1.0, 0.0, 0.0))
    for z0, z1 in ((1.6, 2.5), (3.35, 4.25)):
        height = (p.y + 1.05) / 1.35
        sky = _sky(np.clip(height, 0.0, 1.0))
        outer = band(p.z, z0, z1, p.size_z) * band(p.y, -1.05, 0.30, p.size_y)
        inner = band(p.z, z0 + 0.08, z1 - 0.08, p.size_z) * band(p.y, -0.97, 0.22, p.size_y)
        bars = _glazing_bars(p.z - z0, (z1 - z0) / 3.0, p.size_z, p.y + 1.05, 0.45, p.size_y)
        colour = blend(colour, np.asarray(TRIM) * 0.75, outer)
        colour = blend(colour, sky, inner * (1.0 - bars))
    return _with_trim(colour, p, "zy")


def _right_wall(p: Hits) -> Floats:
    colour = _panelled_wall(p, (-1.0, 0.0, 0.0))
    pictures = ((1.45, 2.15, BRICK), (2.6, 3.3, TEAL), (3.75, 4.45, OCHRE))
    for z0, z1, paint in pictures:
        frame = band(p.z, z0, z1, p.size_z) * band(p.y, -0.95, 0.15, p.size_y)
        inner = band(p.z, z0 + 0.07, z1 - 0.07, p.size_z) * band(p.y, -0.88, 0.08, p.size_y)
        lower = inner * band(p.y, -0.30, 0.08, p.size_y)
        colour = blend(colour, np.asarray(WOOD) * 0.8, frame)
        colour = blend(colour, np.asarray(paint) * 0.75, inner)
        colour = blend(colour, np.asarray(CREAM) * 0.6, lower)
    return _with_trim(colour, p, "zy")


def _panelled_wall(p: Hits, normal: tuple[float, float, float]) -> Floats:
    """Plaster above, panels below a rail, both between upright battens."""
    light = _daylight(p, normal)
    colour = _flat(PLASTER, p.x)
    colour = blend(colour, TEAL, band(p.y, 0.62, HIGH[1], p.size_y))
    panel = 1.0 - stripes(p.z, 0.7, 0.16, p.size_z)
    panel = panel * band(p.y, 0.76, 1.14, p.size_y)
    colour = blend(colour, np.asarray(TEAL) * 1.9, panel) * light[..., None]
    rail = band(p.y, 0.56, 0.62, p.size_y) + band(p.y, -1.28, -1.24, p.size_y)
    colour = blend(colour, np.asarray(TRIM) * 0.62, rail)
    return _with_trim(colour, p, "zy")


def _framed(
    colour: Floats, p: Hits, box: tuple[float, float, float, float], paint: tuple[float, ...]
) -> Floats:
    """A picture on the back wall: dark frame, one flat colour, a pale horizon."""
    x0, x1, y0, y1 = box
    colour = blend(colour, np.asarray(WOOD) * 0.8, _rectangle(p, x0, x1, y0, y1))
    inner = _rectangle(p, x0 + 0.06, x1 - 0.06, y0 + 0.06, y1 - 0.06)
    return blend(colour, np.asarray(paint) * 0.8, inner)


def _rectangle(p: Hits, left: float, right: float, top: float, bottom: float) -> Floats:
    return band(p.x, left, right, p.size_x) * band(p.y, top, bottom, p.size_y)


def _glazing_bars(
    u: Floats, pane_u: float, size_u: Floats, v: Floats, pane_v: float, size_v: Floats
) -> Floats:
    """Glazing bars 5 cm wide in both directions."""
    clear: Floats = (1.0 - stripes(u, pane_u, 0.05, size_u)) * (
        1.0 - stripes(v, pane_v, 0.05, size_v)
    )
    return 1.0 - clear


def _sky(downwards: Floats) -> Floats:
    """Blue above (0), pale at the horizon (1)."""
    top, low = np.asarray(SKY_TOP, np.float32), np.asarray(SKY_LOW, np.float32)
    return top + (low - top) * downwards[..., None]


def _flat(colour: tuple[float, ...], like: Floats) -> Floats:
    return np.broadcast_to(np.asarray(colour, np.float32), (*like.shape, 3))


def _daylight(p: Hits, normal: tuple[float, float, float]) -> Floats:
    """Lambert's law for the window as a small lamp, plus ambient light."""
    to_x, to_y, to_z = -0.3 - p.x, -0.6 - p.y, HIGH[2] - 1.0 - p.z
    distance2 = to_x**2 + to_y**2 + to_z**2 + 0.9
    facing = normal[0] * to_x + normal[1] * to_y + normal[2] * to_z
    direct = 3.4 * np.maximum(facing, 0.0) / (distance2 * np.sqrt(distance2))
    return (0.60 + direct) * _corner_shade(p)


def _corner_shade(p: Hits) -> Floats:
    """Corners see less of the room and are darker; equal on both sides of every edge."""
    shade = np.ones_like(p.x)
    for position, low, high in ((p.x, LOW[0], HIGH[0]), (p.y, LOW[1], HIGH[1])):
        for distance in (position - low, high - position):
            shade = shade * (1.0 - 0.30 * np.exp(-np.abs(distance) / 0.45))
    return shade * (1.0 - 0.30 * np.exp(-np.abs(HIGH[2] - p.z) / 0.45))


def _with_trim(colour: Floats, p: Hits, axes: str) -> Floats:
    """Mouldings along the wall's edges, of the same colour on both sides to hide the seam."""
    edge = np.zeros_like(p.x)
    for axis, low, high in (("x", LOW[0], HIGH[0]), ("y", LOW[1], HIGH[1]), ("z", -9.0, HIGH[2])):
        if axis in axes:
            position, size = getattr(p, axis), getattr(p, f"size_{axis}")
            middle = band(position, low + TRIM_M, high - TRIM_M, size)
            edge = np.maximum(edge, 1.0 - middle)
    trim = np.asarray(TRIM, np.float32) * (0.9 * _corner_shade(p))[..., None]
    return blend(colour, trim, edge)
