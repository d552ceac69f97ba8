"""The settings of the calibration, and the names of what they choose from."""

from dataclasses import dataclass

from simulations.engine.settings import choice, slider
from simulations.scenes.calibration.boards import LEAST, MOST
from simulations.scenes.calibration.stages import SHEET, SUPPORTED

LENSES = {
    "none": "No distortion",
    "k1": "One radial term, k₁",
    "k1k2": "Two radial terms, k₁ and k₂",
    "p1p2": "Two radial and two tangential terms",
    "k3": "Three radial and two tangential terms",
    "rational": "Six radial and two tangential terms",
    "fisheye": "Fisheye, four terms of the angle",
}
"""The models of the lens by their names in `models.calibration.camera.LENSES`."""
BOARDS = {"flat": "flat", "bent": "bent alike everywhere", "warped": "any smooth shape"}
"""The shapes of the board by their names in `models.calibration.board_shape.SHAPES`."""
ERRORS = {"shown": "Of the photograph shown", "all": "Of all photographs used"}
"""The photographs whose errors are drawn."""
DETAILS = {
    "models": "Error by the model of the lens",
    SHEET: "Error of each photograph",
    "board": "Shape of the board",
}
"""What the last panel shows."""


@dataclass(frozen=True, slots=True)
class Settings:
    photographs: int = slider("Photographs", 5, LEAST, MOST, 1)
    lens: str = choice("Model of the lens", LENSES | {SUPPORTED: "The supported one"}, default="k1")
    shown: int = slider("Photograph shown", 3, 1, MOST, 1)
    detail: str = choice("Details", DETAILS)
    without: int = slider("Photograph left out (0: none)", 0, 0, MOST, 1)
    arrows: str = choice("Arrows", ERRORS)
    share: float = slider("Dividing line", 1, 0, 1, 0.01)
    shape: str = choice("Board", BOARDS | {SUPPORTED: "the supported shape"}, default="flat")
    side: float = slider("Width of a square (0: not given)", 0, 0, 100, 0.1, unit="mm")
