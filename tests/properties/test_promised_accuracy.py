"""The accuracy that the book promises of its models, clause by clause.

Forward models are within 1e-12 of an independent oracle, relative to the largest value; rotations
survive any conversion and its way back to 1e-14; demosaicing is the published methods' in the
interior; shot noise passes a 1 % Kolmogorov–Smirnov test from 0.1 electrons to a full well, and a
photon-transfer curve tells the gain within 1 %; geometry is as good far from the origin as near.
The other tests of a model say what it does; these say how well.
"""

import math
import warnings
from collections.abc import Callable

import cv2
import numpy as np
import pytest
import scipy.fft
from scipy import stats
from scipy.spatial.transform import Rotation, Slerp

from simulations.models.arrays import Floats
from simulations.models.color import cie, srgb, ycbcr
from simulations.models.compression import blocks as compression
from simulations.models.distortion import lens_model
from simulations.models.geometry import euler, quaternions, rotations, transforms
from simulations.models.lens import vignetting
from simulations.models.lens.thin_lens import thin_lens_image_distance
from simulations.models.light import reflectance
from simulations.models.projection import pinhole
from simulations.models.projection.affine_cameras import project_affine, scaled_orthographic_camera
from simulations.models.sensor import photon_counting, photon_transfer
from simulations.models.sensor.demosaicing import demosaic, mosaic

with warnings.catch_warnings():
    warnings.simplefilter("ignore")  # they miss packages for plotting
    import colour
    import colour_demosaicing

RNG = np.random.default_rng(11)
POSE = pinhole.look_at([3.0, -1.0, -6.0], [0.2, 0.1, 0.3], [0.0, -1.0, 0.1])
POINTS = RNG.uniform(-2.0, 2.0, (500, 3))
NEAR_HALF_A_TURN = math.pi - np.geomspace(1e-12, 1.0, 25)
ANGLES = np.concatenate([np.geomspace(1e-12, 3.0, 50), NEAR_HALF_A_TURN])
AXES = Rotation.random(75, rng=np.random.default_rng(12)).apply([1.0, 0.0, 0.0])
VECTORS = ANGLES[:, None] * AXES
"""Axis times angle, from hardly a turn to hardly less than half a turn."""


def relative_error(ours: Floats, theirs: Floats) -> float:
    return np.abs(ours - theirs).max() / np.abs(theirs).max()


def by_opencv(
    points: Floats, pose: Floats, K: Floats, coefficients: Floats | None = None
) -> Floats:
    rotation = cv2.Rodrigues(pose[:3, :3])[0]
    return cv2.projectPoints(points, rotation, pose[:3, 3], K, coefficients)[0][:, 0]


def test_projection_is_opencvs() -> None:
    K = pinhole.intrinsics((800.0, 815.0), (320.0, 240.0))
    ours, valid = pinhole.project(pinhole.world_to_camera(POINTS, POSE), K)
    assert valid.all()
    assert relative_error(ours, by_opencv(POINTS, POSE, K)) < 1e-12


def test_homogeneous_projection_is_opencvs() -> None:
    K = pinhole.intrinsics((800.0, 815.0), (320.0, 240.0))
    homogeneous = np.column_stack([POINTS, np.ones(len(POINTS))]) * RNG.uniform(0.1, 9, (500, 1))
    ours, _ = pinhole.project_homogeneous(homogeneous, pinhole.camera_matrix(K, POSE))
    assert relative_error(ours, by_opencv(POINTS, POSE, K)) < 1e-12


def test_scaled_orthography_is_opencvs_projection_of_flattened_points() -> None:
    K = pinhole.intrinsics((800.0, 815.0), (320.0, 240.0))
    camera_points = POINTS + np.array([0.0, 0.0, 6.0])
    flat = camera_points.copy()
    flat[:, 2] = 6.0
    ours, _ = project_affine(camera_points, scaled_orthographic_camera(K, 6.0))
    assert relative_error(ours, by_opencv(flat, np.eye(4), K)) < 1e-12


def test_distortion_is_opencvs() -> None:
    coefficients = np.array([-0.3, 0.12, 1e-3, -2e-3, -0.02, 0.05, 0.01, 0.002])
    k1, k2, p1, p2, k3, k4, k5, k6 = coefficients
    lens = lens_model.Distortion(k1=k1, k2=k2, p1=p1, p2=p2, k3=k3, k4=k4, k5=k5, k6=k6)
    ideal = RNG.uniform(-0.7, 0.7, (500, 2))
    rays = np.column_stack([ideal, np.ones(500)])
    theirs = by_opencv(rays, np.eye(4), np.eye(3), coefficients)
    assert relative_error(lens_model.distort(ideal, lens), theirs) < 1e-12


