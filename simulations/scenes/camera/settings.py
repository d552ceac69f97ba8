"""The controls of the camera simulator."""

from dataclasses import dataclass

from simulations.engine.settings import action, slider, toggle

STRONGEST_BARREL = -0.4
"""The lowest k₁ of the slider."""


@dataclass(frozen=True, slots=True)
class Settings:
    """The settings of the figure."""

    focal_length: float = slider("Focal length", 50.0, 24.0, 135.0, 1.0, unit="mm")
    aperture: float = slider("Aperture", 5.6, 1.4, 22.0, 0.1, prefix="f/")
    focus: float = slider("Focus distance", 3.2, 1.0, 10.0, 0.1, unit="m")
    dolly: int = action("Dolly zoom", "Pause", drives="back", effect="play", seconds=10.0)
    back: float = slider("Dolly zoom distance", 0.0, 0.0, 4.0, 0.1, unit="m")
    light_angle: float = slider("Light angle", 40.0, -80.0, 80.0, 1.0, unit="°")
    exposure: float = slider("Exposure", 0.0, -3.0, 3.0, 0.1, unit="EV")
    k1: float = slider("Distortion k₁", 0.0, STRONGEST_BARREL, 0.4, 0.01)
    noise_sigma: float = slider("Read noise σ", 5.0, 0.0, 40.0, 1.0, unit="codes")
    shot_noise: bool = toggle("Photon shot noise", default=True)
    new_noise: int = action(*("Take another photo",) * 8)
