"""A camera in three rings, one for each Euler angle.

Each ring is perpendicular to its angle's axis. The pan ring is fixed in the world, the tilt ring
turns with the pan, the roll ring with both; at a tilt of ±90° the roll ring lies in the plane of
the pan ring, just inside it.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from simulations.engine.drawing import Point, arrow, dot, line, path, polygon, polyline, text
from simulations.engine.frame import format_number
from simulations.engine.space.view import runs
from simulations.models.arrays import Floats
from simulations.models.geometry import euler
from simulations.models.geometry.rotation_paths import rate_axes
from simulations.scenes._turned_camera import body

WIDTH, HEIGHT = 400.0, 400.0
CENTRE = (200.0, 208.0)
STEPS = 72
NEARLY = math.cos(math.radians(10.0))
"""The roll and the pan ring are drawn bold when the cosine between their axes exceeds this."""
LOCKED = 1.0 - 1e-9
"""Cosine between the two axes above which they count as one."""


@dataclass(frozen=True, slots=True)
class Ring:
    """The circle of one Euler angle."""

    name: str
    role: str
    radius: float
    axis: Floats
    """(3,) unit vector in the world about which the angle turns."""
    zero: Floats
    """(3,) unit vector across the axis: the zero of the angle."""
    angle_rad: float

    def at(self, angle_rad: ArrayLike) -> Floats:
        """Points (..., 3) of the ring at angles (...) from its zero."""
        angle = np.asarray(angle_rad, float)[..., None]
        aside = np.cross(self.axis, self.zero)
        return self.radius * (np.cos(angle) * self.zero + np.sin(angle) * aside)


def rings(pan_rad: float, tilt_rad: float, roll_rad: float) -> tuple[Ring, Ring, Ring]:
    """The rings from outer to inner. The angle's end on one ring is the next one's zero or axis."""
    angles = (pan_rad, tilt_rad, roll_rad)
    pan_axis, tilt_axis, roll_axis = rate_axes("YXZ", angles).T
    panned = euler.to_matrix("YXZ", (pan_rad, 0.0, 0.0))
    return (
        Ring("pan", "world", 178.0, pan_axis, np.array([0.0, 0.0, 1.0]), pan_rad),
        Ring("tilt", "light", 144.0, tilt_axis, panned[:, 2], tilt_rad),
        Ring("roll", "ray", 166.0, roll_axis, tilt_axis, roll_rad),
    )


def draw(pan_rad: float, tilt_rad: float, roll_rad: float, view: Floats) -> str:
    """SVG markup of the panel, seen from a side: `body.view_from`."""
    three = rings(pan_rad, tilt_rad, roll_rad)
    C = euler.to_matrix("YXZ", (pan_rad, tilt_rad, roll_rad))
    circles = [on_screen(ring.at(np.linspace(0.0, 2 * math.pi, STEPS + 1)), view) for ring in three]
    together = abs(float(three[0].axis @ three[2].axis))
    widths = ["bold" if together > NEARLY and ring.name != "tilt" else "thin" for ring in three]
    parts = (
        [_glow(circles[0][:, :2], three[2].radius / three[0].radius)] if together > LOCKED else []
    )
    parts += [
        path(runs(circle, front=False), f"{ring.role} {width} faint")
        for ring, circle, width in zip(three, circles, widths, strict=True)
    ]
    parts += [_axis(ring, view, front=False) for ring in three]
    parts.append(body.draw(C, view, CENTRE, 100.0))
    parts += [_axis(ring, view, front=True) for ring in three]
    parts += [
        path(runs(circle, front=True), f"{ring.role} {width}")
        for ring, circle, width in zip(three, circles, widths, strict=True)
    ]
    parts += [mark for ring in three for mark in _angle(ring, view)]
    parts += _legend(three)
    if together > LOCKED:
        parts.append(text((386.0, 22.0), "pan and roll: one axis", "error strong", "end"))
    return "".join(parts)


def _glow(circle: Floats, share: float) -> str:
    """The band between a ring (n, 2) in the panel and one of a ``share`` of its size."""
    inner = np.asarray(CENTRE) + share * (circle[::-1] - CENTRE)
    return polygon(np.concatenate([circle, inner]), "error solid faint")


def _axis(ring: Ring, view: Floats, *, front: bool) -> str:
    """One end of the axis, from near the camera to just outside the ring."""
    depth = on_screen(ring.axis, view)[2]
    end = 1.0 if (depth < 0) == front else -1.0
    inner, outer = (
        on_screen(end * length * ring.axis, view) for length in (112.0, ring.radius + 8.0)
    )
    if end > 0:
        return arrow(inner, outer, ring.role, head=8)
    return line(inner, outer, f"{ring.role} thin dashed")


def _angle(ring: Ring, view: Floats) -> Iterator[str]:
    """The arc from zero to the angle, with a bead at its end."""
    count = max(2, round(abs(ring.angle_rad) * 12))
    arc = on_screen(ring.at(np.linspace(0.0, ring.angle_rad, count + 1)), view)[:, :2].tolist()
    yield polyline(arc, f"{ring.role} bold")
    inner, outer = on_screen(np.stack([ring.at(0.0) * 0.965, ring.at(0.0) * 1.035]), view)
    yield line(inner, outer, ring.role)
    yield dot(arc[-1], ring.role, 5.0)


def _legend(three: tuple[Ring, Ring, Ring]) -> Iterator[str]:
    for row, ring in enumerate(three):
        degrees = format_number(math.degrees(ring.angle_rad), 0)
        at: Point = (14.0, 22.0 + 18.0 * row)
        yield line((at[0], at[1] - 4.5), (at[0] + 18, at[1] - 4.5), f"{ring.role} bold")
        yield text((at[0] + 26, at[1]), f"{ring.name} {degrees}°", f"{ring.role} ground")


def on_screen(points: Floats, view: Floats) -> Floats:
    """World points (..., 3) in the panel: view box x, y, and depth."""
    return body.screen(points, view, CENTRE, 1.0)
