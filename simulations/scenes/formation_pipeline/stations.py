"""One point's numbers: the scene, and the seven links of the chain to the pixel value."""

import math
from dataclasses import dataclass

import numpy as np

from simulations.engine.frame import format_number
from simulations.models.arrays import Floats
from simulations.models.color.srgb import encode_srgb
from simulations.models.distortion.lens_model import Distortion, distort
from simulations.models.light.reflectance import lambert
from simulations.models.projection import pinhole
from simulations.models.sensor import photon_counting
from simulations.world.surfaces import WALL

POINT_M = (0.4, -0.3, 3.0)
"""The point in the world, whose axes are right, down and ahead. It is fixed, like wall and lamp."""
FOCAL_PX, CENTRE_PX = 800.0, (320.0, 240.0)
LENS = Distortion(k1=-0.2)
LAMP_ANGLE_RAD = math.radians(60.0)  # from the wall's normal
LAMP_COS = math.cos(LAMP_ANGLE_RAD)
WHITE_E = 10_000.0  # electrons from a white wall that faces the lamp: a full well
SPECK_RADIUS_M, WALL_ALBEDO = 0.02, float(WALL[1])
"""The disc of paint around the point, and the paint of the wall around it."""
CELLS = 9  # cells of the sensor along each side of the patch that is shown
FIRST_EXPOSURE = 16
"""Seed of the noise, chosen so that the ledger's numbers, rounded to two digits, give the printed
code at every albedo."""
PIXEL = photon_counting.Sensor(
    full_well_e=WHITE_E,
    read_noise_e=5.0,
    dark_current_e_per_s=0.0,
    gain_e_per_dn=WHITE_E / 4095.0,
    bits=12,
    black_level_dn=0.0,
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Journey:
    """All numbers of the point, in the order of the chain."""

    world_m: tuple[float, ...]
    camera_m: tuple[float, ...]
    ideal: tuple[float, ...]  # x, y of its pinhole image, in units of the focal length
    distorted: tuple[float, ...]  # the same, through the lens
    pixel: tuple[float, ...]  # column and row, in pixels
    relative_light: float  # light, relative to a white wall that faces the lamp
    mean_e: float  # expected electrons
    counted_e: float  # electrons in this exposure
    read_e: float  # read noise, in electrons
    raw_dn: int  # 12-bit code for the sum of both
    code: int  # 8-bit sRGB


@dataclass(frozen=True, slots=True)
class Station:
    """One entry of the ledger."""

    title: str
    numbers: str  # the result of this link, with units
    sentence: str  # description of this link, for a reader who cannot see the drawing
    role: str


def travel(distance_m: float, albedo: float, exposure: int) -> Journey:
    """Compute the numbers for a camera ``distance_m`` in front of the wall; ``exposure`` counts
    from 0."""
    world = np.array(POINT_M)
    pose = pinhole.rigid_pose(np.eye(3), np.array([0.0, 0.0, distance_m - POINT_M[2]]))
    camera = pinhole.world_to_camera(world, pose)
    ideal, _ = pinhole.project(camera, np.eye(3))
    distorted = distort(ideal, LENS)
    K = pinhole.intrinsics(FOCAL_PX, CENTRE_PX)
    pixel, _ = pinhole.project(np.append(distorted, 1.0), K)
    lamp = (math.sin(LAMP_ANGLE_RAD), 0.0, -math.cos(LAMP_ANGLE_RAD))
    light = float(lambert(np.array([0.0, 0.0, -1.0]), np.array(lamp), albedo))
    mean_e = light * WHITE_E
    rng = np.random.default_rng(FIRST_EXPOSURE + exposure)
    counted = photon_counting.shot_noise(np.array([mean_e]), rng, WHITE_E)
    signal_dn = photon_counting.read_out(counted, PIXEL, rng)
    raw = photon_counting.quantise(signal_dn, PIXEL.bits)
    encoded = encode_srgb(photon_counting.develop(raw, PIXEL))
    return Journey(
        world_m=POINT_M,
        camera_m=tuple(camera.tolist()),
        ideal=tuple(ideal.tolist()),
        distorted=tuple(distorted.tolist()),
        pixel=tuple(pixel.tolist()),
        relative_light=light,
        mean_e=mean_e,
        counted_e=float(counted[0]),
        read_e=float(signal_dn[0] * PIXEL.gain_e_per_dn - counted[0]),
        raw_dn=int(raw[0]),
        code=round(255.0 * float(np.clip(encoded[0], 0.0, 1.0))),
    )


def light_around(journey: Journey) -> Floats:
    """Light (CELLS, CELLS) in the cells around the point's own, relative to a white wall that faces
    the lamp: the disc of paint on its wall, averaged over each cell."""
    offsets = np.arange(CELLS) - CELLS // 2
    columns, rows = (round(place) + offsets - place for place in journey.pixel)
    away = np.hypot(columns[None, :], rows[:, None])
    radius = FOCAL_PX * SPECK_RADIUS_M / journey.camera_m[2]
    covered = np.clip(radius - away + 0.5, 0.0, 1.0)
    wall = WALL_ALBEDO * LAMP_COS
    return np.asarray(wall + covered * (journey.relative_light - wall))


def stations(journey: Journey) -> tuple[Station, ...]:
    """The ledger, in the chapter's order and with its names: the scene, the geometry from there to
    a cell of the sensor, then light and electronics from the paint to the number in the file."""
    column, row = journey.pixel
    light = format_number(journey.relative_light, 3)
    sign = "−" if journey.read_e < 0 else "+"
    electrons = f"({journey.counted_e:.0f} {sign} {abs(journey.read_e):.2f}) e⁻"
    return (
        Station(
            "Scene",
            f"{in_brackets(journey.world_m, 2)} m in the room",
            "The point waits in the scene, in world coordinates",
            "world",
        ),
        Station(
            "Pose",
            f"{in_brackets(journey.camera_m, 2)} m from the camera",
            "The camera’s pose turns world coordinates into camera coordinates",
            "camera",
        ),
        Station(
            "Projection",
            f"divided by depth: {in_brackets(journey.ideal, 5)}",
            "Division by the depth leaves two numbers",
            "camera",
        ),
        Station(
            "Lens",
            f"times 1 − 0.2 r²: {in_brackets(journey.distorted, 5)}",
            "The lens bends the ray, and moves the point of the image",
            "ray",
        ),
        Station(
            "Pixel grid",
            f"{in_brackets(journey.pixel, 2)} px, in cell ({round(column)}, {round(row)})",
            "Focal length and centre in pixels turn them into a place on the grid of cells",
            "image",
        ),
        Station(
            "Light",
            f"ρ cos 60° = {light} of white: {journey.mean_e:.0f} e⁻ expected",
            "Lamp and paint decide how many electrons are to be expected",
            "light",
        ),
        Station(
            "Sensor",
            f"{electrons} · 4095 / 10 000 e⁻ = code {journey.raw_dn}",
            "Chance decides how many come, reading adds an error of its own, and the converter "
            "rounds the sum to a code",
            "error",
        ),
        Station(
            "File",
            f"255 · sRGB({journey.raw_dn} / 4095) = {journey.code}",
            "The sRGB curve and 8 bits give the pixel value in the file",
            "image",
        ),
    )


def in_brackets(values: tuple[float, ...], digits: int) -> str:
    return f"({', '.join(format_number(value, digits) for value in values)})"
