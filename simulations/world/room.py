"""The room that most figures show: still life, furniture, door and window, from any viewpoint.

World axes: x right, y from the entrance to the wall with the chart, z up, metres. A scene moves a
camera through it::

    raster = photograph(focal_px, look_at(eye, target, (0, 0, 1)), columns)

Everything that does not move is computed once: the colours of the walls are tables of rectangles
(`walls`), the light on all surfaces is in maps (`light_maps`). A pixel is then one ray (`tracing`)
and a few look-ups (`radiance`); where neighbours see different surfaces it is the mean of four.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from simulations.engine.accuracy import columns
from simulations.engine.frame import Raster
from simulations.engine.raster import of_planes
from simulations.models.arrays import Floats, Mask, Planes
from simulations.models.color.srgb import encode_srgb_codes
from simulations.models.projection.pinhole import intrinsics
from simulations.world.light_maps import light_map
from simulations.world.radiance import (
    DAY,
    NOTHING,
    ArrivingLight,
    Lighting,
    Samples,
    normals_of,
    radiance,
)
from simulations.world.tracing import (
    PARTS,
    Camera,
    Numbers,
    Surfaces,
    camera_at,
    pixels,
    trace,
)

LEVELS = columns(160, 240, 400)
"""Pixels across a `photograph`."""
QUARTERS = np.array([(-0.25, -0.25), (0.25, -0.25), (-0.25, 0.25), (0.25, 0.25)], np.float32)
"""Middles of the quarters of a pixel: columns and rows."""


@dataclass(frozen=True, slots=True)
class View:
    """The surface at each pixel of a camera in the room."""

    depth: Floats
    """(H, W) metres along the optical axis."""
    points: Floats
    """(H, W, 3) metres, world frame."""
    normals: Floats
    """(H, W, 3) unit, towards the camera's side."""
    to_eye: Floats
    """(H, W, 3) unit."""
    identity: Surfaces
    """(H, W) index into `furniture.NAMES`."""


def look(K: ArrayLike, world_to_camera: ArrayLike, width: int, height: int) -> View:
    """View of a pinhole camera at a pose (4, 4), in single precision."""
    camera, (x, y) = camera_at(K, world_to_camera), pixels(width, height)
    hits, directions = trace(camera, x, y), camera.directions(x, y)
    depth = 1 / hits.nearness
    points = np.moveaxis(directions * depth, 0, -1) + camera.eye.astype(np.float32)
    to_eye = np.moveaxis(-directions / np.linalg.norm(directions, axis=0), 0, -1)
    normals = np.moveaxis(normals_of(hits.surface, points), 0, -1)
    return View(depth, points, normals, to_eye, PARTS.take(hits.surface))


def photograph(focal: float, world_to_camera: ArrayLike, columns: int) -> Raster:
    """A picture, 4 : 3, with the principal point in its middle; ``focal`` is in its pixels."""
    rows = columns * 3 // 4
    K = intrinsics(focal, ((columns - 1) / 2, (rows - 1) / 2))
    light = light_of(K, world_to_camera, columns, rows)
    return of_planes([encode_srgb_codes(plane) for plane in light])


def light_of(
    K: ArrayLike,
    world_to_camera: ArrayLike,
    width: int,
    height: int,
    lighting: Lighting = DAY,
    arriving: ArrivingLight | None = None,
) -> Planes:
    """(3, H, W) linear RGB of the view of a pinhole camera at a pose (4, 4), with smooth edges, in
    the light that maps hold or that is given."""
    camera = camera_at(K, world_to_camera)
    whole, edges = samples_of(camera, width, height)
    colours = radiance(whole, arriving or light_map(lighting.angle), lighting)
    picture, quarters = np.split(colours, [width * height], axis=1)
    means = quarters.reshape(3, -1, len(QUARTERS)).mean(axis=2)
    for plane, mean in zip(picture, means, strict=True):
        plane[edges] = mean
    return picture.reshape(3, height, width)


def samples_of(camera: Camera, width: int, height: int) -> tuple[Samples, Numbers]:
    """The pixels of a picture and, behind them, the four quarters of each pixel (n,) at an edge;
    the surface of these pixels is `NOTHING`."""
    x, y = pixels(width, height)
    hits = trace(camera, x, y)
    edges = np.flatnonzero(_edges(hits.surface))
    middles = edges % width, edges // width
    columns, rows = (
        (middle.astype(np.float32)[:, None] + offsets).reshape(1, -1)
        for middle, offsets in zip(middles, QUARTERS.T, strict=True)
    )
    finer_hits = trace(camera, columns, rows)
    hits.surface.reshape(-1)[edges] = NOTHING
    both = (
        np.concatenate([pixel_values.ravel(), quarters.ravel()])
        for pixel_values, quarters in (
            (np.broadcast_to(x, hits.surface.shape), columns),
            (np.broadcast_to(y, hits.surface.shape), rows),
            (hits.nearness, finer_hits.nearness),
            (hits.surface, finer_hits.surface),
        )
    )
    across, down, nearness, surface = both
    depth = 1 / nearness
    width_m = depth.copy()
    width_m[width * height :] *= np.float32(0.5)
    return Samples(
        camera=camera, x=across, y=down, depth=depth, width=width_m, surface=surface
    ), edges


def _edges(surface: Surfaces) -> Mask:
    """The pixels (H, W) with a neighbour that sees another surface."""
    edges = np.zeros(surface.shape, bool)
    for axis in (0, 1):
        along, marked = np.moveaxis(surface, axis, 0), np.moveaxis(edges, axis, 0)
        differ = along[1:] != along[:-1]
        marked[1:] |= differ
        marked[:-1] |= differ
    return edges


def finer(K: ArrayLike, factor: float = 2.0) -> Floats:
    """The calibration matrix (3, 3) of the same camera with ``factor`` times as many pixels."""
    larger = np.asarray(K, float) * np.array([[factor], [factor], [1.0]])
    larger[:2, 2] += (factor - 1) / 2
    return larger


def halve(planes: Planes) -> Planes:
    """Means of 2 × 2 pixels of (3, 2H, 2W)."""
    pairs = planes[:, ::2] + planes[:, 1::2]
    return np.float32(0.25) * (pairs[..., ::2] + pairs[..., 1::2])
