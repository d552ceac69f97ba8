"""Chequerboards in rendered photographs: number and precision of corners against OpenCV."""

import io
import tracemalloc
from functools import cache

import cv2
import numpy as np
import pytest
import skimage.data
from PIL import Image
from support.chequerboards import facing_board

from simulations.models.chequerboard.board import Board
from simulations.models.chequerboard.board_search import NoBoardError
from simulations.models.chequerboard.find_board import FoundBoard, find_board
from simulations.models.error_measures import root_mean_square
from simulations.pictures.chequerboard import Codes, Glare, Look, View, photograph_of, true_corners

BOARD = Board(10, 7, 25.0)
NOISY = Look(noise_codes=1.0)

TILTS = ((0.1, 0.05, 0.0), (0.5, 0.3, 0.1), (0.0, 1.0, 0.5), (-0.9, 0.2, 1.0), (0.2, -0.4, 2.6))
"""Rotation vectors; the third and the fourth lean the board by nearly 60°."""


def view_of(
    tilt: tuple[float, float, float], board: Board = BOARD, distance_mm: float = 400.0
) -> View:
    return facing_board(board, 560, 420, focal_px=490.0, tilt=tilt, distance_mm=distance_mm)


def jpeg(codes: Codes, quality: int = 80) -> Codes:
    file = io.BytesIO()
    Image.fromarray(codes).save(file, "JPEG", quality=quality)
    return np.asarray(Image.open(file))


def errors_px(found: FoundBoard, board: Board, view: View) -> np.ndarray:
    """(N,) distances from the true corners with the same column and row."""
    columns, _ = board.corners
    truth = true_corners(board, view)[found.indices[:, 1] * columns + found.indices[:, 0]]
    return np.hypot(*(found.places - truth).T)


def rms_to_nearest(found: np.ndarray, truth: np.ndarray) -> float:
    distance = np.hypot(*(found[:, None] - truth).transpose(2, 0, 1)).min(axis=1)
    return root_mean_square(distance)


@cache
def photograph(tilt: tuple[float, float, float]) -> Codes:
    """A rendered photograph with blur, noise of one code, barrel distortion −0.3 and JPEG 80."""
    return jpeg(photograph_of(BOARD, view_of(tilt), NOISY))


@pytest.mark.parametrize("tilt", TILTS)
def test_every_corner_is_found_and_numbered_as_precisely_as_by_opencv(
    tilt: tuple[float, float, float],
) -> None:
    found = find_board(photograph(tilt))
    assert found.size == BOARD.corners
    assert np.array_equal(found.indices, BOARD.indices)
    ours = root_mean_square(errors_px(found, BOARD, view_of(tilt)))
    assert ours < 0.025
    flags = cv2.CALIB_CB_ACCURACY | cv2.CALIB_CB_EXHAUSTIVE
    there, corners = cv2.findChessboardCornersSB(photograph(tilt), BOARD.corners, flags=flags)
    assert there
    assert ours < 1.1 * rms_to_nearest(corners.reshape(-1, 2), true_corners(BOARD, view_of(tilt)))


@pytest.mark.parametrize("sizes", [(5, 4), (6, 6), (8, 5), (15, 11)])
def test_boards_of_any_size_are_found_completely(sizes: tuple[int, int]) -> None:
    board = Board(*sizes, 250.0 / sizes[0])
    view = view_of((0.3, -0.3, 0.2), board, 380.0)
    found = find_board(photograph_of(board, view, NOISY))
    assert found.size == board.corners
    assert len(found.places) == board.corners[0] * board.corners[1]


@pytest.mark.parametrize("turns", [1, 2, 3])
def test_turned_photograph_has_the_same_corner_numbers(turns: int) -> None:
    plain = find_board(photograph(TILTS[1]))
    turned = find_board(np.ascontiguousarray(np.rot90(photograph(TILTS[1]), turns)))
    assert np.array_equal(turned.indices, plain.indices)
    height, width = np.rot90(photograph(TILTS[1]), turns).shape
    x, y = turned.places.T
    for _ in range(turns):
        x, y, height, width = height - 1 - y, x, width, height
    assert np.hypot(x - plain.places[:, 0], y - plain.places[:, 1]).max() < 0.05


@pytest.mark.parametrize("left", [200, 300])
def test_visible_part_of_a_cropped_board_is_found(left: int) -> None:
    codes = photograph_of(BOARD, view_of(TILTS[0], distance_mm=300.0), NOISY)[:, left:]
    found = find_board(np.ascontiguousarray(codes))
    truth = true_corners(BOARD, view_of(TILTS[0], distance_mm=300.0)) - [left, 0.0]
    inside = (truth > 12.0).all(axis=1) & (truth[:, 0] < codes.shape[1] - 12.0)
    assert len(found.places) >= inside.sum() - 2
    assert rms_to_nearest(found.places, truth) < 0.02


@pytest.mark.parametrize("radius", [15.0, 25.0])
def test_corners_beside_a_glare_are_found_in_place(radius: float) -> None:
    look = Look(noise_codes=1.0, glare=Glare(290.0, 200.0, radius, 1.5))
    found = find_board(photograph_of(BOARD, view_of(TILTS[0], distance_mm=330.0), look))
    assert found.size == BOARD.corners
    assert 40 <= len(found.places) < 54
    assert root_mean_square(errors_px(found, BOARD, view_of(TILTS[0], distance_mm=330.0))) < 0.05


