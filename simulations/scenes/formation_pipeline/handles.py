"""Handles of the formation pipeline: the marker on its path, a line of the ledger, and the
camera."""

import math
from collections.abc import Mapping
from itertools import pairwise

from simulations.engine.controls import Value
from simulations.engine.handles import Handle, Point
from simulations.engine.stages import Outputs
from simulations.scenes.formation_pipeline.drawing import (
    AXIS_ROW,
    BULLET_COLUMN,
    LEDGER_TOP,
    ROW_HEIGHT,
    UNITS_PER_METRE,
    WALL_COLUMN,
    lens_column,
    place,
    route,
)
from simulations.scenes.formation_pipeline.settings import LAST_STATION, Settings

LENS_FOOT = 34.0
"""Distance of the lens's handle below the axis, in view box units."""


def _marker(settings: Settings, _outputs: Outputs) -> Point:
    return place(route(settings.distance), settings.station)[0]


def _marker_pulled(settings: Settings, pointer: Point) -> Mapping[str, Value]:
    return {"station": nearest_station(route(settings.distance), pointer)}


def nearest_station(legs: tuple[tuple[Point, ...], ...], pointer: Point) -> float:
    """Position on the path nearest to ``pointer``, in stations."""
    candidates = []
    for index, leg in enumerate(legs):
        length, come = sum(math.dist(a, b) for a, b in pairwise(leg)), 0.0
        for a, b in pairwise(leg):
            side = math.dist(a, b)
            along = (pointer[0] - a[0]) * (b[0] - a[0]) + (pointer[1] - a[1]) * (b[1] - a[1])
            share = min(max(along / side**2, 0.0), 1.0)
            foot = (a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1]))
            candidates.append((math.dist(foot, pointer), index + (come + share * side) / length))
            come += side
    return min(candidates)[1]


def _line(settings: Settings, _outputs: Outputs) -> Point:
    return (BULLET_COLUMN, LEDGER_TOP + (int(settings.station) + 0.5) * ROW_HEIGHT)


def _line_pulled(_settings: Settings, pointer: Point) -> Mapping[str, Value]:
    row = math.floor((pointer[1] - LEDGER_TOP) / ROW_HEIGHT)
    return {"station": float(min(max(row, 0), LAST_STATION))}


def _camera(settings: Settings, _outputs: Outputs) -> Point:
    return (lens_column(settings.distance), AXIS_ROW + LENS_FOOT)


def _camera_pulled(_settings: Settings, pointer: Point) -> Mapping[str, Value]:
    return {"distance": (pointer[0] - WALL_COLUMN) / UNITS_PER_METRE}


HANDLES: tuple[Handle[Settings], ...] = (
    Handle("marker", "way", "Light", ("station",), _marker, _marker_pulled, "press", "ray"),
    Handle("camera", "way", "Camera", ("distance",), _camera, _camera_pulled, role="camera"),
    Handle("line", "ledger", "Mark in the list", ("station",), _line, _line_pulled, "press"),
)
