"""The controls of the pose figure."""

from dataclasses import dataclass

from simulations.engine.settings import slider


@dataclass(frozen=True, slots=True)
class Settings:
    """The settings of the figure."""

    pan: float = slider("Pan ψ", -90, -180, 180, 1, unit="°")
    camera_x: float = slider("Camera, right (X)", 10.0, 0, 12, 0.1, unit="m")
    camera_z: float = slider("Camera, ahead (Z)", 2.0, -2, 6, 0.1, unit="m")
