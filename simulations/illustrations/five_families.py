"""The five families of plane transformations, each applied to a card."""

import math

import numpy as np

from simulations.engine.drafting import label
from simulations.engine.drawing import path, polygon
from simulations.engine.illustration import Illustration, Panel
from simulations.models.arrays import Floats
from simulations.models.geometry import transforms
from simulations.pictures import playing_card

WIDTH, HEIGHT, UNITS = 190.0, 218.0, 82.0
FAMILIES = (
    ("Translation", 2, transforms.translation(0.45, 0.3)),
    ("Rigid", 3, transforms.rigid(math.radians(24), 0.45, 0.3)),
    ("Similarity", 4, transforms.similarity(1.3, math.radians(24), 0.45, 0.3)),
    ("Affine", 6, transforms.affine([[1.2, 0.45], [0.1, 0.75]], [0.3, 0.2])),
    ("Projective", 8, transforms.projective([1.05, 0.25, 0.3, 0.0, 1.1, 0.2, 0.3, 0.12, 1.0])),
)
"""Name, degrees of freedom, a member of the family."""
LINES = np.linspace(0, 1, 5)
CARD = np.array([(0, 0), (1, 0), (1, 1), (0, 1)], float)


def mapped(H: Floats, points: Floats) -> Floats:
    """Points (n, 2) of the unit square after ``H``, in view box units."""
    x, y = transforms.apply_homography(H, points)[0].T
    return np.stack([24 + UNITS * x, HEIGHT - 36 - UNITS * y], axis=-1)


def grid(H: Floats) -> list[Floats]:
    """The lines of the card, by their ends, as all five families preserve straight lines."""
    rows = [np.array([(0.0, c), (1.0, c)]) for c in LINES]
    columns = [np.array([(c, 0.0), (c, 1.0)]) for c in LINES]
    return [mapped(H, ends) for ends in (*rows, *columns)]


def draw() -> Illustration:
    panels = []
    for name, freedoms, H in FAMILIES:
        marks = [
            polygon(mapped(np.eye(3), CARD), "muted thin dashed"),
            path(grid(H), "image thin"),
            polygon(mapped(H, CARD), "image"),
            playing_card.card_markup(
                mapped(H, 0.5 + playing_card.OUTLINE / 80),
                [mapped(H, 0.5 + shape / 80) for shape in playing_card.MARKS],
            ),
            label((WIDTH / 2, HEIGHT - 8), f"{freedoms} degrees of freedom", "muted", "middle"),
        ]
        panels.append(Panel(name.lower(), name, WIDTH, HEIGHT, overlay="".join(marks)))
    words = "A playing card on a square, before and after a member of each family: " + ", ".join(
        f"{name.lower()} ({freedoms} degrees of freedom)" for name, freedoms, _ in FAMILIES
    )
    return Illustration(
        tuple(panels), f"{words}. The last makes one side shorter than its opposite."
    )
