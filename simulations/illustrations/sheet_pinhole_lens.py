"""Two points imaged by a bare sheet, a pinhole and a lens: fog, a dim picture, a bright one."""

import numpy as np

from simulations.engine.drafting import glass
from simulations.engine.drawing import dot, line, path
from simulations.engine.illustration import Illustration, Panel
from simulations.models.lens.thin_lens import thin_lens_image_distance

WIDTH, HEIGHT, MIDDLE = 320.0, 210.0, 104.0
SOURCE, OPENING, FOCAL = 24.0, 190.0, 70.0
"""Columns of the points and of the opening, and the focal length, in view box units."""
SHEET = OPENING + float(thin_lens_image_distance(FOCAL, OPENING - SOURCE))
"""Column of the image, where the lens focuses the light of the points."""
POINTS = (("world", -46.0), ("light", 40.0))  # heights of the two points below the axis
HALF_LENS, HALF_SHEET = 56.0, 92.0

type Ray = list[tuple[float, float]]


def height_on_sheet(height: float, at_opening: float, focal: float) -> float:
    """Where a ray from the point meets the sheet: a thin lens bends it by its height over F."""
    slope = (at_opening - height) / (OPENING - SOURCE) - at_opening / focal
    return at_opening + slope * (SHEET - OPENING)


def _rays_through(height: float, heights: np.ndarray, focal: float) -> list[Ray]:
    start = (SOURCE, MIDDLE + height)
    rows = [(MIDDLE + y, MIDDLE + height_on_sheet(height, y, focal)) for y in heights.tolist()]
    return [[start, (OPENING, opening), (SHEET, sheet)] for opening, sheet in rows]


def _straight(height: float) -> list[Ray]:
    ends = np.linspace(-HALF_SHEET + 8, HALF_SHEET - 8, 7)
    return [[(SOURCE, MIDDLE + height), (SHEET, MIDDLE + float(y))] for y in ends]


def _wall(opening: float) -> str:
    heights = [(sign * opening, sign * HALF_SHEET) for sign in (-1, 1)]
    ends = [((OPENING, MIDDLE + inner), (OPENING, MIDDLE + outer)) for inner, outer in heights]
    return "".join(line(*pair, "camera bold") for pair in ends)


def _panel(name: str, title: str, rays: list[list[Ray]], opening: str) -> Panel:
    marks = [line((SHEET, MIDDLE - HALF_SHEET), (SHEET, MIDDLE + HALF_SHEET), "image bold")]
    for (role, height), of_point in zip(POINTS, rays, strict=True):
        marks += [path(of_point, f"{role} thin"), dot((SOURCE, MIDDLE + height), role, 5.5)]
        marks += [dot(ray[-1], role, 3) for ray in of_point]
    return Panel(name, title, WIDTH, HEIGHT, overlay="".join([*marks, opening]))


def draw() -> Illustration:
    across = np.linspace(-HALF_LENS + 6, HALF_LENS - 6, 7)
    lens = _wall(HALF_LENS) + glass((OPENING, MIDDLE), HALF_LENS, 9)
    straight, dim, bright = (
        [_straight(y) for _, y in POINTS],
        [_rays_through(y, np.zeros(1), np.inf) for _, y in POINTS],
        [_rays_through(y, across, FOCAL) for _, y in POINTS],
    )
    panels = (
        _panel("sheet", "A sheet alone", straight, ""),
        _panel("pinhole", "A pinhole", dim, _wall(3)),
        _panel("lens", "A lens", bright, lens),
    )
    words = (
        "Two points and a sheet. With nothing between, every point lights the whole sheet. A "
        "pinhole lets one ray of each point through, to its own place, upside down. A lens bends "
        "seven rays of each point to that same place."
    )
    return Illustration(panels, words)
