"""The controls of the stability figure."""

from dataclasses import dataclass

from simulations.engine.settings import choice, slider

FORMULAS = {
    "angle": "Angle between two orientations",
    "blur": "Blur beside the focus",
    "origin": "Pixel, far from the origin",
    "fold": "Ideal radius, near the fold",
}
FORMATS = {"float64": "float64: 16 digits", "float32": "float32: 7 digits"}
LOWEST, STEP = -15.0, 0.25
"""Power of ten of the smallest distance from the singularity, and the step of distances."""


@dataclass(frozen=True, slots=True)
class Settings:
    """The settings of the figure."""

    formula: str = choice("Formula", FORMULAS)
    digits: str = choice("Numbers", FORMATS)
    power: float = slider("Distance, log₁₀", -4.0, LOWEST, 0.0, STEP)
