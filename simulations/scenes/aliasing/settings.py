"""The controls of the aliasing figure."""

from dataclasses import dataclass

from simulations.engine.settings import action, choice, slider

PATTERNS = {"stripes": "Stripes", "zone_plate": "Zone plate"}
FILTERS = {
    "none": "None: a point of each pixel",
    "box": "Box: the pixel's whole area",
    "box-2": "Box, by 2 × 2 points",
    "box-4": "Box, by 4 × 4 points",
    "box-8": "Box, by 8 × 8 points",
    "gaussian": "Gaussian, σ = 0.5 px",
    "sinc": "Windowed sinc, 8 px wide",
}


@dataclass(frozen=True, slots=True)
class Settings:
    """The settings of the figure."""

    pattern: str = choice("Pattern", PATTERNS)
    frequency: float = slider("Frequency f", 0.3, 0, 1.2, 0.01, unit="cycles/px")
    phase: float = slider("Phase φ", 90, 0, 360, 5, unit="°")
    prefilter: str = choice("Filter before sampling", FILTERS)
    rate: float = slider("Sampling rate", 1, 0.5, 2, 0.05, unit="samples/px")
    sweep: int = action(
        "Sweep the frequency", "Pause", drives="frequency", effect="play", seconds=16.0
    )
