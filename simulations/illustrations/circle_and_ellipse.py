"""A circle on a tiled road and its image: an ellipse with a different centre."""

import numpy as np

from simulations.engine.drafting import label
from simulations.engine.drawing import dot, line, path, polygon
from simulations.engine.illustration import Illustration, Panel
from simulations.models.arrays import Floats
from simulations.models.geometry.transforms import apply_homography

WIDTH, HEIGHT = 320.0, 236.0
H = np.array([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.5, 0.0, 1.0]])
"""The road of the chapter's example."""
UNIT = 52.0  # units of the drawing per unit of the plane
COLUMNS, ROWS = np.linspace(-1.0, 3.0, 9), np.linspace(-1.0, 1.0, 5)
TURN = np.linspace(0.0, 2 * np.pi, 97)[:-1]
CIRCLE = np.stack([np.cos(TURN), np.sin(TURN)], axis=-1)


def image(points: Floats) -> Floats:
    return apply_homography(H, points)[0]


def middle(outline: Floats) -> Floats:
    """Halfway between the extremes of an outline (n, 2)."""
    return (outline.min(axis=0) + outline.max(axis=0)) / 2


def _tiles() -> list[Floats]:
    upright = [np.array([(x, ROWS[0]), (x, ROWS[-1])]) for x in COLUMNS]
    level = [np.array([(COLUMNS[0], y), (COLUMNS[-1], y)]) for y in ROWS]
    return upright + level


def _placed(points: Floats, left: float) -> Floats:
    """Places in units of a drawing whose left border is at ``left`` in the plane."""
    return (np.asarray(points) - (left, 0.0)) * (UNIT, -UNIT) + (0.0, HEIGHT / 2)


def _plane() -> Panel:
    left = -2.1
    marks = [
        path((_placed(ends, left) for ends in _tiles()), "muted thin"),
        polygon(_placed(CIRCLE, left), "world bold"),
        dot(tuple(_placed(np.zeros(2), left)), "world"),
        label(tuple(_placed(np.array([0.0, -1.3]), left)), "a circle", "world", "middle"),
    ]
    return Panel("plane", "The road, from above", WIDTH, HEIGHT, overlay="".join(marks))


def _named(name: str, at: Floats, away: tuple[float, float], role: str, anchor: str) -> list[str]:
    """A label at the end of a line from the place that it names."""
    x, y = at[0] + away[0], at[1] + away[1]
    place = (x + (4.0 if away[0] > 0 else -4.0), y + 4.0)
    return [line((at[0], at[1]), (x, y), f"{role} thin"), label(place, name, role, anchor)]


def _picture() -> Panel:
    left = -3.4
    ellipse = image(CIRCLE)
    centre, between = _placed(image(np.zeros(2)), left), _placed(middle(ellipse), left)
    marks = [
        path((_placed(image(ends), left) for ends in _tiles()), "muted thin"),
        polygon(_placed(ellipse, left), "image bold"),
        dot(tuple(centre), "world"),
        dot(tuple(between), "error"),
        *_named("middle", between, (-74.0, -58.0), "error", "end"),
        *_named("centre", centre, (74.0, -58.0), "world", "start"),
    ]
    return Panel("picture", "Its image", WIDTH, HEIGHT, overlay="".join(marks))


def draw() -> Illustration:
    ends = image(np.array([(-1.0, 0.0), (1.0, 0.0)]))[:, 0]
    return Illustration(
        (_plane(), _picture()),
        "A circle of radius 1 about the origin of a tiled road, and its image under the homography "
        f"of the example: an ellipse from {ends[0]:g} to {ends[1]:.2f}. The image of the circle's "
        f"centre is still at 0, and the middle of the ellipse at {ends.mean():.2f}.",
    )
