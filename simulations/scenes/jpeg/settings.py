"""The controls of the JPEG figure."""

from dataclasses import dataclass

from simulations.engine.settings import choice, slider
from simulations.models.compression.blocks import BLOCK
from simulations.pictures.balloon import HEIGHT as ROWS_PX
from simulations.pictures.balloon import WIDTH as COLUMNS_PX

BLOCK_COLUMNS, BLOCK_ROWS = COLUMNS_PX // BLOCK, ROWS_PX // BLOCK
ALL = BLOCK * BLOCK

SUBSAMPLING_LABELS = {
    "4:2:0": "4:2:0, once in 2 × 2 pixels",
    "4:2:2": "4:2:2, in every second column",
    "4:4:4": "4:4:4, in every pixel",
}
UPSAMPLING_LABELS = {
    "repeated": "Repetition",
    "triangle": "Triangle",
    "parabola": "Parabola",
    "cubic": "Cubic",
    "guided": "Following luma",
}


@dataclass(frozen=True, slots=True)
class Settings:
    """The settings of the figure."""

    quality: int = slider("Quality", 30, 1, 100, 1)
    subsampling: str = choice("Chroma subsampling", SUBSAMPLING_LABELS)
    upsampling: str = choice("Chroma upsampling", UPSAMPLING_LABELS, "triangle")
    column: int = slider("Block, column", 25, 1, BLOCK_COLUMNS, 1)
    row: int = slider("Block, row", 8, 1, BLOCK_ROWS, 1)
    original: float = slider("Original shown", 0.5, 0, 1, 0.01, unit="of the picture")
    first: int = slider("Coefficients used", ALL, 1, ALL, 1, unit="of each block")
