"""The controls of the second-bounce figure."""

from dataclasses import dataclass

from simulations.engine.settings import choice, slider

WALLS = {"red": "Red", "white": "White, as the floor"}
BOUNCES = {
    "0": "None: the lamp alone",
    "1": "One",
    "2": "Two",
    "4": "Four",
    "all": "All",
}


@dataclass(frozen=True, slots=True)
class Settings:
    """The settings of the figure."""

    bounces: str = choice("Bounces", BOUNCES, "all")
    light_angle: float = slider("Lamp above the floor", 55, 10, 170, 1, unit="°")
    opening: float = slider("Opening angle φ", 90, 40, 150, 1, unit="°")
    albedo: float = slider("Albedo ρ", 0.8, 0, 0.95, 0.01)
    wall: str = choice("Wall", WALLS)
    place: float = slider("Point on the floor", 0.15, 0.01, 0.99, 0.01)
