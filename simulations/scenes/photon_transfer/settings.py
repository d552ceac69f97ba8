"""The controls of the photon-transfer figure."""

from dataclasses import dataclass

from simulations.engine.settings import slider


@dataclass(frozen=True, slots=True)
class Settings:
    """The settings of the figure. Pairs and read noise are those of the simulated sensor."""

    most: int = slider("Fit up to", 70, 5, 100, 1, unit="% of the scale")
    pairs: int = slider("Pairs of frames", 12, 4, 24, 1)
    read_noise: float = slider("Read noise", 10, 0, 40, 1, unit="e⁻")
