"""The reference of every ladder against an independent answer, and its metrics against known
errors."""

import math
from dataclasses import replace
from fractions import Fraction
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray
from scipy import stats
from scipy.fft import dctn
from scipy.integrate import quad
from scipy.spatial.transform import Rotation, Slerp
from support.ladders import run_of

from simulations.ladders import baked_light
from simulations.models.compression.blocks import LUMINANCE_TABLE
from simulations.models.distortion.lens_model import Distortion, distort
from simulations.models.geometry.rotations import logarithm
from simulations.models.lens.aperture import fibonacci_disc
from simulations.models.lens.chromatic_aberration import lateral_chromatic_scale
from simulations.models.lens.vignetting import disc_overlap_area
from simulations.pictures import cards, moving_ball

type Floats = NDArray[np.float64]


def test_block_dct_reference_is_scipys_transform_of_whole_codes() -> None:
    run = run_of("block-dct")
    oracle = dctn(run.work, type=2, norm="ortho", axes=(-2, -1))
    np.testing.assert_allclose(run.truth.astype(float), oracle, atol=1e-11)
    assert np.array_equal(run.work, np.rint(run.work))


def test_coefficient_halfway_between_codes_may_round_either_way() -> None:
    run, tie = run_of("block-dct"), np.zeros((1, 8, 8))
    tie[0, 0, 0] = 2.5 * LUMINANCE_TABLE[0, 0]
    assert run.metrics["changed"](tie + 0.01, tie, run.work) == 0.0
    clear = tie + 0.3 * LUMINANCE_TABLE
    assert run.metrics["changed"](clear + 0.9 * LUMINANCE_TABLE, clear, run.work) == 1e6


def test_calibration_reference_leaves_the_noise_of_the_corners() -> None:
    run = run_of("camera-calibration")
    off = run.truth - run.work.views.pixels
    spare = 1.0 - (6 * len(off) + 6) / off.size
    assert np.sqrt((off * off).mean() / spare) == pytest.approx(run.module.NOISE_PX, rel=0.05)
    focal = [camera.fx / run.module.TRUTH.fx for camera, _ in run.work.poor]
    assert min(abs(np.log(focal))) > 0.3


def test_lateral_colour_agrees_with_adaptive_quadrature_over_wavelengths() -> None:
    run = run_of("chromatic-aberration")
    module = run.module
    blue, row, column = 2, module.SIZE // 2 + 3, 5
    x, edges = float(run.work.x[0, column]), module.TILE_PX * (np.arange(-9, 9) + 0.5)

    def light(wavelength_um: float) -> float:
        scale = float(lateral_chromatic_scale(module.LENS, 50.0, 60.0, wavelength_um))
        low, high = (x - 0.5) / scale, (x + 0.5) / scale
        tiles = np.diff(np.clip(edges, low, high))
        bell = np.exp(-0.5 * ((wavelength_um - module.PEAKS_UM[blue]) / module.WIDTH_UM) ** 2)
        bright = tiles[::2].sum()  # in this row, which lies in tile 0, the even tiles are light
        return float(bright / (high - low) * bell / (module.WIDTH_UM * np.sqrt(2 * np.pi)))

    expected, _ = quad(light, 0.30, 0.62, limit=400)
    assert run.truth[blue, row, column] == pytest.approx(expected, abs=1e-4)


def test_corners_are_where_opencv_projects_the_board() -> None:
    run = run_of("corner-refinement")
    view = run.module._view()
    pose, lens = view.board_to_camera, np.array(view.lens.opencv)
    board = run.module.BOARD.points_mm
    oracle, _ = cv2.projectPoints(board, logarithm(pose[:3, :3]), pose[:3, 3], view.K, lens)
    assert np.abs(oracle[:, 0] - run.truth[0]).max() < 1e-9


def test_coverage_of_a_disc_agrees_with_quadrature() -> None:
    run = run_of("edge-coverage")
    for disc, truth, every in zip(run.work, run.truth, (40, 5), strict=True):
        assert truth.sum() == pytest.approx(np.pi * disc.radius**2, rel=1e-13)
        rows, columns = np.nonzero((truth > 0.05) & (truth < 0.95))
        for row, column in list(zip(rows, columns, strict=True))[::every]:
            x, y, radius = disc.x[column], disc.y[row], disc.radius

            def covered(at: float, y: float = y, radius: float = radius) -> float:
                half = math.sqrt(max(radius**2 - at**2, 0.0))
                return max(min(half, y + 0.5) - max(-half, y - 0.5), 0.0)

            area, _ = quad(covered, x - 0.5, x + 0.5, limit=200)
            assert truth[row, column] == pytest.approx(area, abs=1e-6)


