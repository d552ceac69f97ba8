"""2D Transform Explorer: a square and its image on each rung of the ladder of transformations."""

import math

import numpy as np

from simulations.engine.frame import Frame, Panel, Readout, format_number, matrix_text, readout
from simulations.engine.scene import Scene
from simulations.engine.stages import Outputs
from simulations.models.arrays import Floats
from simulations.models.geometry.preserved_properties import Preservation, measure_preservation
from simulations.models.geometry.transforms import apply_homography
from simulations.scenes._mapped_square import family, marks, plane
from simulations.scenes._mapped_square.measures import area_ratio, describe_point, point_readouts
from simulations.scenes._mapped_square.square import grid_segments
from simulations.scenes.transform_2d.handles import HANDLES, matrix
from simulations.scenes.transform_2d.hierarchy import RUNGS, hierarchy_panel
from simulations.scenes.transform_2d.settings import Settings

ROUNDING = 1e-9
"""Largest measured change, in radians or as a share, that counts as rounding."""


def draw(settings: Settings, _outputs: Outputs) -> Frame:
    """The square before and after, the ladder, and the properties that the transformation
    preserves."""
    kind = settings.transform
    H, point = matrix(settings), np.array([settings.point_x, settings.point_y])
    measured = measure_preservation(H, grid_segments())
    return Frame(
        panels=(plane_panel(settings, H, point), hierarchy_panel(kind)),
        readouts=(
            Readout("matrix", "H", matrix_text(entries_of(H)), "", "image"),
            readout("freedoms", "Degrees of freedom", RUNGS[kind].freedoms, digits=0),
            readout("area", "Area, image : original", area_ratio(H), digits=3),
            *preservation_readouts(measured),
            *point_readouts(H, point),
        ),
        description=f"{describe(kind, H, measured)} {describe_point(H, point)}",
    )


def plane_panel(settings: Settings, H: Floats, point: Floats) -> Panel:
    """Original and image on common axes."""
    matrices = family.way(settings.transform)
    pulled = settings.pull_x != 0.0 or settings.pull_y != 0.0
    overlay = "".join(
        (
            plane.axes(),
            plane.figure(np.eye(3), "world"),
            plane.lines_at_infinity(H),
            plane.figure(H, "image"),
            *marks.corners(settings.transform, H),
            marks.point_and_image(H, matrices[: 0 if pulled else None : 4], point),
        )
    )
    return Panel(
        "plane", "Original and image", plane.WIDTH, plane.HEIGHT, overlay=overlay, lead=True
    )


def entries_of(H: Floats) -> list[list[str]]:
    """H with two decimals; four in the last row, whose entries divide by lengths."""
    rows = [[format_number(float(entry), 2) for entry in row] for row in H[:2]]
    affine = not H[2, :2].any()
    last = ["0", "0", "1"] if affine else [format_number(float(entry), 4) for entry in H[2]]
    return [*rows, last]


def preservation_readouts(measured: Preservation) -> tuple[Readout, ...]:
    return (
        Readout("orientation", "Orientation", angle_verdict(measured.turn_rad)),
        Readout("lengths", "Lengths", share_verdict(measured.length)),
        Readout("angles", "Angles", angle_verdict(measured.angle_rad)),
        Readout("parallels", "Parallel lines", angle_verdict(measured.parallel_rad)),
        Readout("lines", "Straight lines", share_verdict(measured.bend)),
    )


def angle_verdict(change_rad: float) -> str:
    if change_rad <= ROUNDING:
        return "kept"
    return f"changed by up to {format_number(math.degrees(change_rad), 1)}°"


def share_verdict(change: float) -> str:
    if change <= ROUNDING:
        return "kept"
    if math.isinf(change):
        return "changed without bound"
    return f"changed by up to {format_number(100.0 * change, 1)}\u00a0%"


def describe(kind: str, H: Floats, measured: Preservation) -> str:
    """One sentence for a reader who cannot see the picture."""
    ratio = area_ratio(H)
    size = (
        "reaches the line that is sent to infinity, so that only a part of its image can be drawn"
        if math.isinf(ratio)
        else f"has an image of {format_number(ratio, 2)} times its area"
    )
    changes = {
        "orientation": measured.turn_rad,
        "lengths": measured.length,
        "angles": measured.angle_rad,
        "parallel lines": measured.parallel_rad,
        "straight lines": measured.bend,
    }
    preserved = [name for name, change in changes.items() if change <= ROUNDING]
    return f"The square under {RUNGS[kind].phrase} {size}; kept: {', '.join(preserved)}."


SCENE = Scene(
    "transform-2d",
    "2D Transform Explorer",
    Settings,
    draw,
    handles=HANDLES,
    formula=apply_homography,
)
