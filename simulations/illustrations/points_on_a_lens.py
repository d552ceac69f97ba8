"""Sixteen points on a lens for sixteen rays: independent, one in each cell, and on a spiral."""

import numpy as np

from simulations.engine.drafting import label, polar
from simulations.engine.drawing import circle, dot, line
from simulations.engine.illustration import Illustration, Panel
from simulations.models.arrays import Floats
from simulations.models.lens.aperture import fibonacci_disc, jittered_disc, random_disc

RADIUS, TOP, COLUMNS = 56.0, 66.0, (68.0, 200.0, 332.0)
RINGS = PARTS = 4


def patterns() -> tuple[tuple[str, Floats], ...]:
    """The name of each way to choose, and its points (16, 2) on the unit disc."""
    count, rng = RINGS * PARTS, np.random.default_rng(8)
    return (
        ("independent", random_disc(count, (), rng)),
        ("one in each cell", jittered_disc(RINGS, PARTS, (), rng)),
        ("on a spiral", fibonacci_disc(count)),
    )


def draw() -> Illustration:
    marks = []
    for x, (name, points) in zip(COLUMNS, patterns(), strict=True):
        marks.append(circle((x, TOP), RADIUS, "camera"))
        if name == "one in each cell":
            rings = (RADIUS * np.sqrt(ring / RINGS) for ring in range(1, RINGS))
            marks += [circle((x, TOP), float(radius), "muted thin") for radius in rings]
            for part in range(PARTS):
                end = polar((x, TOP), RADIUS, 2 * np.pi * part / PARTS)
                marks.append(line((x, TOP), end, "muted thin"))
        places = [(x + RADIUS * right, TOP + RADIUS * down) for right, down in points.tolist()]
        marks += [dot(place, "ray", 3.5) for place in places]
        marks.append(label((x, TOP + RADIUS + 22), name, "", "middle"))
    words = (
        f"Three discs with {RINGS * PARTS} points each. Independent points lie close together here "
        "and leave gaps there; with one in each cell of equal area the gaps are smaller; on a "
        "spiral all points keep their distance."
    )
    return Illustration((Panel("discs", "", 400.0, 150.0, overlay="".join(marks)),), words)
