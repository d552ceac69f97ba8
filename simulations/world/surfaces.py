"""The surfaces that rays of the still life meet: places, normals, reflectances, edge coverage.

Nothing here depends on the light.
"""

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from simulations.models.arrays import Floats, Mask, Planes
from simulations.models.light.raycasting import (
    Box,
    Sphere,
    Vector,
    edge_coverage,
    face_margins,
    intersect,
    intersect_plane,
)
from simulations.models.light.soft_shadows import bounding_radius, sphere_occlusion
from simulations.pictures.patterns import band_about, checker, pixel_width, siemens_star, stripes
from simulations.world.still_life import (
    OBJECTS,
    WALL_DISTANCE,
    WALL_HEIGHT,
    SceneObject,
    WorldRays,
    depth_along_axis,
    object_depth,
)

type Window = tuple[slice, slice]
"""Rows and columns."""

TILE = 0.5  # edge of a floor tile, metres
TILE_CENTRE = (0.065, 0.25)  # centre of a light tile: x and y, metres
PANEL = 1.0  # spacing of the grooves of the wall panelling, metres
CHART = (0.35, 1.12, 1.9, 1.3)
"""Test chart on the wall: x and z of its centre, width, height; metres."""

OCCLUSION_REACH = 6.0
"""Radii beyond which a ball hides less than 1/36 of the surroundings, which is ignored."""

FEW = 3000
"""Points for which it costs less to compute a shadow than to find the window that it reaches."""

FLOOR_LIGHT, FLOOR_DARK = np.array([0.60, 0.55, 0.47]), np.array([0.17, 0.13, 0.11])
WALL, GROOVE = np.array([0.33, 0.42, 0.43]), np.array([0.20, 0.26, 0.27])
SKIRTING = np.array([0.62, 0.60, 0.56])
WALL_PLANE = ((0.0, WALL_DISTANCE, 0.0), (0.0, -1.0, 0.0))
FLOOR_PLANE = ((0.0, 0.0, 0.0), (0.0, 0.0, 1.0))  # a point of the plane and its normal
STRIPES_AXIS = np.array([0.42, -0.25, 0.87]) / math.hypot(0.42, -0.25, 0.87)
"""Axis of the striped ball, tilted towards the camera."""
INK, PAPER = np.array([0.03, 0.03, 0.035]), np.array([0.80, 0.79, 0.76])


@dataclass(frozen=True, slots=True, kw_only=True)
class Surface:
    """The visible side of one object, in a window of the picture."""

    item: SceneObject | None
    """None for the floor and the wall."""
    top: int
    left: int
    points: Floats
    """(h, w, 3) metres, world frame."""
    normals: Floats
    """(h, w, 3) unit; on an edge between two faces of a box, the mean over the pixel, shorter than
    1."""
    to_eye: Floats
    """(h, w, 3) unit."""
    coverage: Floats
    """(h, w) in [0, 1]."""
    albedo: Planes
    """(3, h, w) linear RGB."""
    openness: Floats
    """(h, w) share of the surroundings' light that is not hidden by other objects."""
    depth: Floats
    """(h, w) metres along the optical axis; one value for a whole object."""


def surfaces(rays: WorldRays) -> tuple[Surface, ...]:
    """Wall and floor, then the objects in view from the farthest to the nearest."""
    ordered = sorted(OBJECTS, key=object_depth, reverse=True)
    found = (_object_surface(item, rays) for item in ordered)
    return (*_wall_and_floor(rays), *(surface for surface in found if surface is not None))


def _object_surface(item: SceneObject, rays: WorldRays) -> Surface | None:
    window = _window(item, rays)
    if window is None:
        return None
    directions = rays.directions[window]
    hit = intersect(item.solid, rays.eye, directions)
    coverage = _covered(hit.margin, rays.area) * rays.valid[window]
    if not coverage.any():
        return None
    points, facing = rays.as_stored(hit.points), hit.normals
    if points is not hit.points and isinstance(item.solid, Sphere):
        outwards = points - item.solid.centre
        facing = outwards / np.linalg.norm(outwards, axis=-1, keepdims=True)
    normals = _mean_normals(item.solid, rays, directions, facing)
    albedo, depth = object_albedo(item, facing, rays.area), object_depth(item) + rays.back
    others = [other for other in OBJECTS if other is not item]  # it hides nothing from itself
    openness = sky_visibility(points, facing, others)
    rows, columns = window
    return Surface(
        item=item,
        top=rows.start,
        left=columns.start,
        points=points,
        normals=normals,
        to_eye=-directions,
        coverage=coverage,
        albedo=albedo,
        openness=openness,
        depth=np.full(coverage.shape, depth),
    )


def _covered(margin: Floats, area: bool) -> Floats:
    return edge_coverage(margin) if area else np.asarray(margin > 0, float)


