"""The controls of the lens-distortion figure."""

from dataclasses import dataclass

from simulations.engine.settings import choice, slider, toggle


@dataclass(frozen=True, slots=True)
class Settings:
    """The settings of the figure."""

    k1: float = slider("k₁", 0.0, -0.5, 0.5, 0.01)
    k2: float = slider("k₂", 0.0, -0.3, 0.3, 0.01)
    picture: str = choice("Picture", {"room": "Room", "chart": "Test chart"})
    correct: bool = toggle("Correct the picture")
