"""The controls of the resolution figure."""

from dataclasses import dataclass

from simulations.engine.settings import slider, toggle


@dataclass(frozen=True, slots=True)
class Settings:
    """The settings of the figure."""

    aperture: float = slider("Aperture", 8, 1.4, 22, 0.1, prefix="f/")
    pitch: float = slider("Pixel pitch p", 4, 1, 10, 0.1, unit="µm")
    frequency: float = slider("Frequency f", 75, 10, 500, 5, unit="/mm")
    defocus: float = slider("Defocus", 0, 0, 70, 1, unit="µm")
    plate: bool = toggle("Low-pass plate")
    wavelength: float = slider("Wavelength λ", 550, 400, 700, 10, unit="nm")
