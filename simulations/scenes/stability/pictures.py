"""A picture of the room put through both computations of a formula.

The values of each pixel are written into inputs of the formula near its singularity, which are
rounded to the format; what the formula finds is read back as a value. So the rearranged picture
shows what rounding the inputs costs, and the other one also what the formula does.
"""

import math
from collections.abc import Callable, Mapping
from functools import lru_cache

import numpy as np

from simulations.engine.frame import Raster
from simulations.engine.raster import to_rgba8
from simulations.models.arrays import Floats
from simulations.models.color.srgb import encode_srgb
from simulations.models.projection.pinhole import intrinsics, look_at
from simulations.scenes.stability.errors import (
    K1,
    LARGEST_SEEN,
    ROWS,
    Kind,
    angle_by_arccosine,
    angle_by_lengths,
    blur_by_distances,
    blur_in_dioptres,
    newton,
    pixel_from_camera,
    pixel_from_origin,
    unit,
)
from simulations.world.room import halve, light_of

COLUMNS = 200
UNDEFINED = (0.80, 0.05, 0.25)  # sRGB of a value that is not a number

type Pair = tuple[Floats, Floats]
"""Values (n,) read back from the formula as written and from it rearranged."""


@lru_cache(maxsize=2)
def room(columns: int) -> Floats:
    """sRGB (3, rows, columns), 0 to 1; of fewer columns, means of the values of all."""
    if columns < COLUMNS:
        return np.asarray(halve(room(2 * columns)), float)
    rows = columns * 3 // 4
    K = intrinsics(1.5 * columns, ((columns - 1) / 2, (rows - 1) / 2))
    pose = look_at((0.0, -1.2, 1.0), (0.1, 4.0, 0.5), (0, 0, 1))
    return encode_srgb(np.asarray(light_of(K, pose, columns, rows), float))


@lru_cache(maxsize=2)
def orientations(count: int) -> Pair:
    """Unit quaternions (count, 4), and others at right angles to them."""
    rng = np.random.default_rng(1)
    start = unit(rng.uniform(0.2, 1.0, (count, 4)))
    aside = rng.uniform(-1.0, 1.0, (count, 4))
    return start, unit(aside - (aside * start).sum(axis=-1, keepdims=True) * start)


def by_angle(values: Floats, distance: float, kind: Kind) -> Pair:
    """A value is twice the tangent of half the angle, in units of the distance."""
    start, across = orientations(values.size)
    a = start.astype(kind)
    b = unit(start + distance / 2 * values[:, None] * across).astype(kind)
    found = angle_by_arccosine(a, b), angle_by_lengths(a, b)
    first, second = (2.0 / distance * np.tan(angle.astype(float) / 2) for angle in found)
    return first, second


def by_blur(values: Floats, distance: float, kind: Kind) -> Pair:
    """A value is |Z − s| / s in units of the distance, the lens focused at 60 focal lengths."""
    focus, scale = np.full(values.size, 60.0, kind), np.full(values.size, 0.5, kind)
    depth = (60.0 * (1.0 + distance * values)).astype(kind)
    found = (blur(scale, focus, depth) for blur in (blur_in_dioptres, blur_by_distances))
    shares = [disc.astype(float) * 59.0 / 0.5 for disc in found]
    first, second = (share / (1.0 - share) / distance for share in shares)
    return first, second


def by_origin(values: Floats, distance: float, kind: Kind) -> Pair:
    """A value is X/Z of a point 10 m in front of a camera at 10 m / distance from the origin."""
    centre = (10.0 / distance * np.array([0.64, 0.48, 0.6])).astype(kind)
    away = 10.0 * (values[:, None] * ROWS[0] + ROWS[1])
    point, rows = (centre + away).astype(kind), ROWS.astype(kind)
    return pixel_from_origin(rows, point, centre), pixel_from_camera(rows, point, centre)


def by_fold(values: Floats, distance: float, kind: Kind) -> Pair:
    """A value is how far r_d is short of its largest, as a share in units of the distance."""
    distorted = (LARGEST_SEEN * (1.0 - distance * np.clip(values, 0.0, 0.999))).astype(kind)
    found = [newton(distorted, steps).astype(float) for steps in (5, 60)]
    first, second = ((1.0 - r * (1.0 + K1 * r**2) / LARGEST_SEEN) / distance for r in found)
    return first, second


THROUGH: Mapping[str, Callable[[Floats, float, Kind], Pair]] = {
    "angle": by_angle,
    "blur": by_blur,
    "origin": by_origin,
    "fold": by_fold,
}


def pictures(formula: str, digits: str, power: float, columns: int) -> tuple[Raster, Raster]:
    """The picture as written and rearranged, at a distance of 10^power."""
    picture = room(columns)
    with np.errstate(all="ignore"):
        pair = THROUGH[formula](picture.ravel(), math.pow(10.0, power), np.dtype(digits).type)
    first, second = (values.reshape(picture.shape) for values in pair)
    return painted(first), painted(second)


def painted(values: Floats) -> Raster:
    """A raster of values (3, rows, columns)."""
    pixels = np.clip(values.transpose(1, 2, 0), 0.0, 1.0)
    undefined = np.isnan(pixels).any(axis=-1, keepdims=True)
    return to_rgba8(np.where(undefined, UNDEFINED, pixels))
