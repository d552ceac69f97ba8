"""Apertures to scale: each stop halves the area of the opening."""

from simulations.engine.drafting import label
from simulations.engine.drawing import circle
from simulations.engine.illustration import Illustration, Panel

FOCAL_MM = 50.0
STOPS = tuple(2 ** (step / 2) for step in range(1, 7))
NAMES = ("1.4", "2", "2.8", "4", "5.6", "8")
"""The engraved f-numbers; the true ones are powers of √2."""
UNITS_PER_MM = 2.3


def diameter_mm(f_number: float) -> float:
    return FOCAL_MM / f_number


def draw() -> Illustration:
    marks, x = [], 10.0
    rim = UNITS_PER_MM * diameter_mm(STOPS[0]) / 2
    for index, (f_number, name) in enumerate(zip(STOPS, NAMES, strict=True)):
        radius = UNITS_PER_MM * diameter_mm(f_number) / 2
        width = max(2 * radius, 34.0)
        centre = (x + width / 2, 10 + rim)
        marks.append(circle(centre, radius, "light fill"))
        marks.append(label((centre[0], 2 * rim + 30), f"f/{name}", "camera", "middle"))
        share = "1" if index == 0 else f"1/{round((f_number / STOPS[0]) ** 2)}"
        marks.append(label((centre[0], 2 * rim + 46), share, "light small", "middle"))
        x += width + 12
    words = "The openings of a 50 mm lens, to scale: " + ", ".join(
        f"f/{name} {diameter_mm(f):.1f} mm" for f, name in zip(STOPS, NAMES, strict=True)
    )
    return Illustration(
        (Panel("row", "", 400.0, 132.0, overlay="".join(marks)),),
        f"{words}. Each has half the area of the one before.",
    )
