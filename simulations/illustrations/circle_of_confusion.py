"""The circle of confusion: the sensor cuts a near point's cone before its tip."""

from simulations.engine.drafting import dimension, glass, label
from simulations.engine.drawing import dot, line, polygon, polyline
from simulations.engine.illustration import Illustration, Panel
from simulations.models.lens.thin_lens import (
    circle_of_confusion_mm,
    principal_distance_mm,
    thin_lens_image_distance,
)

LENS, AXIS = 214.0, 118.0
FOCAL, F_NUMBER, FOCUS, NEAR = 66.0, 0.74, 190.0, 128.0
"""All lengths are in units of the drawing, as millimetres."""


def tip() -> float:
    """The point where the light of the near point meets."""
    return float(thin_lens_image_distance(FOCAL, NEAR))


def sensor() -> float:
    return principal_distance_mm(FOCAL, FOCUS)


def disc() -> float:
    return float(circle_of_confusion_mm(FOCAL, F_NUMBER, FOCUS, NEAR))


def draw() -> Illustration:
    half, c = FOCAL / F_NUMBER / 2, disc()
    place = LENS + sensor()
    corners = ((-2.5, -c / 2), (2.5, -c / 2), (2.5, c / 2), (-2.5, c / 2))
    marks = [line((6, AXIS), (394, AXIS), "muted thin dashed")]
    for sign in (-1, 1):
        rim = (LENS, AXIS + sign * half)
        edge = (place, AXIS + sign * c / 2)
        marks += [
            polyline([(LENS - FOCUS, AXIS), rim, (place, AXIS)], "ray thin"),
            polyline([(LENS - NEAR, AXIS), rim, edge], "world"),
            line(edge, (LENS + tip(), AXIS), "world thin dashed"),
            line(rim, (LENS, AXIS + sign * (half + 24)), "camera bold"),
        ]
    marks += [
        glass((LENS, AXIS), half, 8),
        line((place, AXIS - 76), (place, AXIS + 76), "image bold"),
        polygon([(place + x, AXIS + y) for x, y in corners], "error solid"),
        dot((LENS - FOCUS, AXIS), "ray", 5),
        dot((LENS - NEAR, AXIS), "world", 5),
        dot((LENS + tip(), AXIS), "world", 3.5),
        dimension((LENS - NEAR, 212), (LENS, 212), "world"),
        dimension((LENS - FOCUS, 244), (LENS, 244), "ray"),
        dimension((LENS, 212), (place, 212), "image"),
        dimension((LENS, 244), (LENS + tip(), 244), "world"),
        dimension((LENS - 22, AXIS - half), (LENS - 22, AXIS + half), "camera"),
        label((LENS - 30, AXIS - 16), "A", "camera italic ground", "end"),
        label((LENS - NEAR / 2, 207), "Z", "world italic", "middle"),
        label((LENS - FOCUS / 2 - 30, 239), "s", "ray italic", "middle"),
        label((LENS + sensor() / 2, 207), "z_s", "image italic", "middle"),
        label((LENS + tip() / 2, 239), "z", "world italic", "middle"),
        label((place + 10, AXIS - c / 2 - 6), "c", "error italic"),
        label((place, AXIS - 84), "sensor", "image", "middle"),
        label((LENS, AXIS - half - 32), "lens", "camera", "middle"),
    ]
    words = (
        "A lens is focused at distance s, whose light its sensor gathers in a point. "
        f"The light of a nearer point, at {NEAR / FOCUS:.2f} of that distance, would meet behind "
        f"the sensor, which cuts its cone in a disc of diameter c, {c / (FOCAL / F_NUMBER):.2f} of "
        "the opening A."
    )
    return Illustration((Panel("section", "", 400.0, 268.0, overlay="".join(marks)),), words)
