"""The controls of the lens-aberrations figure."""

from dataclasses import dataclass

from simulations.engine.settings import choice, slider, toggle


@dataclass(frozen=True, slots=True)
class Settings:
    """The settings of the figure."""

    glass: str = choice(
        "Glass",
        {"ideal": "Without dispersion", "crown": "Crown, V = 64.2", "flint": "Flint, V = 36.4"},
        "crown",
    )
    stop: float = slider("Stop-to-lens distance", 12, -15, 15, 1, unit="mm")
    aperture: float = slider("Aperture", 2.8, 1.4, 16, 0.1, prefix="f/")
    rim: float = slider("Rim-to-stop distance", 6, 0, 12, 0.5, unit="mm")
    natural: bool = toggle("Natural vignetting, cos⁴", True)
