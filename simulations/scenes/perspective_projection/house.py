"""A small house behind the point, which shows the division by depth.

The point is its front lower left corner; the house moves with the point.
"""

import numpy as np

from simulations.engine import drawing
from simulations.models.arrays import Floats
from simulations.models.projection.pinhole import intrinsics
from simulations.scenes.perspective_projection.view import CAMERAS, PERSPECTIVE, View

WIDTH_M, DEPTH_M, EAVES_M, RIDGE_M = 2.4, 3.0, 1.5, 2.3
DOOR_M = (0.8, 1.4, 1.1)
"""Left, right and height of the door."""
NEAR_M = 0.05
"""Parts nearer than this to the plane of the centre are not drawn: their image is too far off."""


def _gable(depth: float) -> Floats:
    """The outline (5, 3) of one end wall from its lower left corner; y points down."""
    left, right, middle = 0.0, WIDTH_M, WIDTH_M / 2.0
    outline = [(left, 0), (right, 0), (right, -EAVES_M), (middle, -RIDGE_M), (left, -EAVES_M)]
    return np.array([(x, y, depth) for x, y in outline])


def _door() -> Floats:
    left, right, height = DOOR_M
    return np.array([(left, 0, 0), (left, -height, 0), (right, -height, 0), (right, 0, 0)])


_FRONT, _BACK, _DOOR = _gable(0.0), _gable(DEPTH_M), _door()
_LONG = np.stack([_FRONT, _BACK], axis=1)
"""The five edges (5, 2, 3) from the front to the back."""


def in_picture(view: View, place: drawing.Point, units_per_px: float) -> str:
    """SVG markup of the house; ``place`` is the principal point in the view box."""

    def seen(points: Floats) -> Floats:
        return units_per_px * _project(view, points) + np.asarray(place)

    corner = np.array([view.X, view.Y, view.Z])
    nearest = NEAR_M if view.camera == PERSPECTIVE else -np.inf
    edges = [_before(edge, nearest) for edge in _LONG + corner]
    parts = [drawing.path([seen(edge) for edge in edges if len(edge)], "world thin")]
    if nearest <= view.Z + DEPTH_M:
        parts.append(drawing.polygon(seen(_BACK + corner), "world thin faint"))
    if nearest <= view.Z:
        parts.append(drawing.polygon(seen(_FRONT + corner), "world thin fill"))
        parts.append(drawing.polyline(seen(_DOOR + corner), "world thin"))
    return "".join(parts)


def _project(view: View, points: Floats) -> Floats:
    pixels, _ = CAMERAS[view.camera].project(points, intrinsics(view.focal_px, (0.0, 0.0)))
    return pixels


def _before(edge: Floats, nearest: float) -> Floats:
    """The part (2, 3) of an edge along the depth that is not too near; empty if all of it is."""
    (x, y, start), (_, _, end) = edge
    return np.array([(x, y, max(start, nearest)), (x, y, end)]) if end > nearest else edge[:0]


def footprint(view: View) -> Floats:
    """Depth and X (4, 2) of the walls' corners."""
    near, far, left, right = view.Z, view.Z + DEPTH_M, view.X, view.X + WIDTH_M
    return np.array([(near, left), (far, left), (far, right), (near, right)])
