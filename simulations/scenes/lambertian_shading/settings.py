"""The controls of the Lambertian figure."""

from dataclasses import dataclass

from simulations.engine.settings import action, slider, toggle


@dataclass(frozen=True, slots=True)
class Settings:
    """The settings of the figure."""

    light_angle: float = slider("Light angle", 30, -180, 180, 1, unit="°")
    albedo: float = slider("Albedo ρ", 0.8, 0, 1, 0.01)
    probe: float = slider("Probed point", 0, -90, 90, 1, unit="°")
    normals: bool = toggle("Show normals")
    play: int = action("Orbit the light", "Stop", drives="light_angle", effect="play", seconds=12)
