"""The line in the picture in which the plane of focus cuts the floor."""

import math

from simulations.pictures.still_life.light import LitScene
from simulations.pictures.still_life.things import WALL_DISTANCE
from simulations.scenes._still_life_camera.focus_plane import floor_tangent, line_on_floor
from simulations.scenes._still_life_camera.rays import SENSOR_WIDTH_MM, principal_mm
from simulations.scenes.depth_of_field.drawing import HEIGHT, WIDTH


def units_per_tangent(focal_length: float, focus: float) -> float:
    """View box units of the picture per tangent of the angle from the axis."""
    return WIDTH * principal_mm(focal_length, focus) / SENSOR_WIDTH_MM


def floor_row(focal_length: float, focus: float) -> float | None:
    """Row of the view box in which the plane cuts the floor; None outside the picture."""
    if focus > WALL_DISTANCE:
        return None
    row = HEIGHT / 2 + floor_tangent(focus) * units_per_tangent(focal_length, focus)
    return row if row < HEIGHT else None


def focus_of_row(focal_length: float, row: float) -> float:
    """The inverse of `floor_row`, metres; ∞ from the horizon upwards.

    A floor s metres away is imaged at (a/s + b) u z, where u z are the units per tangent and
    1/z = 1/f - 1/s for the sensor's distance z: solved for 1/s.
    """
    at_infinity, per_metre = floor_tangent(math.inf), floor_tangent(1.0) - floor_tangent(math.inf)
    units_per_mm = WIDTH / SENSOR_WIDTH_MM
    below = (row - HEIGHT / 2) / units_per_mm
    nearness = (below / focal_length - at_infinity) / (per_metre + below / 1000.0)
    return 1.0 / nearness if nearness > 0 else math.inf


def focus_line(lit: LitScene, focal_length: float, focus: float, enlarged: float) -> str:
    """SVG of the line, where no thing hides it."""
    row = floor_row(focal_length, focus)
    return "" if row is None else line_on_floor(lit, row, WIDTH, HEIGHT, enlarged)
