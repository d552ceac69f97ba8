"""A tiled plane and its image: parallels meet, all of them on the image of the line at infinity."""

import numpy as np

from simulations.engine.drafting import label
from simulations.engine.drawing import dot, line, path, polygon
from simulations.engine.illustration import Illustration, Panel
from simulations.models.arrays import Floats
from simulations.models.geometry.lines_and_planes import line_through
from simulations.models.geometry.transforms import apply_homography

WIDTH, HEIGHT = 320.0, 236.0
H = np.array([[85.5, 10.5, 160.0], [13.5, 13.5, 226.0], [0.3, 0.3, 1.0]])
"""From tiles to units of the second drawing; its columns are the images of (1, 0, 0), (0, 1, 0)
and (0, 0, 1)."""
TILES = 5
WAYS = (("world", (1.0, 0.0)), ("image", (0.0, 1.0)), ("ray", (1.0, 1.0)))
"""Role and direction of the lines: both sides of the tiles, and their diagonals."""
TILE = np.array([(1, 1), (2, 1), (2, 2), (1, 2)], float)


def image(points: Floats) -> Floats:
    """Points (n, 2) of the tiled plane, in units of the second drawing."""
    return apply_homography(H, points)[0]


def vanishing(direction: tuple[float, float]) -> Floats:
    """The image of the point at infinity in that direction: H (x, y, 0)."""
    u, v, w = H @ np.array([*direction, 0.0])
    return np.array([u / w, v / w])


def horizon(x: float) -> tuple[float, float]:
    """The image of the line at infinity at column ``x``: it joins two vanishing points."""
    a, b, c = line_through(vanishing(WAYS[0][1]), vanishing(WAYS[1][1]))[0]
    return x, float(-(a * x + c) / b)


def lines(direction: tuple[float, float]) -> list[Floats]:
    """The ends of the lines that run in ``direction``."""
    if direction == (1.0, 1.0):
        return [np.array([(0.0, 0.0), (TILES, TILES)])]
    rows = [np.array([(0.0, n), (TILES, n)]) for n in range(TILES + 1)]
    return rows if direction == (1.0, 0.0) else [ends[:, ::-1] for ends in rows]


def _plane() -> Panel:
    def above(points: Floats) -> Floats:
        return np.array([60.0, 222.0]) + points * np.array([40.0, -40.0])

    marks = [polygon(above(TILE), "muted fill thin")]
    marks += [path(map(above, lines(direction)), role) for role, direction in WAYS]
    return Panel("plane", "Tiles, from above", WIDTH, HEIGHT, overlay="".join(marks))


def _picture() -> Panel:
    marks = [
        polygon(image(TILE), "muted fill thin"),
        line(horizon(2), horizon(318), "muted dashed"),
    ]
    for role, direction in WAYS:
        point, drawn = vanishing(direction), [image(ends) for ends in lines(direction)]
        marks.append(path([(ends[-1], point) for ends in drawn], f"{role} thin faint"))
        marks += [path(drawn, role), dot(point, role, 4.5)]
    where = (WIDTH / 2, horizon(WIDTH / 2)[1] - 14)
    marks.append(label(where, "image of the line at infinity", "muted", "middle"))
    return Panel("picture", "The same tiles, in a picture", WIDTH, HEIGHT, overlay="".join(marks))


def draw() -> Illustration:
    words = (
        f"{TILES} by {TILES} tiles from above, and in perspective. In the picture the lines of "
        "each of two directions, and the diagonal, run to three points. All three lie on one "
        "dashed line, the image of the line at infinity."
    )
    return Illustration((_plane(), _picture()), words)
