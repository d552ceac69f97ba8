"""The controls of the spectrum figure."""

from dataclasses import dataclass

from simulations.engine.settings import choice, slider, toggle

LIGHTS = {
    "planck": "Glowing body",
    "daylight": "Daylight",
    "fluorescent": "Fluorescent tube",
    "diode": "White LED",
}
SURFACES = {
    "cloth": "Dyed cloth (band and width)",
    "dark-skin": "Dark skin",
    "light-skin": "Light skin",
    "sky": "Blue sky",
    "foliage": "Foliage",
    "orange": "Orange",
    "purple": "Purple",
    "blue": "Blue",
    "green": "Green",
    "red": "Red",
    "yellow": "Yellow",
    "white": "White",
}
SENSORS = {"camera": "A camera's", "eye": "The eye's, x̄ ȳ z̄"}
MATRICES = {"daylight": "Made for daylight", "own": "Made for this light"}


@dataclass(frozen=True, slots=True)
class Settings:
    """The settings of the figure."""

    light: str = choice("Light", LIGHTS)
    temperature: float = slider("Colour temperature", 2850, 2000, 12000, 50, unit="K")
    surface: str = choice("Surface", SURFACES)
    band: float = slider("Cloth: band at", 605, 420, 660, 5, unit="nm")
    width: float = slider("Cloth: width σ", 45, 10, 100, 5, unit="nm")
    twin: bool = toggle("Show the metameric twins")
    sensor: str = choice("Sensor's curves", SENSORS)
    matrix: str = choice("Colour matrix", MATRICES)
