"""The controls of the figure of a real lens."""

from dataclasses import dataclass

from simulations.engine.settings import slider


@dataclass(frozen=True, slots=True)
class Settings:
    """The settings of the figure."""

    height: float = slider("Height h of the ray", 10, 0.5, 20, 0.5, unit="mm")
    front: float = slider("Front bulge 1/R₁", 25, -20, 40, 1, unit="/m")
    back: float = slider("Back bulge 1/R₂", 25, -20, 40, 1, unit="/m")
    index: float = slider("Index n", 1.5, 1.3, 2, 0.01)
    thickness: float = slider("Thickness d", 10, 2, 20, 0.5, unit="mm")
    opening: float = slider("Half opening", 14, 2, 20, 0.5, unit="mm")
    vergence: float = slider("Object at 1/Z", 0, 0, 22, 0.5, unit="/m")