def _mean_normals(
    solid: Sphere | Box, rays: WorldRays, directions: Floats, normals: Floats
) -> Floats:
    """The normals (h, w, 3), where a pixel holds two faces of a box weighted by their areas."""
    if isinstance(solid, Sphere) or not rays.area:
        return normals
    margins = face_margins(solid, rays.eye, directions)
    shares = np.stack([edge_coverage(margin) for margin in margins])
    axes = solid.world_to_box
    facing = -np.sign(directions @ axes.T)
    return (facing * np.moveaxis(shares / shares.sum(axis=0), 0, -1)) @ axes


def _window(item: SceneObject, rays: WorldRays) -> Window | None:
    """Rows and columns, with a margin, of the pixels whose rays pass near the object."""
    to_centre = np.asarray(item.solid.centre) - rays.eye
    distance = float(np.linalg.norm(to_centre))
    spread = math.asin(min(1.0, bounding_radius(item.solid) / distance))
    near = (rays.directions @ (to_centre / distance) > math.cos(spread)) & rays.valid
    return window_of(near, margin=2)


def window_of(mask: Mask, margin: int = 1) -> Window | None:
    """Rows and columns that hold every true pixel, ``margin`` more and at least two each way."""
    rows, columns = np.flatnonzero(mask.any(1)), np.flatnonzero(mask.any(0))
    if not rows.size:
        return None
    top, left = max(int(rows[0]) - margin, 0), max(int(columns[0]) - margin, 0)
    bottom = min(int(rows[-1]) + 1 + margin, mask.shape[0])
    right = min(int(columns[-1]) + 1 + margin, mask.shape[1])
    return slice(top, bottom), slice(left, right)


def object_albedo(item: SceneObject, normals: Floats, area: bool) -> Planes:
    if item.second_albedo is None:
        colour = np.array(item.albedo, np.float32)
        return np.broadcast_to(colour[:, None, None], (3, *normals.shape[:2]))
    latitude = np.arcsin(np.clip(normals @ STRIPES_AXIS, -1.0, 1.0))
    place = latitude * (item.stripe_count / math.pi)  # a stripe is 1 wide
    share = stripes(place, 2.0, 1.0, pixel_width(place, area))
    return mixed(np.asarray(item.albedo), np.asarray(item.second_albedo), share)


def mixed(first: Floats, second: Floats, share: Floats) -> Planes:
    """(3, H, W) blend of two colours: ``first`` where ``share`` (H, W) is 0, ``second`` where it is
    1."""
    start, change = first.astype(np.float32), (second - first).astype(np.float32)
    return start[:, None, None] + change[:, None, None] * share.astype(np.float32)


def sky_visibility(
    points: Floats,
    normals: Floats,
    items: Sequence[SceneObject],
    reach: float = OCCLUSION_REACH,
) -> Floats:
    """Share of the surroundings that the objects do not hide; boxes count as balls inside them.

    An object hides nothing from points on its own surface, from which its inside is behind."""
    solids = [item.solid for item in items]
    centres = np.array([solid.centre for solid in solids])
    radii = np.array(
        [solid.radius if isinstance(solid, Sphere) else 0.6 * min(solid.size) for solid in solids]
    )
    if points[..., 0].size <= FEW:  # all at once, as the steps take longer than the arithmetic
        hidden = sphere_occlusion(centres[:, None, None], radii[:, None, None], points, normals)
        return np.prod(1.0 - np.maximum(hidden - reach**-2, 0.0), axis=0)
    openness, far = np.ones(points.shape[:2]), reach * radii[:, None]
    reached = zip(centres - far, centres + far, strict=True)
    for place, near in enumerate(windows_between(points, reached)):
        if near is not None:
            hidden = sphere_occlusion(centres[place], radii[place], points[near], normals[near])
            openness[near] *= 1.0 - np.maximum(hidden - reach**-2, 0.0)
    return openness


def windows_between(
    points: Floats, corners: Iterable[tuple[Floats, Floats]], few: int = 0
) -> Iterator[Window | None]:
    """Rows and columns of the points (H, W, 3) whose x and y are between two corners (low, high),
    for each pair. A comparison with the bounds of all points comes first, as it is fast; where it
    does not tell, up to ``few`` points are all taken."""
    x, y = points[..., 0].copy(), points[..., 1].copy()
    left, right, front, back = x.min(), x.max(), y.min(), y.max()
    for low, high in corners:
        if right <= low[0] or back <= low[1] or left >= high[0] or front >= high[1]:
            yield None
        elif x.size <= few:
            yield slice(None), slice(None)
        else:
            yield window_of((x > low[0]) & (x < high[0]) & (y > low[1]) & (y < high[1]))