def test_homographies_are_opencvs() -> None:
    H = np.array([[1.1, 0.2, 5.0], [-0.1, 0.9, -3.0], [1e-3, 5e-4, 1.0]])
    points = RNG.uniform(-100.0, 100.0, (500, 2))
    theirs = cv2.perspectiveTransform(points[:, None], H)[:, 0]
    assert relative_error(transforms.apply_homography(H, points)[0], theirs) < 1e-12


def test_rotations_are_scipys() -> None:
    theirs = Rotation.from_rotvec(VECTORS)
    assert relative_error(rotations.exponential(VECTORS), theirs.as_matrix()) < 1e-12
    q = quaternions.from_rotation_vector(VECTORS)
    assert relative_error(q, theirs.as_quat(canonical=True, scalar_first=True)) < 1e-12
    turned = quaternions.rotate(q, POINTS[:75])
    assert relative_error(turned, theirs.apply(POINTS[:75])) < 1e-12


def test_the_way_between_two_orientations_is_scipys() -> None:
    pair = Rotation.random(2, rng=np.random.default_rng(13))
    shares = np.linspace(0.0, 1.0, 21)
    theirs = Slerp([0, 1], pair)(shares).as_matrix()
    start, end = pair.as_quat(scalar_first=True)
    ours = quaternions.to_matrix(np.stack([rotations.slerp(start, end, s) for s in shares]))
    assert relative_error(ours, theirs) < 1e-12


def test_reflected_light_is_that_of_the_angles() -> None:
    """A light at an angle to the normal, seen from the normal: all from plain trigonometry."""
    angle = np.linspace(0.0, 1.5, 200)
    light = np.stack([np.sin(angle), np.zeros(200), np.cos(angle)], axis=-1)
    normal = np.broadcast_to([0.0, 0.0, 1.0], (200, 3))
    eye = [0.0, 0.0, 1.0]
    assert relative_error(reflectance.lambert(normal, light, 0.7), 0.7 * np.cos(angle)) < 1e-12
    shiny = reflectance.phong(normal, light, eye, 0.7, specular=0.5, shininess=32.0)
    assert relative_error(shiny, 0.7 * np.cos(angle) + 0.5 * np.cos(angle) ** 32) < 1e-12
    shiny = reflectance.blinn_phong(normal, light, eye, 0.7, specular=0.5, shininess=128.0)
    assert relative_error(shiny, 0.7 * np.cos(angle) + 0.5 * np.cos(angle / 2) ** 128) < 1e-12


def test_lenses_are_those_of_similar_triangles() -> None:
    distances = np.geomspace(60.0, 1e6, 50)
    ours = thin_lens_image_distance(50.0, distances)
    assert relative_error(ours, 50.0 * distances / (distances - 50.0)) < 1e-12
    angle = np.linspace(0.0, 1.5, 100)
    dark = vignetting.vignetting_cos4(np.tan(angle))
    assert relative_error(dark, np.cos(angle) ** 4) < 1e-12


def test_colours_are_those_of_colour_science() -> None:
    colours = RNG.uniform(0.0, 1.0, (500, 3))
    theirs = colour.cctf_encoding(colours, function="sRGB")
    assert relative_error(srgb.encode_srgb(colours), theirs) < 1e-12
    theirs = colour.normalised_primary_matrix(cie.SRGB_PRIMARIES_XY, cie.D65_XY)
    assert relative_error(cie.rgb_to_xyz_matrix(), theirs) < 1e-12
    theirs = colour.XYZ_to_Lab(colours, np.array(cie.D65_XY))
    assert relative_error(cie.xyz_to_lab(colours), theirs) < 1e-12


def test_the_cosine_transform_is_scipys() -> None:
    blocks = RNG.uniform(-128.0, 127.0, (50, 8, 8))
    theirs = scipy.fft.dctn(blocks, axes=(1, 2), norm="ortho")
    assert relative_error(compression.block_dct(blocks), theirs) < 1e-12


def test_rotations_survive_the_logarithm_and_the_exponential() -> None:
    R = rotations.exponential(VECTORS)
    assert np.abs(rotations.exponential(rotations.logarithm(R)) - R).max() <= 1e-14
    assert np.abs(rotations.logarithm(R) - VECTORS).max() <= 1e-14


def test_rotations_survive_quaternions() -> None:
    R = rotations.exponential(VECTORS)
    q = quaternions.from_matrix(R)
    assert np.abs(quaternions.to_matrix(q) - R).max() <= 1e-14
    back = quaternions.from_rotation_vector(quaternions.to_rotation_vector(q))
    assert np.abs(back - q).max() <= 1e-14
    assert np.abs(quaternions.from_matrix(quaternions.to_matrix(q)) - q).max() <= 1e-14