def test_small_second_board_in_the_background_is_ignored() -> None:
    codes = photograph(TILTS[0]).copy()
    codes[:60, :80] = cv2.resize(codes, (80, 60), interpolation=cv2.INTER_AREA)
    assert len(find_board(codes).places) == 54


def _bent() -> Codes:
    x, y = np.meshgrid(np.arange(560, dtype=np.float32), np.arange(420, dtype=np.float32))
    return cv2.remap(photograph(TILTS[0]), x, y + 12 * np.cos((x - 280) / 50), cv2.INTER_CUBIC)


def _noisy(sigma: float) -> Codes:
    noise = np.random.default_rng(0).normal(0.0, 255 * sigma, photograph(TILTS[0]).shape)
    return np.clip(photograph(TILTS[0]) + noise, 0, 255).astype(np.uint8)


def _charuco() -> Codes:
    marks = cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_4X4_50)
    board = cv2.aruco.CharucoBoard((8, 6), 1.0, 0.7, marks).generateImage((880, 660))
    return cv2.GaussianBlur(np.pad(board, 60, constant_values=255), (0, 0), 1.0)


@pytest.mark.parametrize("amount", [2.0, 5.0])
def test_board_with_halos_of_sharpening_is_found(amount: float) -> None:
    sharp = photograph(TILTS[0]).astype(float)
    sharp += amount * (sharp - cv2.GaussianBlur(sharp, (0, 0), 2.0))
    found = find_board(np.clip(sharp, 0, 255).astype(np.uint8))
    assert len(found.places) > 50
    assert root_mean_square(errors_px(found, BOARD, view_of(TILTS[0]))) < 0.03 * (1 + amount)


def test_corners_on_both_sides_of_a_hard_shadow_are_found() -> None:
    shaded = photograph(TILTS[0]).astype(float)
    shaded[:, 300:] *= 0.4
    assert len(find_board(shaded.astype(np.uint8)).places) > 40


@pytest.mark.parametrize(
    ("codes", "words"),
    [
        (lambda: np.zeros((1, 1, 3), np.uint8), "No chequerboard"),
        (lambda: np.zeros((2, 3_000_000), np.uint8), "No chequerboard"),
        (lambda: np.full((420, 560, 3), 255, np.uint8), "No chequerboard"),
        (lambda: photograph(TILTS[0])[200:330, 250:360].copy(), "Only .* corners"),
        (lambda: np.hstack([photograph(TILTS[0]), photograph(TILTS[1])]), "Two"),
        (lambda: photograph_of(BOARD, view_of(TILTS[0], distance_mm=3200.0)), "closer"),
        (lambda: photograph_of(BOARD, view_of(TILTS[0]), Look(blur_px=9.0)), "blurred"),
        (_bent, "off by"),
        (lambda: _noisy(0.2), "too noisy"),
        (_charuco, "ChArUco"),
    ],
)
def test_unusable_photograph_is_refused_in_a_sentence(codes, words: str) -> None:  # type: ignore[no-untyped-def]
    with pytest.raises(NoBoardError, match=words) as refusal:
        find_board(codes())
    assert str(refusal.value).endswith(".")


REAL = ("astronaut", "brick", "camera", "chelsea", "coffee", "gravel", "page", "rocket", "text")


def _textures() -> dict[str, np.ndarray]:
    y, x = np.mgrid[:300, :400].astype(float)
    random = np.random.default_rng(4)
    shifted = np.floor((x + 30 * (np.floor(y / 30) % 2)) / 60)
    return {
        "noise": random.integers(0, 256, x.shape).astype(float),
        "clouds": 128 + cv2.GaussianBlur(random.normal(0, 400, x.shape), (0, 0), 3),
        "bricks": 200.0 - 90.0 * (((x + 30 * (np.floor(y / 30) % 2)) % 60 > 3) & (y % 30 > 3)),
        "two-tone bricks": 100.0 + 60.0 * ((shifted + np.floor(y / 30)) % 2),
        "stripes": 200.0 * ((x + y) // 10 % 2),
        "gingham": 60.0 + 75.0 * (x // 12 % 2 + y // 12 % 2),
        "dots": 200.0 * ((x % 20 - 10) ** 2 + (y % 20 - 10) ** 2 < 36),
        "twill": 50.0 + 150.0 * ((x // 10 + y // 10) % 4 < 2),
        "honeycomb": 127
        + 40 * sum(np.cos((x * np.cos(a) + y * np.sin(a)) / 4) for a in (0, 2.094, 4.189)),
    }


@pytest.mark.parametrize("name", [*REAL, *_textures()])
def test_photographs_and_textures_without_a_board_are_refused(name: str) -> None:
    if name in REAL:
        codes = getattr(skimage.data, name)()
    else:
        codes = np.clip(_textures()[name], 0, 255).astype(np.uint8)
    with pytest.raises(NoBoardError):
        find_board(codes)


@pytest.mark.deep
def test_24_megapixels_need_less_than_a_hundred_megabytes() -> None:
    board = Board()
    view = facing_board(
        board, 1500, 1000, focal_px=1300.0, tilt=(0.3, -0.2, 0.1), distance_mm=450.0
    )
    grey = cv2.resize(photograph_of(board, view), (6000, 4000), interpolation=cv2.INTER_CUBIC)
    codes = np.repeat(grey[..., None], 3, axis=2)
    tracemalloc.start()
    try:
        found = find_board(codes)
        _, peak = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert rms_to_nearest(found.places, 4.0 * (true_corners(board, view) + 0.5) - 0.5) < 0.2
    assert len(found.places) == 54
    assert peak < 100e6
