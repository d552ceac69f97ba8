"""The accuracy that the book promises of its models, clause by clause.

Forward models are within 1e-12 of an independent oracle, relative to the largest value; rotations
and colours round-trip through any conversion to 1e-14; shot noise passes a 1 % Kolmogorov–Smirnov
test from 0.1 electrons to a full well; geometry is as precise far from the origin as near it.
"""

import math
import warnings

import cv2
import numpy as np
import pytest
from scipy import stats
from scipy.spatial.transform import Rotation

from simulations.models.arrays import Floats
from simulations.models.color import cie, srgb, ycbcr
from simulations.models.geometry import quaternions, rotations, transforms
from simulations.models.light import reflectance
from simulations.models.projection import pinhole
from simulations.models.sensor import photon_counting

with warnings.catch_warnings():
    warnings.simplefilter("ignore")  # they miss packages for plotting
    import colour


RNG = np.random.default_rng(11)
POSE = pinhole.look_at([3.0, -1.0, -6.0], [0.2, 0.1, 0.3], [0.0, -1.0, 0.1])
POINTS = RNG.uniform(-2.0, 2.0, (500, 3))
NEAR_HALF_A_TURN = math.pi - np.geomspace(1e-12, 1.0, 25)
ANGLES = np.concatenate([np.geomspace(1e-12, 3.0, 50), NEAR_HALF_A_TURN])
AXES = Rotation.random(75, rng=np.random.default_rng(12)).apply([1.0, 0.0, 0.0])

VECTORS = ANGLES[:, None] * AXES
"""Axis times angle, from almost no turn to almost half a turn."""


def relative_error(ours: Floats, theirs: Floats) -> float:
    return np.abs(ours - theirs).max() / np.abs(theirs).max()


def by_opencv(
    points: Floats, pose: Floats, K: Floats, coefficients: Floats | None = None
) -> Floats:
    rotation = cv2.Rodrigues(pose[:3, :3])[0]
    return cv2.projectPoints(points, rotation, pose[:3, 3], K, coefficients)[0][:, 0]


def test_projection_agrees_with_opencv() -> None:
    K = pinhole.intrinsics((800.0, 815.0), (320.0, 240.0))
    ours, valid = pinhole.project(pinhole.world_to_camera(POINTS, POSE), K)
    assert valid.all()
    assert relative_error(ours, by_opencv(POINTS, POSE, K)) < 1e-12


def test_homographies_agree_with_opencv() -> None:
    H = np.array([[1.1, 0.2, 5.0], [-0.1, 0.9, -3.0], [1e-3, 5e-4, 1.0]])
    points = RNG.uniform(-100.0, 100.0, (500, 2))
    theirs = cv2.perspectiveTransform(points[:, None], H)[:, 0]
    assert relative_error(transforms.apply_homography(H, points)[0], theirs) < 1e-12


def test_rotations_agree_with_scipy() -> None:
    theirs = Rotation.from_rotvec(VECTORS)
    assert relative_error(rotations.exponential(VECTORS), theirs.as_matrix()) < 1e-12
    q = quaternions.from_rotation_vector(VECTORS)
    assert relative_error(q, theirs.as_quat(canonical=True, scalar_first=True)) < 1e-12
    turned = quaternions.rotate(q, POINTS[:75])
    assert relative_error(turned, theirs.apply(POINTS[:75])) < 1e-12


def test_reflected_light_agrees_with_trigonometry() -> None:
    """Light at an angle to the normal, seen along the normal."""
    angle = np.linspace(0.0, 1.5, 200)
    light = np.stack([np.sin(angle), np.zeros(200), np.cos(angle)], axis=-1)
    normal = np.broadcast_to([0.0, 0.0, 1.0], (200, 3))
    eye = [0.0, 0.0, 1.0]
    assert relative_error(reflectance.lambert(normal, light, 0.7), 0.7 * np.cos(angle)) < 1e-12
    shiny = reflectance.phong(normal, light, eye, 0.7, specular=0.5, shininess=32.0)
    assert relative_error(shiny, 0.7 * np.cos(angle) + 0.5 * np.cos(angle) ** 32) < 1e-12
    shiny = reflectance.blinn_phong(normal, light, eye, 0.7, specular=0.5, shininess=128.0)
    assert relative_error(shiny, 0.7 * np.cos(angle) + 0.5 * np.cos(angle / 2) ** 128) < 1e-12