@pytest.mark.parametrize("which", [0, 1])
def test_metrics_detect_a_disc_larger_by_a_hundredth_of_a_pixel(which: int) -> None:
    run = run_of("edge-coverage")
    larger = [*run.work]
    larger[which] = replace(larger[which], radius=larger[which].radius + 0.01)
    moved = run.ladder.tier("curved").run(tuple(larger))
    for name, measure in run.metrics.items():
        value, before = measure(moved, run.truth, run.work), run.error(name, "curved")
        assert value > 0.3 if name.endswith("-small") == bool(which) else value == before


def brute_force(run: Any, power: int = 1, count: int = 400) -> Floats:
    """Mean over many instants of the picture of the moving ball, or of its square."""
    behind = moving_ball.wall(run.work.x, run.work.y)
    times = (np.arange(count) + 0.5) / count
    pictures = (moving_ball.instant(run.work.x, run.work.y, t, behind) ** power for t in times)
    return np.asarray(sum(pictures) / count)


def test_exposure_reference_is_the_mean_of_four_hundred_instants() -> None:
    """A pixel changes at most ten times, by at most 0.8, and each change costs at most 1/800."""
    run = run_of("exposure-blur")
    assert run.metrics["worst"](brute_force(run), run.truth, run.work) < 10 * 0.8 / 800
    assert run.metrics["rms"](brute_force(run), run.truth, run.work) < 0.5 / 400
    length = 2 * moving_ball.RADIUS * moving_ball.TRAVEL
    swept = length + np.pi * moving_ball.RADIUS**2
    assert run.truth.swept.sum() == pytest.approx(swept, rel=0.01)
    behind, rest = moving_ball.wall(run.work.x, run.work.y), ~run.truth.swept
    np.testing.assert_allclose(run.truth.picture[rest], behind[rest], atol=1e-15)


def test_random_instants_err_by_the_spread_of_the_light() -> None:
    run = run_of("exposure-blur")
    variance = brute_force(run, power=2) - brute_force(run) ** 2
    expected = np.sqrt(variance[run.truth.swept].mean() / 16)
    assert run.error("rms", "random-16") == pytest.approx(expected, rel=0.03)


def test_more_rays_change_the_reference_less_than_the_best_tiers_error() -> None:
    run = run_of("depth-of-field")
    more = run.module.reference(run.work, rays=9000)
    assert run.metrics["psnr"](more, run.truth, run.work) > run.error("psnr", "fibonacci-64") + 6


def test_covered_share_of_the_lens_is_the_overlap_of_two_discs() -> None:
    """Seen from a pixel, the card covers the lens as one disc overlaps another."""
    near, lens_radius = cards.CARDS[-1], run_of("depth-of-field").work.lens_radius
    seen = cards.pixels(80, np.float64)
    nodes = fibonacci_disc(2000) * lens_radius
    cover = sum(cards.card_light(near, seen, *point)[1] for point in nodes) / len(nodes)
    shrink = abs(1 - near.z / cards.FOCUS_Z)
    away = np.hypot(seen.x * near.z - near.x, seen.y * near.z - near.y) / shrink
    share = disc_overlap_area(away, near.radius / shrink, lens_radius) / (np.pi * lens_radius**2)
    np.testing.assert_allclose(cover, share, atol=0.01)


def test_homography_points_agree_with_opencv_and_have_their_noise() -> None:
    run = run_of("homography-estimation")
    for view, matches, truth in zip(run.module.VIEWS, run.work, run.truth, strict=True):
        H = np.append(view.homography, 1.0).reshape(3, 3)
        oracle = cv2.perspectiveTransform(matches.check[None], H)[0]
        np.testing.assert_allclose(truth, oracle, atol=1e-9)
        there = cv2.perspectiveTransform(matches.exact.reshape(1, -1, 2), H)
        noise = [
            (matches.source - matches.exact).ravel(),
            (matches.target.reshape(1, -1, 2) - there).ravel(),
        ]
        assert np.std(noise, axis=1) == pytest.approx(view.noise_px, rel=0.1, abs=1e-9)
        if view.noise_px:
            assert abs(np.corrcoef(*noise)[0, 1]) < 0.1


