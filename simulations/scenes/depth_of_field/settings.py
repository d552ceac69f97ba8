"""The controls of the depth-of-field figure."""

from dataclasses import dataclass

from simulations.engine.settings import action, slider


@dataclass(frozen=True, slots=True)
class Settings:
    """The settings of the figure."""

    focal_length: float = slider("Focal length", 50, 24, 135, 1, unit="mm")
    aperture: float = slider("Aperture", 1.4, 1.4, 22, 0.1, prefix="f/")
    focus: float = slider("Focus distance", 3.2, 0.05, 10, 0.05, unit="m")
    rack: int = action("Sweep the focus", "Pause", drives="focus", effect="play", seconds=10.0)


def has_image(settings: Settings) -> bool:
    """Whether the light of the distance in focus meets behind the lens."""
    return 1000 * settings.focus > settings.focal_length
