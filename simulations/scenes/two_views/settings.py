"""The controls of the two views."""

from dataclasses import dataclass

from simulations.engine.settings import slider, toggle


@dataclass(frozen=True, slots=True)
class Settings:
    """The settings of the figure."""

    depth: float = slider("Depth (Z)", 8.0, 1.5, 20.0, 0.1, unit="m")
    baseline: float = slider("Baseline", 0.5, 0.1, 1.0, 0.05, unit="m")
    toe_in: float = slider("Toe-in (right)", 0.0, 0.0, 30.0, 1.0, unit="°")
    matching_error: float = slider("Error of the match", 1.0, 0.0, 4.0, 0.1, unit="px")
    focal_length: float = slider("Focal length", 160.0, 80.0, 320.0, 5.0, unit="px")
    left_x: float = slider("Left picture, right", 30.0, -95.0, 95.0, 1.0, unit="px")
    left_up: float = slider("Left picture, up", 40.0, 0.0, 70.0, 1.0, unit="px")
    line: bool = toggle("Epipolar line", default=True)
