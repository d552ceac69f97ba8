"""One sensor behind three lenses: the longer the focal length, the narrower the field of view."""

import math

from simulations.engine.drafting import arc, label
from simulations.engine.drawing import dot, line, polygon
from simulations.engine.illustration import Illustration, Panel
from simulations.models.projection.pinhole import field_of_view_rad

CENTRE = (169.0, 98.0)
UNITS_PER_MM = 1.2
SENSOR_MM = 36.0
LENSES = ((24.0, "image"), (50.0, "world"), (135.0, "light"))
"""Focal length in mm, and the colour of the lens."""
REACH = 118.0


def draw() -> Illustration:
    half = SENSOR_MM * UNITS_PER_MM / 2
    marks = []
    for index, (focal, role) in enumerate(LENSES):
        angle = field_of_view_rad(focal, SENSOR_MM) / 2
        radius = REACH + 14 * index
        up = (CENTRE[0] + radius * math.cos(angle), CENTRE[1] - radius * math.sin(angle))
        down = (up[0], 2 * CENTRE[1] - up[1])
        sensor = CENTRE[0] - focal * UNITS_PER_MM
        marks += [
            polygon([CENTRE, up, down], f"{role} fill thin"),
            line((sensor, CENTRE[1] + half), CENTRE, f"{role} thin"),
            line((sensor, CENTRE[1] - half), CENTRE, f"{role} thin"),
            line((sensor, CENTRE[1] - half), (sensor, CENTRE[1] + half), f"{role} bold"),
            arc(CENTRE, 52.0 + 26 * index, -angle, angle, role),
            label((up[0] + 6, up[1] + 3), f"{focal:g} mm: {math.degrees(2 * angle):.1f}°", role),
        ]
    above = (CENTRE[0] - 135 * UNITS_PER_MM - 4, CENTRE[1] - half - 12)
    name = f"sensor, {SENSOR_MM:g} mm wide"
    marks += [dot(CENTRE, "camera", 5), label(above, name, "muted small")]
    fields = ", ".join(
        f"{math.degrees(field_of_view_rad(focal, SENSOR_MM)):.1f}° at {focal:g} mm"
        for focal, _ in LENSES
    )
    words = (
        f"From above: a sensor {SENSOR_MM:g} mm wide behind lenses of three focal lengths, and its "
        f"fields of view: {fields}."
    )
    return Illustration((Panel("plan", "", 400.0, 196.0, overlay="".join(marks)),), words)
