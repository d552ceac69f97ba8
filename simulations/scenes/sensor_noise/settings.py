"""The controls of the sensor-noise figure."""

from dataclasses import dataclass

from simulations.engine.settings import action, choice, slider


@dataclass(frozen=True, slots=True)
class Settings:
    """The settings of the figure."""

    exposure: float = slider("Exposure", 0, -6, 0, 0.5, unit="EV")
    iso: str = choice("ISO", {str(iso): str(iso) for iso in (100, 200, 400, 800, 1600, 3200, 6400)})
    read_noise: float = slider("Read noise", 10, 0, 60, 1, unit="e⁻")
    dark: float = slider("Dark signal", 0, 0, 2000, 20, unit="e⁻")
    unequal: float = slider("Unequal cells (PRNU)", 0, 0, 5, 0.5, unit="%")
    bits: int = slider("Bit depth", 12, 4, 14, 1, unit="bits")
    patch: int = slider("Patch", 9, 1, 24, 1)
    new_noise: int = action(*("Take another photo",) * 8)
