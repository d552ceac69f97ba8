"""The controls of the Bayer figure."""

from dataclasses import dataclass

from simulations.engine.settings import action, choice, slider
from simulations.pictures.balloon import HEIGHT as PICTURE_HEIGHT
from simulations.pictures.balloon import WIDTH as PICTURE_WIDTH
from simulations.pictures.mosaic_subjects import SUBJECTS

ROWS, COLUMNS = 16, 20
"""Pixels under the loupe."""
QUAD = 2
"""The loupe moves by whole quads, so that its mosaic starts with the same colour."""

METHOD_LABELS = {
    "nearest": "Nearest",
    "bilinear": "Bilinear",
    "malvar": "Malvar–He–Cutler 2004",
    "menon-unrefined": "Menon 2007, unrefined",
    "menon": "Menon 2007",
    "menon-encoded": "Menon, unrefined, on encoded values",
}


@dataclass(frozen=True, slots=True)
class Settings:
    """The settings of the figure."""

    demosaic: int = action("Demosaic", drives="split", effect="play", seconds=4.0)
    method: str = choice("Method", METHOD_LABELS, "menon-unrefined")
    picture: str = choice("Picture", {name: each.label for name, each in SUBJECTS.items()})
    split: float = slider("Demosaiced part", 0.5, 0, 1, 0.01, unit="of the picture")
    column: int = slider("Loupe, column", 104, 0, PICTURE_WIDTH - COLUMNS, QUAD, unit="px")
    row: int = slider("Loupe, row", 56, 0, PICTURE_HEIGHT - ROWS, QUAD, unit="px")
