"""The controls of the slanted edge."""

from dataclasses import dataclass

from simulations.engine.settings import choice, points, slider

MOST_KEPT = 8
"""Most places that are kept."""


@dataclass(frozen=True, slots=True)
class Settings:
    """The settings of the figure. Slant, aperture, noise and sharpening are those of the simulated
    picture; the rectangle is in shares of the panel's width."""

    angle: float = slider("Slant of the edge", 5, 0, 40, 0.5, unit="°")
    aperture: float = slider("Aperture", 8, 2.8, 22, 0.1, prefix="f/")
    pitch: float = slider("Pixel pitch p", 4, 0.5, 10, 0.1, unit="µm")
    noise: float = slider("Noise", 1, 0.3, 3, 0.1, unit="% of the step")
    sharpening: float = slider("Sharpening", 0, 0, 1.5, 0.1)
    response: str = choice(
        "Codes of the file", {"srgb": "sRGB", "linear": "Proportional to the light"}
    )
    x: float = slider("Rectangle, from the left", 50, 0, 100, 0.5, unit="%")
    y: float = slider("Rectangle, from the top", 37.5, 0, 75, 0.5, unit="%")
    width: float = slider("Rectangle, width", 40, 1, 60, 0.5, unit="%")
    height: float = slider("Rectangle, height", 30, 1, 60, 0.5, unit="%")
    kept: str = points(
        "Places kept",
        1,
        2 * MOST_KEPT,
        buttons={"keep": "Keep this place", "forget": "Forget all"},
    )