def test_colours_agree_with_colour_science() -> None:
    colours = RNG.uniform(0.0, 1.0, (500, 3))
    theirs = colour.cctf_encoding(colours, function="sRGB")
    assert relative_error(srgb.encode_srgb(colours), theirs) < 1e-12
    theirs = colour.normalised_primary_matrix(cie.SRGB_PRIMARIES_XY, cie.D65_XY)
    assert relative_error(cie.rgb_to_xyz_matrix(), theirs) < 1e-12
    theirs = colour.XYZ_to_Lab(colours, np.array(cie.D65_XY))
    assert relative_error(cie.xyz_to_lab(colours), theirs) < 1e-12


def test_rotations_round_trip_through_logarithm_and_exponential() -> None:
    R = rotations.exponential(VECTORS)
    assert np.abs(rotations.exponential(rotations.logarithm(R)) - R).max() <= 1e-14
    assert np.abs(rotations.logarithm(R) - VECTORS).max() <= 1e-14


def test_rotations_round_trip_through_quaternions() -> None:
    R = rotations.exponential(VECTORS)
    q = quaternions.from_matrix(R)
    assert np.abs(quaternions.to_matrix(q) - R).max() <= 1e-14
    back = quaternions.from_rotation_vector(quaternions.to_rotation_vector(q))
    assert np.abs(back - q).max() <= 1e-14
    assert np.abs(quaternions.from_matrix(quaternions.to_matrix(q)) - q).max() <= 1e-14


def test_colours_round_trip_through_every_conversion() -> None:
    colours = np.concatenate([RNG.uniform(0.0, 1.0, (500, 3)), [[0, 0, 0], [1, 1, 1]]])
    for there, back in (
        (srgb.encode_srgb, srgb.decode_srgb),
        (lambda rgb: rgb @ cie.rgb_to_xyz_matrix().T, cie.xyz_to_linear_rgb),
        (ycbcr.rgb_to_ycbcr, ycbcr.ycbcr_to_rgb),
    ):
        assert np.abs(back(there(colours)) - colours).max() <= 1e-14


FULL_WELL_E = photon_counting.Sensor().full_well_e


@pytest.mark.parametrize("mean_e", [0.1, 0.3, 1.0, 3.0, 10.0, 100.0, 3000.0, FULL_WELL_E])
def test_shot_noise_passes_kolmogorov_smirnov_at_all_levels(mean_e: float) -> None:
    """From a tenth of an electron to the full well; compared below the well, where samples clip."""
    samples = photon_counting.shot_noise(
        np.full(40_000, mean_e), np.random.default_rng(15), FULL_WELL_E
    )
    counts = np.arange(min(samples.max() + 1, FULL_WELL_E))
    share = np.searchsorted(np.sort(samples), counts, side="right") / samples.size
    distance = np.abs(share - stats.poisson.cdf(counts, mean_e)).max()
    assert distance < stats.kstwobign.ppf(0.99) / math.sqrt(samples.size)


@pytest.mark.parametrize("far", [1e3, 1e6, 1e9, 1e12])
def test_projection_far_from_the_origin_loses_no_digit(far: float) -> None:
    """The same scene moved by whole metres has exactly the same picture."""
    away = np.array([far, -far, 2 * far])
    grid = np.round(POINTS * 256) / 256  # exact wherever it is carried to here
    centre = np.array([0.5, -0.25, -6.0])
    K = pinhole.intrinsics(800.0, (320.0, 240.0))
    near = pinhole.project(pinhole.relative_to_camera(grid, POSE[:3, :3], centre), K)[0]
    carried = pinhole.relative_to_camera(grid + away, POSE[:3, :3], centre + away)
    np.testing.assert_array_equal(pinhole.project(carried, K)[0], near)
