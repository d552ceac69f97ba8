"""A tiled terrace by the sea, islands on the horizon, and a box on the tiles.

World frame as in `simulations.models.light.raycasting`: x right, y away, z up, in metres; the floor
is z = 0, as is the sea, and the box is aligned with its tiles. Linear RGB, 1 = paper white.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from simulations.models.arrays import Floats, Mask
from simulations.models.projection.level_ground import ground_to_image
from simulations.models.projection.pinhole import world_to_camera
from simulations.pictures.patterns import checker, stripes

TILE_M = 0.5
SLATE, CREAM = (0.085, 0.115, 0.135), (0.66, 0.61, 0.52)
SKY_TOP, SKY_LOW, CLOUD = (0.16, 0.38, 0.78), (0.74, 0.84, 0.92), (1.0, 0.98, 0.95)
SEA, GLINT = (0.025, 0.13, 0.19), (0.11, 0.28, 0.36)
FLOOR_COLOURS = np.array([SLATE, CREAM, SKY_LOW], np.float32)
SEA_COLOURS = np.array([SEA, GLINT, SKY_LOW], np.float32)
SKY_COLOURS = np.array([SKY_LOW, SKY_TOP, CLOUD], np.float32)
LAND_COLOURS = np.array([(0.30, 0.42, 0.52), (0.10, 0.17, 0.15), CLOUD], np.float32)
"""The far coast, an island, and a sail."""
SKY_RISE = 0.7  # tangent of the angle above the horizon at which the sky is bluest
FARTHEST = 1e-4  # inverse of the depth in metres at which the sea ends, in haze
HAZE_M, SEA_HAZE_M = 60.0, 700.0  # distances at which a colour has fallen to e⁻¹
TERRACE = (-24.0, 27.0, 30.0)  # left and right edge, and the edge ahead: metres
KERB_M = 0.6
BOX_PAINT = (0.52, 0.13, 0.055)
LIGHT = {"x0": 0.95, "x1": 0.34, "y0": 0.50, "y1": 0.60, "top": 1.25}
"""Brightness of each side of the box, lit by a lamp to the left."""
SHADOW_PER_M = (0.7, 0.3)  # offset of a point's shadow, metres right and nearer per metre of height
SHADE = 0.42  # share of the light in the shadow
EDGE_ON_M = 1e-6
"""Distance from the plane of a side within which the side is seen as a line and not drawn."""


@dataclass(frozen=True, slots=True)
class Box:
    """A box on the floor, its sides along the tiles."""

    x: float
    """Middle of its base, metres."""
    y: float
    width: float
    height: float

    @property
    def spans(self) -> tuple[tuple[float, float], tuple[float, float], tuple[float, float]]:
        """Start and end along x, y and z."""
        half = self.width / 2.0
        return (self.x - half, self.x + half), (self.y - half, self.y + half), (0.0, self.height)

    def seen_from(self, eye: ArrayLike) -> tuple[str, ...]:
        """Names of the sides visible from the eye (3,): x0, x1, y0, y1, top."""
        x, y, z = np.asarray(eye, float)
        (x0, x1), (y0, y1), (_, top) = self.spans
        before = {"x0": x0 - x, "x1": x - x1, "y0": y0 - y, "y1": y - y1, "top": z - top}
        return tuple(name for name, distance in before.items() if distance > EDGE_ON_M)

    def side(self, name: str) -> Floats:
        """Corners (4, 3) of a side, in the order of its edge."""
        (x0, x1), (y0, y1), (low, top) = self.spans
        if name == "top":
            return np.array([(x0, y0, top), (x1, y0, top), (x1, y1, top), (x0, y1, top)])
        a, b = {
            "x0": ((x0, y0), (x0, y1)),
            "x1": ((x1, y0), (x1, y1)),
            "y0": ((x0, y0), (x1, y0)),
            "y1": ((x0, y1), (x1, y1)),
        }[name]
        return np.array([(*a, low), (*b, low), (*b, top), (*a, top)])

    def shadow(self) -> Floats:
        """Corners (6, 3) of its shadow on the floor, the base included."""
        (x0, x1), (y0, y1), (_, top) = self.spans
        right, nearer = (top * share for share in SHADOW_PER_M)
        outline = [(x0, y1), (x1, y1), (x1 + right, y1 - nearer), (x1 + right, y0 - nearer)]
        outline += [(x0 + right, y0 - nearer), (x0, y0)]
        return np.array([(*corner, 0.0) for corner in outline])


def tiled_floor(pose: ArrayLike, K: ArrayLike, width: int, height: int) -> NDArray[np.float32]:
    """The terrace, the sea and the sky, (height, width, 3).

    ``pose`` (4, 4) of a camera above the floor, not looking straight up or down.
    """
    to_floor = np.linalg.inv(ground_to_image(pose, K)).astype(np.float32)
    across, away, nearness = (_over_pixels(row, width, height) for row in to_floor)
    picture = np.empty((height, width, 3), np.float32)
    ends = nearness[:, [0, -1]]
    with_floor, with_sky = (
        _rows(these) for these in (ends.max(axis=1) > FARTHEST, ends.min(axis=1) <= FARTHEST)
    )
    distance = 1.0 / np.maximum(nearness[with_floor], FARTHEST)
    x, y = across[with_floor] * distance, away[with_floor] * distance
    picture[with_floor] = _ground(x, y, distance, to_floor)
    level = np.hypot(across[with_sky], away[with_sky])
    _, _, upright, place = np.asarray(pose, float)[:3].T
    tangent = nearness[with_sky] * np.float32(upright @ place) / level  # by minus the height
    azimuth = np.arctan2(across[with_sky], away[with_sky])
    in_sky = (nearness[with_sky] <= FARTHEST)[..., None]
    pixel = 1.0 / float(np.asarray(K)[1, 1])
    np.copyto(picture[with_sky], _sky(azimuth, tangent, pixel), where=in_sky)
    return picture


def _rows(these: Mask) -> slice:
    """The run of rows that are above or below a line."""
    found = np.flatnonzero(these)
    return slice(int(found[0]), int(found[-1]) + 1) if found.size else slice(0, 0)


def _ground(x: Floats, y: Floats, distance: Floats, to_floor: Floats) -> Floats:
    """Colours (..., 3) of terrace and sea, over the footprints of their pixels."""
    size_x, size_y = (
        (np.abs(row[0] - at * to_floor[2, 0]) + np.abs(row[1] - at * to_floor[2, 1])) * distance
        for row, at in ((to_floor[0], x), (to_floor[1], y))
    )
    left, right, ahead = TERRACE
    across, middle = np.abs(x - (left + right) / 2), (right - left) / 2
    inside = np.minimum((middle - across) / size_x, (ahead - y) / size_y)
    kerb = np.minimum((middle - KERB_M - across) / size_x, (ahead - KERB_M - y) / size_y)
    light = checker(x, y, TILE_M, size_x, size_y)
    light += (1.0 - light) * (1.0 - np.clip(0.5 + kerb, 0.0, 1.0))
    land = _mixed(light, np.exp(distance * (-1.0 / HAZE_M)), FLOOR_COLOURS)
    swell = x + 2.0 * np.sin(0.21 * y) + np.sin(0.37 * x + 0.11 * y)
    glint = stripes(swell + 0.6 * y, 5.0, 2.2, size_x + size_y) * stripes(
        y + 0.8 * np.sin(0.5 * x), 2.4, 0.9, size_y + 0.4 * size_x
    )
    water = _mixed(2.0 * glint, np.exp(distance * (-1.0 / SEA_HAZE_M)), SEA_COLOURS)
    return water + (land - water) * np.clip(0.5 + inside, 0.0, 1.0)[..., None]


def _mixed(second: Floats, clear: Floats, colours: Floats) -> Floats:
    """Colours (..., 3) between the first and the second by ``second``, and in haze the third."""
    return np.stack([clear - clear * second, clear * second, 1.0 - clear], axis=-1) @ colours


def _sky(azimuth: Floats, tangent: Floats, pixel: float) -> Floats:
    """Colours (..., 3) by the azimuth and the tangent of the angle above the horizon."""
    a, up = azimuth, np.maximum(tangent, 0.0)
    billow = np.sin(3.1 * a + 2.0 * np.sin(9.0 * up)) + 0.6 * np.sin(9.7 * a + 21.0 * up)
    billow += 0.35 * np.sin(23.0 * a - 31.0 * up) + 0.2 * np.sin(51.0 * a + 67.0 * up)
    cloud = np.clip(0.8 * billow - 0.55, 0.0, 0.8) * np.clip(6.0 * up - 0.45, 0.0, 1.0)
    blue = (1.0 - cloud) * np.sqrt(np.minimum(up * (1.0 / SKY_RISE), 1.0))
    sky = np.stack([1.0 - cloud - blue, blue, cloud], axis=-1) @ SKY_COLOURS
    heights = (
        0.05 * (np.sin(2.6 * a - 2.9) + _jagged(a) - 0.1),
        0.07 * (np.sin(3.3 * a + 0.2) + _jagged(a + 2.0) - 0.55),
        0.045 - 3.4 * np.abs(a - 0.74),
    )
    for height, colour in zip(heights, LAND_COLOURS, strict=True):
        share = np.clip(0.5 + (height - up) / pixel, 0.0, 1.0) * (height > 0.0)
        sky += (colour - sky) * share[..., None]
    return sky


def _jagged(a: Floats) -> Floats:
    return 0.3 * np.sin(11.0 * a) + 0.14 * np.sin(27.0 * a + 1.0) + 0.07 * np.sin(63.0 * a)


def with_box(
    floor: NDArray[np.float32], pose: ArrayLike, K: ArrayLike, box: Box
) -> NDArray[np.float32]:
    """The picture with the box and its shadow, where they are in front of the camera."""
    matrix, K = np.asarray(pose, float), np.asarray(K, float)
    picture = floor.copy()
    shadow = world_to_camera(box.shadow(), pose)
    rows, columns = _extent(shadow, K, picture.shape)
    share = polygon_coverage(shadow, K, rows, columns)
    picture[rows, columns] *= (1.0 - (1.0 - SHADE) * share)[..., None]
    names = box.seen_from(-matrix[:3, :3].T @ matrix[:3, 3])
    if not names:
        return picture
    sides = world_to_camera([box.side(name) for name in names], pose)
    rows, columns = _extent(sides.reshape(-1, 3), K, picture.shape)
    part = picture[rows, columns]
    covered, light = np.zeros((2, *part.shape[:2]), np.float32)
    # Sides are summed before they are composited, so that the floor is not visible through their
    # seams; they do not hide each other.
    for corners, name in zip(sides, names, strict=True):
        share = polygon_coverage(corners, K, rows, columns)
        covered += share
        light += np.float32(LIGHT[name]) * share
    light /= np.maximum(covered, 1.0)
    part *= (1.0 - np.minimum(covered, 1.0))[..., None]
    part += light[..., None] * np.array(BOX_PAINT, np.float32)
    return picture


def polygon_coverage(
    corners: Floats, K: Floats, rows: slice, columns: slice
) -> NDArray[np.float32]:
    """Approximate share of each pixel that a convex polygon in space covers.

    An edge and the camera's centre span a plane, and a pixel's ray is on one side of it. That holds
    for corners behind the camera too, so that nothing needs to be clipped.

    Parameters
    ----------
    corners : (N, 3) in the camera frame, in order, in a plane that does not contain the centre.
    rows, columns : which pixels.
    """
    edges = np.cross(corners, np.roll(corners, -1, axis=0))
    edges = edges * np.sign(edges @ corners.mean(axis=0))[:, None]
    lines = edges @ np.linalg.inv(K)
    lines /= np.maximum(np.hypot(lines[:, 0], lines[:, 1]), 1e-9)[:, None]
    x = np.arange(columns.start, columns.stop)
    y = np.arange(rows.start, rows.stop)[:, None]
    inside = np.full((len(y), len(x)), 1.0, np.float32)
    for a, b, c in lines:
        distance = np.clip(a * x + c + 0.5, -1e6, 1e6).astype(np.float32) + (b * y).astype(
            np.float32
        )
        np.minimum(inside, distance, out=inside)
    return np.maximum(inside, np.float32(0.0))


def _extent(corners: Floats, K: Floats, shape: tuple[int, ...]) -> tuple[slice, slice]:
    """Rows and columns that a polygon may touch; all of them if it is not wholly in front."""
    height, width = shape[:2]
    depth = corners[:, 2]
    if depth.max() <= 0.0:
        return slice(0, 0), slice(0, 0)
    if depth.min() <= 1e-3:
        return slice(0, height), slice(0, width)
    image = corners @ K.T
    low, high = ((image[:, :2] / depth[:, None]) + end for end in (-1.0, 2.0))
    (left, top), (right, bottom) = low.min(axis=0), high.max(axis=0)
    columns = slice(*(int(np.clip(edge, 0, width)) for edge in (left, right)))
    return slice(*(int(np.clip(edge, 0, height)) for edge in (top, bottom))), columns


def _over_pixels(row: NDArray[np.float32], width: int, height: int) -> NDArray[np.float32]:
    """a x + b y + c at all pixels (height, width)."""
    a, b, c = row
    x, y = np.arange(width, dtype=np.float32), np.arange(height, dtype=np.float32)
    return a * x + (b * y + c)[:, None]
