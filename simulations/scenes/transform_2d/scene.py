"""2D Transform Explorer: a square and its image on each rung of the ladder of transformations."""

import math
from dataclasses import dataclass

import numpy as np

from simulations.engine.frame import Frame, Readout, format_number, matrix_text, readout
from simulations.engine.scene import Scene
from simulations.engine.settings import choice, slider
from simulations.engine.stages import Outputs
from simulations.models.arrays import Floats
from simulations.models.geometry import transforms
from simulations.models.geometry.preserved_properties import Preservation, measure_preservation
from simulations.scenes.transform_2d.hierarchy import RUNGS, hierarchy_panel
from simulations.scenes.transform_2d.plane import SQUARE, grid_segments, image_of, plane_panel

KEPT = 1e-9
"""Largest measured change, in radians or as a share, that rounding explains."""


@dataclass(frozen=True, slots=True)
class Settings:
    """What the reader may change."""

    transform: str = choice("Transform", {name: rung.title for name, rung in RUNGS.items()})
    amount: float = slider("Amount", 30, 0, 100, 1)


def transformation(kind: str, amount: float) -> Floats:
    """The matrix of a rung: that of the rung below it, with one more freedom in use."""
    tx, ty = amount, amount / 2.0
    if kind == "translation":
        return transforms.translation(tx, ty)
    angle_rad = math.radians(amount / 2.0)
    if kind == "rigid":
        return transforms.rigid(angle_rad, tx, ty)
    H = transforms.similarity(1.0 + amount / 200.0, angle_rad, tx, ty)
    if kind == "similarity":
        return H
    shear = [[1.0 + amount / 500.0, amount / 250.0], [0.0, 1.0 - amount / 300.0]]
    H = H @ transforms.affine(shear, (0.0, 0.0))
    if kind == "affine":
        return H
    tilt = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [-amount / 10000.0, amount / 3000.0, 1.0]]
    return transforms.projective(H @ tilt)


def draw(settings: Settings, _outputs: Outputs) -> Frame:
    """The square before and after, the ladder, and what the transformation measurably keeps."""
    kind = settings.transform
    H = transformation(kind, settings.amount)
    measured = measure_preservation(H, grid_segments())
    return Frame(
        panels=(plane_panel(H), hierarchy_panel(kind)),
        readouts=(
            Readout("matrix", "H", matrix_text(entries_of(H)), "", "image"),
            readout("freedoms", "Degrees of freedom", RUNGS[kind].freedoms, digits=0),
            readout("area", "Area, image : original", area_ratio(H), digits=3),
            *preservation_readouts(measured),
        ),
        description=describe(kind, H, measured),
    )


def entries_of(H: Floats) -> list[list[str]]:
    """H with two decimals; four in the last row, whose entries divide by lengths."""
    rows = [[format_number(float(entry), 2) for entry in row] for row in H[:2]]
    affine = not H[2, :2].any()
    last = ["0", "0", "1"] if affine else [format_number(float(entry), 4) for entry in H[2]]
    return [*rows, last]


def area_ratio(H: Floats) -> float:
    """Area of the square's image over that of the square; infinite where it is cut."""
    image = image_of(H, SQUARE)
    return math.inf if image.cut else area(image.points) / area(SQUARE)


def area(polygon: Floats) -> float:
    """Area by the shoelace formula."""
    x, y = polygon[:, 0], polygon[:, 1]
    return 0.5 * abs(float(x @ np.roll(y, -1) - y @ np.roll(x, -1)))


def preservation_readouts(measured: Preservation) -> tuple[Readout, ...]:
    return (
        Readout("orientation", "Orientation", angle_verdict(measured.turn_rad)),
        Readout("lengths", "Lengths", share_verdict(measured.length)),
        Readout("angles", "Angles", angle_verdict(measured.angle_rad)),
        Readout("parallels", "Parallel lines", angle_verdict(measured.parallel_rad)),
        Readout("lines", "Straight lines", share_verdict(measured.bend)),
    )


def angle_verdict(change_rad: float) -> str:
    if change_rad <= KEPT:
        return "kept"
    return f"changed by up to {format_number(math.degrees(change_rad), 1)}°"


def share_verdict(change: float) -> str:
    if change <= KEPT:
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
    kept = [name for name, change in changes.items() if change <= KEPT]
    return f"The square under {RUNGS[kind].phrase} {size}; kept: {', '.join(kept)}."


SCENE = Scene("transform-2d", "2D Transform Explorer", Settings, draw)
