"""Solid angle, irradiance and radiance: three pictures of one square metre of a sunlit page."""

import math

import numpy as np

from simulations.engine.drafting import label
from simulations.engine.drawing import arrow, dot, line, polygon, polyline
from simulations.engine.illustration import Illustration, Panel
from simulations.engine.space.view import View, axes_towards
from simulations.models.arrays import Floats
from simulations.models.light.brdf import Material, reflected
from simulations.models.light.reflectance import lambert

WIDTH, HEIGHT = 300.0, 236.0
SPACE = View(axes_towards((0.25, -2.4, 1.0)), (150.0, 158.0), 104.0)
SUN, ALBEDO = 1000.0, 0.8
"""Irradiance in W/m² of a surface that faces the sun, and the page's albedo."""
SUN_DEG, VIEW_DEG, CONE_DEG = -60.0, 30.0, 12.0
"""Directions from the normal, positive to the right, and half the opening of the cone."""
REACH = 1.45  # length of the cone, in sides of the square


def towards(angle_deg: float) -> tuple[float, float, float]:
    """Unit vector at that angle from the normal, in the plane of sun and camera."""
    angle = math.radians(angle_deg)
    return math.sin(angle), 0.0, math.cos(angle)


def solid_angle() -> float:
    """Solid angle of the cone, sr: the cap that it cuts out of a sphere of radius 1."""
    return 2 * math.pi * (1 - math.cos(math.radians(CONE_DEG)))


def irradiance() -> float:
    """Irradiance of the page, W/m²."""
    return SUN * float(lambert((0.0, 0.0, 1.0), towards(SUN_DEG)))


def radiance() -> float:
    """Radiance of the page towards the camera, W/(m² sr)."""
    cosines = (math.cos(math.radians(each)) for each in (SUN_DEG, VIEW_DEG, VIEW_DEG - SUN_DEG))
    return irradiance() * float(reflected("lambert", Material(ALBEDO, 0.0, 1.0), *cosines))


def power() -> float:
    """Power in W from a square metre of the page into the cone, which is narrow."""
    return radiance() * math.cos(math.radians(VIEW_DEG)) * solid_angle()


def _rim(reach: float) -> Floats:
    """(49, 3) the circle in which the cone ends."""
    axis, across = np.array(towards(VIEW_DEG)), np.array(towards(VIEW_DEG + 90))
    turns = np.linspace(0, 2 * math.pi, 49)[:, None]
    round_it = np.cos(turns) * across + np.sin(turns) * np.array([0.0, 1.0, 0.0])
    half = math.radians(CONE_DEG)
    return reach * (math.cos(half) * axis + math.sin(half) * round_it)


def _cone() -> list[str]:
    rim, foot = SPACE.all(_rim(REACH)), SPACE.at(0, 0, 0)
    turned = np.arctan2(rim[:, 1] - foot[1], rim[:, 0] - foot[0])
    sides = (rim[turned.argmin()], rim[turned.argmax()])
    return [polygon(rim.tolist(), "ray fill"), *(line(foot, side, "ray") for side in sides)]


def _page() -> list[str]:
    """A square metre, and its normal."""
    corners = [(-0.5, -0.5, 0), (0.5, -0.5, 0), (0.5, 0.5, 0), (-0.5, 0.5, 0)]
    tip = SPACE.at(0, 0, 1)
    return [
        polygon([SPACE.at(*corner) for corner in corners], "world fill"),
        arrow(SPACE.at(0, 0, 0), tip, "world"),
        label((tip[0] + 6, tip[1] + 6), "n", "world italic ground"),
    ]


def _panel(name: str, title: str, marks: list[str], below: str) -> Panel:
    foot = label((WIDTH / 2, HEIGHT - 6), below, "muted small", "middle")
    return Panel(name, title, WIDTH, HEIGHT, overlay="".join((*marks, foot)))


def _solid_angle() -> Panel:
    turns = np.linspace(0, 2 * math.pi, 73)
    base = SPACE.all(np.stack([np.cos(turns), np.sin(turns), 0 * turns], axis=-1))
    half = np.radians(np.linspace(-90, 90, 61))
    rows = [np.stack([np.sin(half), 0 * half, np.cos(half)], axis=-1)]
    rows.append(rows[0][:, [1, 0, 2]])
    marks = [polyline(each.tolist(), "muted thin") for each in (*map(SPACE.all, rows), base)]
    marks += [*_cone(), polygon(SPACE.all(_rim(1.0)).tolist(), "ray fill bold")]
    marks.append(dot(SPACE.at(0, 0, 0), "world", 4))
    below = f"cap on a sphere of radius 1: ω = {solid_angle():.2f} sr"
    return _panel("solid-angle", "Solid angle: how wide", marks, below)


def _irradiance() -> Panel:
    back = np.array(towards(SUN_DEG))
    marks = _page()
    for x in (-0.36, -0.12, 0.12, 0.36):
        end = np.array([x, 0.0, 0.0])
        marks.append(arrow(SPACE.at(*(end + 0.9 * back)), SPACE.at(*end), "light"))
    below = f"all that arrives on 1 m²: E = {irradiance():.0f} W/m²"
    return _panel("irradiance", "Irradiance: what arrives", marks, below)


def _radiance() -> Panel:
    tip = SPACE.at(*(np.array(towards(VIEW_DEG)) * REACH))
    v = label((tip[0] + 6, tip[1] + 14), "v", "camera italic ground")
    marks = [*_page(), *_cone(), arrow(SPACE.at(0, 0, 0), tip, "camera"), v]
    below = f"L = {radiance():.0f} W/(m² sr): {power():.0f} W into this cone"
    return _panel("radiance", "Radiance: one direction", marks, below)


def draw() -> Illustration:
    words = (
        f"Solid angle: a cone cuts a cap out of a sphere of radius 1, of {solid_angle():.2f} sr. "
        f"Irradiance: the sun, {-SUN_DEG:.0f}° from the normal, brings {irradiance():.0f} watts "
        f"to a square metre of a page. Radiance: towards a camera {VIEW_DEG:.0f}° from the "
        f"normal the page has {radiance():.0f} watts per square metre and steradian, which is "
        f"{power():.0f} watts into the cone."
    )
    return Illustration((_solid_angle(), _irradiance(), _radiance()), words)
