"""One point's numbers at the seven stations from the scene to the pixel value."""

import math
from dataclasses import dataclass

import numpy as np

from simulations.engine.frame import format_number
from simulations.models import projection, sensor
from simulations.models.color import encode_srgb
from simulations.models.distortion import Distortion, distort
from simulations.models.reflectance import lambert

POINT_RIGHT_M, POINT_DOWN_M = 0.4, -0.3
"""Of the point, in the world; world axes are right, down, ahead."""
CAMERA_AHEAD_M = -1.0
"""The camera stands this far behind the world's origin and looks straight ahead."""
FOCAL_PX, CENTRE_PX = 800.0, (320.0, 240.0)
LENS = Distortion(k1=-0.2)
LAMP_ANGLE_RAD = math.radians(60.0)
"""Of the lamp from the wall's normal."""
WHITE_E = 10_000.0
"""Electrons from a white wall that faces the lamp: a full well."""
PIXEL = sensor.Sensor(
    full_well_e=WHITE_E,
    read_noise_e=5.0,
    dark_current_e_per_s=0.0,
    gain_e_per_dn=WHITE_E / 4095.0,
    bits=12,
    black_level_dn=0.0,
)


@dataclass(frozen=True, slots=True)
class Journey:
    """Everything known about the point, in the order in which it becomes known."""

    world_m: tuple[float, float, float]
    camera_m: tuple[float, float, float]
    ideal: tuple[float, float]
    """x, y where a pinhole would image it, in units of the focal length."""
    distorted: tuple[float, float]
    """The same, through the lens."""
    pixel: tuple[float, float]
    """Column and row, in pixels."""
    relative_light: float
    """Of a white wall that faces the lamp."""
    mean_e: float
    """Electrons to be expected."""
    counted_e: float
    """Electrons that came this time."""
    raw_dn: int
    """12-bit code of the converter, read noise included."""
    code: int
    """8-bit sRGB."""


def travel(distance_m: float, albedo: float, seed: int) -> Journey:
    """Follow a point ``distance_m`` in front of the camera; ``seed`` picks one exposure."""
    world = np.array([POINT_RIGHT_M, POINT_DOWN_M, CAMERA_AHEAD_M + distance_m])
    pose = projection.rigid_pose(np.eye(3), np.array([0.0, 0.0, -CAMERA_AHEAD_M]))
    camera = projection.world_to_camera(world, pose)
    ideal, _ = projection.project(camera, np.eye(3))
    distorted = distort(ideal, LENS)
    K = projection.intrinsics(FOCAL_PX, CENTRE_PX)
    pixel, _ = projection.project(np.append(distorted, 1.0), K)
    lamp = (math.sin(LAMP_ANGLE_RAD), 0.0, -math.cos(LAMP_ANGLE_RAD))
    light = float(lambert(np.array([0.0, 0.0, -1.0]), np.array(lamp), albedo))
    mean_e = light * WHITE_E
    rng = np.random.default_rng(seed)
    counted = sensor.shot_noise(np.array([mean_e]), rng, WHITE_E, model="skewed")
    raw = sensor.quantise(sensor.read_out(counted, PIXEL, rng), PIXEL.bits)
    encoded = encode_srgb(sensor.develop(raw, PIXEL))
    return Journey(
        world_m=_triple(world),
        camera_m=_triple(camera),
        ideal=_pair(ideal),
        distorted=_pair(distorted),
        pixel=_pair(pixel),
        relative_light=light,
        mean_e=mean_e,
        counted_e=float(counted[0]),
        raw_dn=int(raw[0]),
        code=round(255.0 * float(np.clip(encoded[0], 0.0, 1.0))),
    )


def _pair(values: np.ndarray) -> tuple[float, float]:
    return float(values[0]), float(values[1])


def _triple(values: np.ndarray) -> tuple[float, float, float]:
    return float(values[0]), float(values[1]), float(values[2])


@dataclass(frozen=True, slots=True)
class Station:
    """One entry of the ledger."""

    title: str
    numbers: str
    """What is known here, with units."""
    sentence: str
    """What happened on the way here, for a reader who cannot see the drawing."""
    role: str


def stations(journey: Journey) -> tuple[Station, ...]:
    """The ledger: seven stations, in the order of the light."""
    column, row = journey.pixel
    percent = f"{format_number(100 * journey.relative_light, 1)}\u00a0%"
    counted = f"{journey.counted_e:.0f}"
    return (
        Station(
            "Scene",
            f"X = {_numbers(journey.world_m, 2)} m",
            "The point waits in the scene, in world coordinates",
            "world",
        ),
        Station(
            "Pose",
            f"R X + t = {_numbers(journey.camera_m, 2)} m",
            "The camera’s pose turns world coordinates into camera coordinates",
            "camera",
        ),
        Station(
            "Lens",
            f"{_numbers(journey.ideal, 5)} bent to {_numbers(journey.distorted, 5)}",
            "Division by depth leaves two numbers, and the lens bends them",
            "ray",
        ),
        Station(
            "Image plane",
            f"{_numbers(journey.pixel, 2)} px, in cell ({round(column)}, {round(row)})",
            "The intrinsic matrix turns them into pixel coordinates",
            "image",
        ),
        Station(
            "Light",
            f"ρ cos 60° = {percent} of white: {journey.mean_e:.0f} e⁻ due",
            "Lamp and paint decide how many electrons are to be expected",
            "light",
        ),
        Station(
            "Sensor",
            f"{counted} e⁻ counted, read as {journey.raw_dn} DN",
            "Chance decides how many come, and the converter rounds them to a code",
            "error",
        ),
        Station(
            "Pixel value",
            f"sRGB({journey.raw_dn} / 4095) = {journey.code} of 255",
            "The sRGB curve gives the number in the file",
            "image",
        ),
    )


def _numbers(values: tuple[float, ...], digits: int) -> str:
    return f"({', '.join(format_number(value, digits) for value in values)})"
