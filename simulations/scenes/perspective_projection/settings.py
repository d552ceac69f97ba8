"""The controls of the projection figure."""

from dataclasses import dataclass

from simulations.engine.settings import slider


@dataclass(frozen=True, slots=True)
class Settings:
    """The settings of the figure."""

    depth: float = slider("Depth (Z)", 5.0, -2, 20, 0.1, unit="m")
    focal_length: float = slider("Focal length", 80, 20, 200, 1, unit="px")
    point_x: float = slider("Right (X)", 1.0, -3, 3, 0.05, unit="m")
    point_y: float = slider("Down (Y)", 0.5, -2, 2, 0.05, unit="m")
    perspective: float = slider("Perspective", 100, 0, 100, 1, unit="%")
