"""What the photographs cover, and what to photograph next."""

import math
from dataclasses import dataclass

import numpy as np

from simulations.models.arrays import Floats
from simulations.models.calibration.bundle_adjustment import Adjusted
from simulations.models.calibration.views import Views

CELLS = 8
"""Cells of the map of coverage along the longer side of the picture."""

ENOUGH_PHOTOGRAPHS, ENOUGH_COVERED = 10, 0.8
TILTED_RAD = math.radians(20.0)
"""Tilt from which a board tells the focal length well."""
ENOUGH_TILTED = 4
MIDDLE = "middle"
REGIONS = (
    ("top left", "top", "top right"),
    ("left", MIDDLE, "right"),
    ("bottom left", "bottom", "bottom right"),
)


@dataclass(frozen=True, slots=True)
class Coverage:
    """Where in the picture corners were found, and how the boards stood."""

    cells: Floats
    """(rows, columns) corners in each cell of the picture."""
    tilt_rad: Floats
    """(P,) angle between the board and the picture."""
    distance: Floats
    """(P,) from the camera to the middle of the board's corners, in squares."""

    @property
    def share(self) -> float:
        """Share of the cells that have a corner."""
        return float((self.cells > 0).mean())


def coverage(views: Views, fit: Adjusted, size: tuple[int, int]) -> Coverage:
    """The coverage of pictures of ``size`` (width, height)."""
    side = max(size) / CELLS
    columns, rows = (max(round(length / side), 1) for length in size)
    x, y = (views.pixels[views.found] + 0.5).T
    cells, _, _ = np.histogram2d(y, x, (rows, columns), ((0, size[1]), (0, size[0])))
    points = fit.poses.place(views.board)
    counts = views.found.sum(axis=-1, keepdims=True)
    middle = (points * views.found[..., None]).sum(axis=1) / counts
    facing = np.clip(np.abs(fit.poses.R[:, 2, 2]), 0.0, 1.0)
    return Coverage(cells, np.arccos(facing), np.linalg.norm(middle, axis=-1))


def next_photograph(covered: Coverage) -> str:
    """How to take the next photograph, by what is missing most, in a few words."""
    if (covered.tilt_rad >= TILTED_RAD).sum() < min(ENOUGH_TILTED, len(covered.tilt_rad)):
        return "tilted by 30° to 45°"
    if covered.share < ENOUGH_COVERED:
        part = emptiest(covered)
        return f"{'in' if part == MIDDLE else 'at'} the {part}"
    if len(covered.distance) < ENOUGH_PHOTOGRAPHS:
        return "from another side"
    if covered.distance.max() < 1.3 * covered.distance.min():
        return "nearer or farther"
    return "nothing is missing"


def emptiest(covered: Coverage) -> str:
    """The ninth of the picture with the smallest share of covered cells."""
    filled = covered.cells > 0
    rows, columns = (np.linspace(0, length, 4).round().astype(int) for length in filled.shape)
    shares = {
        name: filled[rows[i] : rows[i + 1], columns[j] : columns[j + 1]].mean()
        for i, names in enumerate(REGIONS)
        for j, name in enumerate(names)
        if rows[i] < rows[i + 1] and columns[j] < columns[j + 1]
    }
    return min(shares, key=lambda name: shares[name])
