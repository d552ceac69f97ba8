"""A small aircraft to see orientations by, drawn back to front from flat faces.

Body axes as pilots use them: x forward, y along the right wing, z down. With the angles yaw,
pitch and roll of R = Rz Ry Rx that means: nose to the right, nose up, right wing down.
"""

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from simulations.engine.drawing import polygon
from simulations.models.arrays import Floats

type Point = Sequence[float]

SPAN = 1.0
"""Half of the wings' span, and of the length: the unit of the model."""

_TOWARDS_LIGHT = np.array([0.45, 0.25, -0.86])
"""In the world, unit length: above and a little ahead."""


def view_from(azimuth: float, elevation: float) -> Floats:
    """World to view (3, 3) of a distant eye: x right, y down, z away.

    The eye's direction in degrees: round from straight ahead towards the right, and upwards.
    """
    round_, up = math.radians(azimuth), math.radians(elevation)
    right = (math.sin(round_), -math.cos(round_), 0.0)
    down = (math.sin(up) * math.cos(round_), math.sin(up) * math.sin(round_), math.cos(up))
    away = (-math.cos(up) * math.cos(round_), -math.cos(up) * math.sin(round_), math.sin(up))
    return np.array([right, down, away])


def screen(points: Floats, view: Floats, centre: tuple[float, float], unit: float) -> Floats:
    """Parallel projection of world points (..., 3): view box x, y, and depth in the third."""
    seen = points @ view.T
    return np.concatenate([seen[..., :2] * unit + centre, seen[..., 2:]], axis=-1)


def _faces() -> tuple[Floats, ...]:
    """Corners (n, 3) of each face in body axes."""
    nose, tail = (1.0, 0.0, 0.0), (-1.0, 0.0, -0.04)
    front = [(0.55, y, z) for y, z in ((-0.13, -0.12), (0.13, -0.12), (0.13, 0.13), (-0.13, 0.13))]
    rear = [(-0.45, y, z) for y, z in ((-0.1, -0.11), (0.1, -0.11), (0.1, 0.1), (-0.1, 0.1))]
    body: list[Sequence[Point]] = []
    for here, there in ((0, 1), (1, 2), (2, 3), (3, 0)):
        body.append((nose, front[here], front[there]))
        body.append((front[here], front[there], rear[there], rear[here]))
        body.append((rear[here], rear[there], tail))
    plates: list[Sequence[Point]] = []
    for side in (-1, 1):
        wing = ((0.3, 0.12), (-0.02, SPAN), (-0.27, SPAN), (-0.2, 0.12))
        plates.append([(x, side * y, 0.02) for x, y in wing])
        plane = ((-0.74, 0.03), (-0.9, 0.38), (-1.02, 0.38), (-0.97, 0.03))
        plates.append([(x, side * y, -0.05) for x, y in plane])
    fin = ((-0.62, 0, -0.09), (-0.92, 0, -0.42), (-1.05, 0, -0.42), (-0.98, 0, -0.05))
    return tuple(np.array(face, float) for face in (*body, *plates, fin))


FACES = _faces()
_CORNERS = np.concatenate(FACES)
_ENDS = np.cumsum([len(face) for face in FACES])
_STARTS = _ENDS - [len(face) for face in FACES]


def draw(R: Floats, view: Floats, centre: tuple[float, float], unit: float, role: str) -> str:
    """SVG markup of the aircraft turned by ``R`` (3, 3), its half span ``unit`` long.

    R may be any matrix: that of a faulty blend shows as a crushed aircraft.
    """
    turned = _CORNERS @ R.T
    placed = screen(turned, view, centre, unit)
    depths = np.add.reduceat(placed[:, 2], _STARTS) / (_ENDS - _STARTS)
    washes = _washes(turned, view)
    # Rounded, so that faces equally far keep their order on every machine.
    order = np.argsort(-np.round(depths, 9), kind="stable")
    return "".join(
        _face(placed[_STARTS[i] : _ENDS[i], :2].tolist(), int(washes[i]), role) for i in order
    )


def _face(corners: list[Point], washes: int, role: str) -> str:
    """Paper, then as many washes of the role's colour as the face is dark."""
    wash = polygon(corners, f"{role} thin fill")
    return polygon(corners, "casing solid") + wash * washes


def _washes(turned: Floats, view: Floats) -> NDArray[np.int64]:
    """One for a face that looks at the light, to four for one that looks away.

    Both sides of a plate are drawn: the side that faces the viewer counts.
    """
    corner, second, third = (turned[_STARTS + step] for step in range(3))
    normals = np.cross(second - corner, third - corner)
    sizes = np.maximum(np.sqrt((normals * normals).sum(axis=-1)), 1e-9)
    lit = -np.sign(normals @ view[2]) * (normals @ _TOWARDS_LIGHT) / sizes
    return 1 + np.rint(1.5 * (1.0 - lit)).astype(np.int64)