@pytest.mark.parametrize("factor", [1.0, -3.0])
def test_homography_shifted_by_five_pixels_errs_by_five_at_any_scale(factor: float) -> None:
    run = run_of("homography-estimation")
    shift = np.array([[1.0, 0.0, 3.0], [0.0, 1.0, 4.0], [0.0, 0.0, 1.0]])
    true = [np.append(view.homography, 1.0).reshape(3, 3) for view in run.module.VIEWS]
    shifted = tuple(factor * (shift @ H)[None] for H in true)
    assert run.metrics["rms"](shifted, run.truth, run.work) == pytest.approx(5.0)
    lost = tuple(np.full((1, 3, 3), np.nan) for _ in true)
    assert run.metrics["poster"](lost, run.truth, run.work) == pytest.approx(1000.0)


def test_undistorted_points_round_trip_and_agree_with_opencv() -> None:
    mild, strong = run_of("inverse-distortion"), run_of("inverse-strong")
    for work, truth in ((mild.work, mild.truth), *zip(strong.work, strong.truth, strict=True)):
        assert work.focal_px * np.abs(distort(truth, work.lens) - work.distorted).max() < 1e-12
    until = (cv2.TERM_CRITERIA_COUNT + cv2.TERM_CRITERIA_EPS, 100, 1e-16)
    coefficients = np.array([-0.3, 0.1, 0.0, 0.0])
    oracle = cv2.undistortPoints(
        mild.work.distorted[:, None], np.eye(3), coefficients, criteria=until
    )
    assert mild.work.focal_px * np.abs(oracle[:, 0, :] - mild.truth).max() < 1e-9


def test_metrics_of_inverse_lenses_measure_a_known_shift() -> None:
    mild, strong = run_of("inverse-distortion"), run_of("inverse-strong")
    moved = strong.truth[0] + np.array([3.0 / strong.work[0].focal_px, 0.0])
    half = {name: m((moved, strong.truth[1]), strong.truth, strong.work)
            for name, m in strong.metrics.items()}  # fmt: skip
    assert half == pytest.approx({"rms": 3.0 / np.sqrt(2.0), "pincushion": 3.0, "fold": 0.0})
    other = replace(mild.work, lens=Distortion(k1=-0.3001, k2=0.1))
    result = mild.ladder.tier("newton-4").run(other)
    assert mild.metrics["rms"](result, mild.truth, mild.work) > 1e-3


def test_mtf50_is_where_blur_times_pixel_is_one_half() -> None:
    run = run_of("mtf-binning")
    truth = run.module.reference(run.module.prepare((5.0,))).clean
    across, down = (np.sinc(truth * side) for side in (np.cos(np.pi / 36), np.sin(np.pi / 36)))
    spots = np.exp(-2.0 * (np.pi * np.array([0.5, 1.0]) * truth) ** 2)
    np.testing.assert_allclose(spots * across * down, 0.5, atol=1e-6)


def test_pixels_far_from_the_origin_agree_with_exact_fractions() -> None:
    run = run_of("precision")
    TURN = run.module.TURN
    assert np.array_equal(TURN @ TURN.T, 225 * np.eye(3))
    assert np.linalg.det(TURN) > 0
    assert np.abs(run.truth).max() < 0.51 * run.module.FOCAL_PX
    for index in (0, 1, 9_999):
        step = [int(each) for each in run.work.steps[index]]
        x, _, z = (sum(int(a) * b for a, b in zip(row, step, strict=True)) for row in TURN)
        assert run.truth[index, 0] == pytest.approx(float(Fraction(1000 * x, z)), rel=3e-16)
    for place in (run.work.near, run.work.far):
        exact = (place.points - place.centre) / run.module.UNIT_M
        np.testing.assert_array_equal(exact, run.work.steps)


