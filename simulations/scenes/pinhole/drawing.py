"""The box from the side: two beams of distant points, the hole, and their spots on the wall.

Across the axis, the hole and the spots have the same scale. Along it, nothing is to scale.
"""

from simulations.engine import drawing
from simulations.engine.handles import Point
from simulations.models.lens.pinhole import spread_mm
from simulations.scenes.pinhole.stages import DEPTH_MM, WAVELENGTHS_UM

WIDTH, HEIGHT = 400.0, 350.0
MIDDLE = 174.0
FRONT, WALL = 196.0, 364.0
"""Columns of the side with the hole and of the wall with the picture."""
HALF_BOX = 150.0
UNITS_PER_MM = 72.0
RISE = 0.44
"""Slope of a beam."""
BEAMS = (("world", 1.0), ("light", -1.0))
"""Signs of the slopes of a point above, whose light falls on the lower part of the wall, and of a
point below."""
START = 16.0


def rim(hole_mm: float) -> Point:
    """The upper rim of the hole."""
    return FRONT, MIDDLE - hole_mm * UNITS_PER_MM / 2.0


def hole_at(place: Point) -> float:
    """The hole, mm, whose upper or lower rim is at a height."""
    return 2.0 * abs(MIDDLE - place[1]) / UNITS_PER_MM


def section(hole_mm: float) -> str:
    """The box, the beams, and the spots."""
    half = hole_mm * UNITS_PER_MM / 2.0
    spread = spread_mm(hole_mm, DEPTH_MM, WAVELENGTHS_UM[1]) * UNITS_PER_MM / 2.0
    parts = [_beam(role, side, half, spread) for role, side in BEAMS]
    return "".join([*parts, _box(half), *_words()])


def _beam(role: str, side: float, half: float, spread: float) -> str:
    """Light of a distant point: the straight beam, and its spread by diffraction."""
    back, on = -side * RISE * (FRONT - START), side * RISE * (WALL - FRONT)
    band = [
        (START, MIDDLE + back - half),
        (WALL, MIDDLE + on - half),
        (WALL, MIDDLE + on + half),
        (START, MIDDLE + back + half),
    ]
    fan = [[(FRONT, MIDDLE), (WALL, MIDDLE + on + end)] for end in (-spread, spread)]
    reach = max(half, spread)
    spot = ((WALL, MIDDLE + on - reach), (WALL, MIDDLE + on + reach))
    return (
        drawing.polygon(band, f"{role} fill thin")
        + drawing.path(fan, f"{role} thin dashed")
        + drawing.line(*spot, f"{role} bold")
    )


def _box(half: float) -> str:
    top, bottom = MIDDLE - HALF_BOX, MIDDLE + HALF_BOX
    outline = [
        (FRONT, MIDDLE - half),
        (FRONT, top),
        (WALL + 4.0, top),
        (WALL + 4.0, bottom),
        (FRONT, bottom),
        (FRONT, MIDDLE + half),
    ]
    return drawing.polyline(outline, "camera bold")


def _words() -> list[str]:
    above = MIDDLE - HALF_BOX - 8.0
    return [
        drawing.text((FRONT, above), "hole", "camera small ground", "middle"),
        drawing.text((WALL, above), "wall", "camera small ground", "middle"),
        drawing.text((START, HEIGHT - 10.0), "from a far scene", "muted small"),
        drawing.text((WIDTH - 8.0, HEIGHT - 10.0), "dashed: diffraction", "muted small", "end"),
    ]
