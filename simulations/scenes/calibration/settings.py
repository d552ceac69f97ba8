"""The controls of the calibration."""

from dataclasses import dataclass

from simulations.engine.settings import choice, slider

LENSES = {
    "none": "No distortion",
    "k1": "k₁",
    "k1k2": "k₁ and k₂",
    "p1p2": "k₁, k₂, p₁, p₂",
    "k3": "k₁, k₂, p₁, p₂, k₃",
}
"""The models of the lens by their names in `models.calibration.camera.LENSES`."""
ERRORS = {"shown": "Of the photograph shown", "all": "Of all photographs used"}
"""Whose errors are drawn."""
LEAST, MOST = 3, 20
"""Photographs of a calibration."""


@dataclass(frozen=True, slots=True)
class Settings:
    """The settings of the figure."""

    photographs: int = slider("Photographs", 5, LEAST, MOST, 1)
    lens: str = choice("Model of the lens", LENSES, default="k1")
    shown: int = slider("Photograph shown", 3, 1, MOST, 1)
    arrows: str = choice("Arrows", ERRORS)
    share: float = slider("Dividing line", 1, 0, 1, 0.01)