def test_lost_point_counts_a_thousand_pixels_in_its_own_metric_only() -> None:
    run = run_of("precision")
    lost = run.truth.copy()
    lost[0] = np.nan
    expected = run.module.FOCAL_PX / np.sqrt(len(run.truth))
    assert run.metrics["far"]((run.truth, lost), run.truth, run.work) == pytest.approx(expected)
    assert run.metrics["near"]((run.truth, lost), run.truth, run.work) == 0.0


@pytest.mark.parametrize("pair", [1, 10, 90, 179])
def test_arc_between_two_orientations_is_scipys_slerp(pair: int) -> None:
    run = run_of("rotation-interpolation")
    ends = np.stack([run.work.start[pair, 0], run.work.end[pair, 0]])
    path = Slerp([0.0, 1.0], Rotation.from_quat(ends, scalar_first=True))
    ours = Rotation.from_quat(run.truth[pair].astype(float), scalar_first=True)
    assert (path(run.work.share).inv() * ours).magnitude().max() < 1e-14


def test_distance_between_two_orientations_is_their_angle() -> None:
    run = run_of("rotation-interpolation")
    identity = np.array([[[1.0, 0.0, 0.0, 0.0]]])
    half = np.radians(30.0) / 2.0
    turned = np.array([[[np.cos(half), 0.0, np.sin(half), 0.0]]])
    for sign in (1.0, -1.0):
        assert run.metrics["worst"](sign * turned, identity, run.work) == pytest.approx(30.0)


@pytest.mark.parametrize("place", [(128, 128), (60, 190), (0, 256), (256, 0), (30, 220)])
def test_dome_is_lit_by_phongs_formula_with_the_mirrored_view(place: tuple[int, int]) -> None:
    run = run_of("shading")
    n, light = [float(each) for each in run.work[place]], run.module.LIGHT
    n_dot_l = math.fsum(a * b for a, b in zip(n, light, strict=True))
    mirrored_view = [2 * n[2] * n[0], 2 * n[2] * n[1], 2 * n[2] * n[2] - 1]
    cosine = max(0.0, math.fsum(a * b for a, b in zip(mirrored_view, light, strict=True)))
    lit = 0.5 * n_dot_l + 0.5 * cosine**32 if n_dot_l > 0 else 0.0
    assert run.truth[place] == pytest.approx(lit, abs=1e-9)
    # The highlight peaks where the normal halves the angle of 37° between light and camera.
    assert run.truth.min() == 0.0
    assert run.truth.max() == pytest.approx(0.5 * math.sqrt((1 + light[2]) / 2) + 0.5, abs=1e-3)


def test_photon_counts_have_scipys_poisson_distribution() -> None:
    run = run_of("shot-noise")
    for row, mean in enumerate(run.module.LEVELS_E):
        oracle = stats.poisson.cdf(np.arange(run.truth.shape[1]), mean)
        np.testing.assert_allclose(run.truth[row], oracle, atol=1e-14)


KNOWN_ERRORS = [
    ("demosaicing", "psnr-room", lambda truth: tuple(np.roll(p, 1, axis=1) for p in truth), 0, 40),
    ("depth-of-field", "psnr", lambda truth: truth + 1e-3, 59.9, 60.1),
    ("depth-of-field", "psnr", lambda truth: np.roll(truth, 1, axis=2), 0, 30),
    ("shading", "rms", lambda truth: truth + 0.25, 0.2499, 0.2501),
    ("shading", "worst", lambda truth: truth - 0.25, 0.2499, 0.2501),
    ("chromatic-aberration", "worst", lambda truth: truth * 1.5, 0.499, 0.501),
    ("block-dct", "worst", lambda truth: truth + 0.5, 0.499, 0.501),
]


@pytest.mark.parametrize(("ladder_id", "metric", "spoil", "low", "high"), KNOWN_ERRORS)
def test_metric_measures_a_known_error(
    ladder_id: str, metric: str, spoil: Any, low: float, high: float
) -> None:
    run = run_of(ladder_id)
    assert low < run.metrics[metric](spoil(run.truth), run.truth, run.work) < high


def test_light_at_every_point_agrees_with_maps_where_upright_walls_are_in_shadow() -> None:
    view = baked_light.draw(43)
    assert (
        baked_light.rms_codes(baked_light.baked(view, spacing=0.02), baked_light.traced(view), view)
        < 0.1
    )