@pytest.mark.parametrize("sequence", ["ZYX", "xyz", "ZXZ", "xzx"])
def test_rotations_survive_euler_angles(sequence: str) -> None:
    R = Rotation.random(500, rng=np.random.default_rng(14)).as_matrix()
    angles, locked = euler.from_matrix(R, sequence)
    assert not locked.any()
    assert np.abs(euler.to_matrix(sequence, angles) - R).max() <= 1e-14


def test_colours_survive_every_conversion_and_its_way_back() -> None:
    colours = np.concatenate([RNG.uniform(0.0, 1.0, (500, 3)), [[0, 0, 0], [1, 1, 1]]])
    for there, back in (
        (srgb.encode_srgb, srgb.decode_srgb),
        (cie.linear_rgb_to_xyz, cie.xyz_to_linear_rgb),
        (ycbcr.rgb_to_ycbcr, ycbcr.ycbcr_to_rgb),
    ):
        assert np.abs(back(there(colours)) - colours).max() <= 1e-14


@pytest.mark.parametrize(
    ("method", "theirs", "border"),
    [
        ("bilinear", colour_demosaicing.demosaicing_CFA_Bayer_bilinear, 1),
        ("malvar", colour_demosaicing.demosaicing_CFA_Bayer_Malvar2004, 2),
    ],
)
@pytest.mark.parametrize("pattern", ["RGGB", "BGGR", "GRBG", "GBRG"])
def test_linear_demosaicing_is_the_published_one_in_the_interior(
    method: str, theirs: Callable[..., Floats], border: int, pattern: str
) -> None:
    cfa = mosaic(RNG.uniform(0.0, 1.0, (21, 34, 3)), pattern)
    inner = (slice(border, -border), slice(border, -border))
    ours = demosaic(cfa, pattern, method)[inner]
    expected = np.clip(theirs(cfa, pattern), 0.0, 1.0)[inner]
    assert np.abs(np.clip(ours, 0.0, 1.0) - expected).max() <= 1e-6


FULL_WELL_E = photon_counting.Sensor().full_well_e


@pytest.mark.parametrize("mean_e", [0.1, 0.3, 1.0, 3.0, 10.0, 100.0, 3000.0, FULL_WELL_E])
def test_shot_noise_passes_kolmogorov_and_smirnov_from_a_tenth_of_an_electron_to_the_well(
    mean_e: float,
) -> None:
    """Up to the well, where the samples stop; their distribution function is compared below."""
    samples = photon_counting.shot_noise(
        np.full(40_000, mean_e), np.random.default_rng(15), FULL_WELL_E
    )
    counts = np.arange(min(samples.max() + 1, FULL_WELL_E))
    share = np.searchsorted(np.sort(samples), counts, side="right") / samples.size
    distance = np.abs(share - stats.poisson.cdf(counts, mean_e)).max()
    assert distance < stats.kstwobign.ppf(0.99) / math.sqrt(samples.size)


@pytest.mark.parametrize("gain_e_per_dn", [0.5, 2.0, 5.0])
@pytest.mark.parametrize("seed", range(5))
def test_photon_transfer_tells_the_gain_within_one_per_cent(
    gain_e_per_dn: float, seed: int
) -> None:
    camera = photon_counting.Sensor(full_well_e=15_000.0, gain_e_per_dn=gain_e_per_dn, bits=16)
    levels = np.linspace(300.0, 12_000.0, 24)
    mean, variance = photon_transfer.photon_transfer(levels, camera, np.random.default_rng(seed))
    gain = photon_transfer.estimate_gain(mean, variance)
    assert gain.e_per_dn == pytest.approx(gain_e_per_dn, rel=0.01)
    assert gain.error_e_per_dn < 0.0035 * gain_e_per_dn


@pytest.mark.parametrize("far", [1e3, 1e6, 1e9, 1e12])
def test_geometry_is_as_good_far_from_the_origin_as_near_it(far: float) -> None:
    """The same scene carried away by whole metres: not a digit of its picture is lost."""
    away = np.array([far, -far, 2 * far])
    grid = np.round(POINTS * 256) / 256  # exact wherever it is carried to here
    centre = np.array([0.5, -0.25, -6.0])
    K = pinhole.intrinsics(800.0, (320.0, 240.0))
    near = pinhole.project(pinhole.relative_to_camera(grid, POSE[:3, :3], centre), K)[0]
    carried = pinhole.relative_to_camera(grid + away, POSE[:3, :3], centre + away)
    np.testing.assert_array_equal(pinhole.project(carried, K)[0], near)