def _wall_and_floor(rays: WorldRays) -> tuple[Surface, Surface]:
    far = _distance((0, WALL_DISTANCE, 0), (0, -1, 0), rays, rays.directions)
    height = rays.eye[2] + rays.directions[..., 2] * far  # where the ray meets the wall
    above = _covered(height, rays.area)
    return _backdrop(rays, WALL_PLANE, above), _backdrop(rays, FLOOR_PLANE, 1.0 - above)


def _distance(point: Vector, normal: Vector, rays: WorldRays, directions: Floats) -> Floats:
    """Distance to a plane, metres (...); 0 where the plane is not visible."""
    distance, meets = intersect_plane(point, normal, rays.eye, directions)
    return np.where(meets, distance, 0.0)


def _backdrop(rays: WorldRays, plane: tuple[Vector, Vector], share: Floats) -> Surface:
    """A plane, given by a point and its normal, in the rows where it is visible."""
    rows = np.flatnonzero((share > 0).any(1))
    top, bottom = (int(rows[0]), int(rows[-1]) + 1) if rows.size else (0, 0)
    top, bottom = max(top - 1, 0), max(bottom, top + 2)  # patterns need two rows
    directions = rays.directions[top:bottom]
    distance = _distance(*plane, rays, directions)
    points = rays.as_stored(rays.eye + directions * distance[..., None])
    normals = np.broadcast_to(np.asarray(plane[1]), points.shape)
    openness = sky_visibility(points, normals, OBJECTS)
    if plane is FLOOR_PLANE:  # the wall hides part of the sky from the floor in front of it
        away = np.maximum(WALL_DISTANCE - points[..., 1], 0.0)
        openness = openness * (0.5 + 0.5 * away / np.hypot(away, WALL_HEIGHT))
    coverage = share[top:bottom] * rays.valid[top:bottom]
    albedo = (floor_albedo if plane is FLOOR_PLANE else wall_albedo)(points, rays.area)
    return Surface(
        item=None,
        top=top,
        left=0,
        points=points,
        normals=normals,
        to_eye=-directions,
        coverage=coverage,
        albedo=albedo,
        openness=openness,
        depth=depth_along_axis(points) + rays.back,
    )


def floor_albedo(points: Floats, area: bool) -> Planes:
    x, y = points[..., 0] - TILE_CENTRE[0], points[..., 1] - TILE_CENTRE[1]
    share = checker(x, y, TILE, pixel_width(x, area), pixel_width(y, area))
    return mixed(FLOOR_DARK, FLOOR_LIGHT, share)


def wall_albedo(points: Floats, area: bool) -> Planes:
    x, z = points[..., 0], points[..., 2]
    across, up = _to_nearest(x, PANEL), _to_nearest(z - 0.15, PANEL)
    grooves = np.maximum(band_about(across, 0.025, area), band_about(up, 0.025, area))
    skirting = band_about(z, 0.15, area)
    wall = laid_over(mixed(WALL, GROOVE, grooves), SKIRTING, skirting)
    return _with_chart(wall, x - CHART[0], z - CHART[1], area)


def _to_nearest(coordinate: Floats, spacing: float) -> Floats:
    """Signed distance to the nearest multiple of ``spacing``."""
    return coordinate - spacing * np.round(coordinate / spacing)


def laid_over(picture: Planes, colour: Floats, share: Floats) -> Planes:
    """Blend ``picture`` (3, H, W) with a colour by ``share`` (H, W)."""
    covered, ink = share.astype(np.float32), colour.astype(np.float32)
    return picture * (1 - covered) + ink[:, None, None] * covered


def _with_chart(wall: Planes, x: Floats, z: Floats, area: bool) -> Planes:
    """Draw a framed sheet with a Siemens star between two columns of bars on ``wall``, in place."""
    near = (np.abs(x) < CHART[2] / 2 + 0.1) & (np.abs(z) < CHART[3] / 2 + 0.1)
    window = window_of(near)
    if window is None:
        return wall
    x, z = x[window], z[window]

    def within(across: Floats, half: float) -> Floats:
        return band_about(across, half, area)

    frame = within(x, CHART[2] / 2 + 0.05) * within(z, CHART[3] / 2 + 0.05)
    sheet = within(x, CHART[2] / 2) * within(z, CHART[3] / 2)
    disc = within(np.hypot(x, z), 0.52)
    columns = within(np.abs(x) - 0.74, 0.13) * within(z, 0.48)
    bars = stripes(z + 0.04, 0.16, 0.08, pixel_width(z, area))
    pixel = 0.5 * (pixel_width(x, area) + pixel_width(z, area))
    ink = np.maximum(disc * siemens_star(x, z, 18, pixel), columns * bars)
    framed, part = wall[:, *window], sheet.astype(np.float32)
    framed[:] = laid_over(framed, INK, frame)
    framed += (mixed(PAPER, INK, ink) - INK.astype(np.float32)[:, None, None]) * part
    return wall
