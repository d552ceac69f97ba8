"""The controls of the tiled floor."""

from dataclasses import dataclass

from simulations.engine.settings import slider, toggle


@dataclass(frozen=True, slots=True)
class Settings:
    """The settings of the figure."""

    pitch: float = slider("Look down (pitch)", 12.0, -20.0, 60.0, 1.0, unit="°")
    yaw: float = slider("Turn right (yaw)", 30.0, -60.0, 60.0, 1.0, unit="°")
    height: float = slider("Camera height", 1.6, 0.4, 4.0, 0.1, unit="m")
    focal_length: float = slider("Focal length", 320.0, 150.0, 800.0, 10.0, unit="px")
    box_height: float = slider("Box height", 1.0, 0.2, 3.0, 0.1, unit="m")
    box_x: float = slider("Box offset", 2.2, -6.0, 8.0, 0.1, unit="m")
    box_y: float = slider("Box distance", 4.2, 2.0, 12.0, 0.1, unit="m")
    roll: float = slider("Lean right (roll)", 0.0, -30.0, 30.0, 1.0, unit="°")
    principal_x: float = slider("Principal point, right", 0.0, -150.0, 150.0, 1.0, unit="px")
    principal_y: float = slider("Principal point, down", 0.0, -150.0, 150.0, 1.0, unit="px")
    lines: bool = toggle("Lines to the vanishing points", default=True)
