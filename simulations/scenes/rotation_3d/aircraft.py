"""A small aircraft to see orientations by, drawn back to front from flat faces.

Body axes as pilots use them: x forward, y along the right wing, z down. With the angles yaw,
pitch and roll of R = Rz Ry Rx that means: nose to the right, nose up, right wing down.
"""

from collections.abc import Sequence

import numpy as np

from simulations.engine.space.solids import Face, drawn, shaded
from simulations.engine.space.view import View, orbit_axes
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
    return orbit_axes(azimuth, elevation, z_down=True)


def screen(points: Floats, view: Floats, centre: tuple[float, float], unit: float) -> Floats:
    """Parallel projection of world points (..., 3): view box x, y, and depth in the third."""
    return View(view, centre, unit).place(points)


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


def draw(R: Floats, view: Floats, centre: tuple[float, float], unit: float, role: str) -> str:
    """SVG markup of the aircraft turned by ``R`` (3, 3), its half span ``unit`` long.

    R may be any matrix: that of a faulty blend shows as a crushed aircraft.
    """
    look = View(view, centre, unit)
    turned = [face @ R.T for face in FACES]
    return drawn([Face(face, role, shaded(face, look, _TOWARDS_LIGHT)) for face in turned], look)
