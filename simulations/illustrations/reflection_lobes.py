"""Directions of reflected light: lobes of chalk, satin paint and glazed china."""

import math

import numpy as np

from simulations.engine.drafting import label
from simulations.engine.drawing import arrow, line, polygon
from simulations.engine.illustration import Illustration, Panel
from simulations.models.arrays import Floats
from simulations.models.light.reflectance import phong

SPOT, UNITS = (150.0, 158.0), 132.0
LIGHT_RAD = math.radians(50)  # angle of the light from the normal, on the left
SURFACES = (
    ("chalk", "Chalk: matte", 0.75, 0.0, 1.0),
    ("satin", "Satin paint: matte and a wide lobe", 0.45, 0.55, 10.0),
    ("china", "Glazed china: a narrow lobe", 0.3, 0.75, 100.0),
)
"""Name, title, albedo, strength and shininess of the highlight."""


def directions(angles_rad: Floats) -> Floats:
    """Unit vectors (n, 3) at angles from the normal, positive to the right."""
    return np.stack([np.sin(angles_rad), np.zeros_like(angles_rad), np.cos(angles_rad)], axis=-1)


def brightness(angles_rad: Floats, albedo: float, specular: float, shininess: float) -> Floats:
    """Brightness seen from each angle, with the light at `LIGHT_RAD` on the left."""
    views = directions(angles_rad)
    normals = np.broadcast_to(np.array([0.0, 0.0, 1.0]), views.shape)
    light = directions(np.array([-LIGHT_RAD]))[0]
    return phong(normals, light, views, albedo, specular=specular, shininess=shininess)


def _place(angle: float, length: float) -> tuple[float, float]:
    return SPOT[0] + length * math.sin(angle), SPOT[1] - length * math.cos(angle)


def draw() -> Illustration:
    angles = np.radians(np.linspace(-90, 90, 361))
    panels = []
    for name, title, albedo, specular, shininess in SURFACES:
        seen = brightness(angles, albedo, specular, shininess)
        lobe = [_place(float(a), UNITS * float(v)) for a, v in zip(angles, seen, strict=True)]
        shown = f"α = {shininess:g}" if specular else "no highlight"
        marks = [
            line((12, SPOT[1]), (288, SPOT[1]), "world bold"),
            line(SPOT, _place(0.0, 148), "muted thin dashed"),
            polygon([SPOT, *lobe], "ray fill"),
            arrow(_place(-LIGHT_RAD, 6), _place(-LIGHT_RAD, 150), "light bold"),
            line(SPOT, _place(LIGHT_RAD, 150), "muted thin dashed"),
            label(np.add(_place(0.0, 148), (6, 8)), "n", "muted italic"),
            label(np.add(_place(LIGHT_RAD, 150), (4, 4)), "r", "muted italic"),
            label(np.add(_place(-LIGHT_RAD, 150), (-4, 4)), "l", "light italic", "end"),
            label((150, SPOT[1] + 22), shown, "muted small", "middle"),
        ]
        panels.append(Panel(name, title, 300.0, 190.0, overlay="".join(marks)))
    words = (
        f"The direction l to the lamp, on the left, is {math.degrees(LIGHT_RAD):.0f}° from the "
        "normal n. The distance of each outline from the lit spot is the brightness seen from that "
        "side. Chalk: a half circle, the same from everywhere. Satin paint adds a wide lobe about "
        "the mirrored direction r, glazed china a narrow one."
    )
    return Illustration(tuple(panels), words)
