"""The controls of the pinhole."""

from dataclasses import dataclass

from simulations.engine.settings import slider, toggle

NARROWEST_MM, WIDEST_MM = 0.1, 2.0


@dataclass(frozen=True, slots=True)
class Settings:
    """The settings of the figure."""

    hole: float = slider("Hole width", 1.0, NARROWEST_MM, WIDEST_MM, 0.01, unit="mm")
    longer: bool = toggle("Expose longer")
