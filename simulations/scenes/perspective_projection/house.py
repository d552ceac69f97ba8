"""A small house behind the point, which shows the division by depth.

The point is its front lower left corner; the house moves with the point.
"""

from collections.abc import Iterator

import numpy as np

from simulations.engine import drawing
from simulations.models.arrays import Floats
from simulations.scenes.perspective_projection.view import Camera, View

WIDTH_M, DEPTH_M, EAVES_M, RIDGE_M = 3.0, 4.0, 2.0, 3.2
NEAR_M = 0.2
"""Parts nearer than this to the plane of the centre are not drawn: their image is too far off."""


def _face(*corners: tuple[float, float, float]) -> Floats:
    """Corners (n, 3) of a face from the point: X, height above the ground, depth. Y points down."""
    return np.array(corners) * (1.0, -1.0, 1.0)


def _gable(depth: float) -> list[tuple[float, float, float]]:
    """The outline of an end wall, from its lower left corner up the left side."""
    outline = [(0, 0), (0, EAVES_M), (WIDTH_M / 2, RIDGE_M), (WIDTH_M, EAVES_M), (WIDTH_M, 0)]
    return [(x, up, depth) for x, up in outline]


def _rectangle(left: float, right: float, low: float, high: float) -> Floats:
    """A rectangle in the front wall."""
    return _face((left, low, 0), (left, high, 0), (right, high, 0), (right, low, 0))


_FRONT, _BACK = _gable(0.0), _gable(DEPTH_M)
# Corners run clockwise as seen from outside.
FACES = (
    (_face(*_FRONT), 1),
    (_face(*reversed(_BACK)), 4),
    (_face(_BACK[0], _BACK[1], _FRONT[1], _FRONT[0]), 3),
    (_face(_FRONT[4], _FRONT[3], _BACK[3], _BACK[4]), 4),
    (_face(_FRONT[1], _BACK[1], _BACK[2], _FRONT[2]), 4),
    (_face(_FRONT[2], _BACK[2], _BACK[3], _FRONT[3]), 6),
)
"""The walls and the two sides of the roof, each with its layers of colour: more, where darker."""
OPENINGS = (
    (_rectangle(0.45, 1.2, 0.0, 1.45), 5),
    (_rectangle(1.75, 2.5, 0.7, 1.45), 3),
)
"""Door and window, in the front wall."""


def in_picture(view: View, place: drawing.Point, units_per_px: float) -> str:
    """SVG markup of the house; ``place`` is the principal point in the view box."""
    corner = np.array([view.X, view.Y, view.Z])

    def seen(face: Floats) -> Floats:
        pixels = _image(view.camera, face + corner)
        return units_per_px * pixels + np.asarray(place) if len(pixels) else pixels

    parts: list[str] = []
    outer = [(seen(face), washes) for face, washes in FACES]
    # Walls seen from inside lie behind those seen from outside.
    for outside in (False, True):
        for n, (places, washes) in enumerate(outer):
            if len(places) > 2 and (_area(places) > 0.0) == outside:
                parts += _painted(places, washes)
                if n == 0 and outside:
                    parts += [
                        part for face, more in OPENINGS for part in _painted(seen(face), more)
                    ]
    return "".join(parts)


def outline(view: View, camera: Camera, place: drawing.Point, units_per_px: float) -> str:
    """SVG markup of the walls and the roof that another camera sees from outside."""
    corner = np.array([view.X, view.Y, view.Z])
    seen = [_image(camera, face + corner) for face, _ in FACES]
    return "".join(
        drawing.polygon(units_per_px * pixels + np.asarray(place), "error thin dashed fill")
        for pixels in seen
        if len(pixels) > 2 and _area(pixels) > 0.0
    )


def _painted(places: Floats, washes: int) -> Iterator[str]:
    """A face in the colour of paper, then in layers of the colour of the world."""
    if len(places) > 2:
        yield drawing.polygon(places, "casing solid")
        yield drawing.polygon(places, "world thin fill") * washes


def _area(places: Floats) -> float:
    """Twice the signed area of a polygon (n, 2); positive for clockwise on the page."""
    x, y = places.T
    return float(x @ np.roll(y, -1) - y @ np.roll(x, -1))


def _image(camera: Camera, face: Floats) -> Floats:
    """The image (n, 2) of the part of a face that is in front of the camera."""
    nearest = camera.centre_m + NEAR_M
    kept: list[Floats] = []
    for before, here in zip(np.roll(face, 1, axis=0), face, strict=True):
        if (before[2] < nearest) != (here[2] < nearest):
            kept.append(before + (nearest - before[2]) / (here[2] - before[2]) * (here - before))
        if here[2] >= nearest:
            kept.append(here)
    return camera.project(np.array(kept))[0] if kept else np.empty((0, 2))


def footprint(view: View) -> Floats:
    """Depth and X (4, 2) of the walls' corners."""
    near, far, left, right = view.Z, view.Z + DEPTH_M, view.X, view.X + WIDTH_M
    return np.array([(near, left), (far, left), (far, right), (near, right)])
