"""Chequerboards over sizes, poses, light and blur, beside OpenCV, and in large photographs."""

import io
import tracemalloc

import cv2
import numpy as np
import pytest
from PIL import Image
from support.boards import facing_board

from simulations.models.chequerboard.board import Board
from simulations.models.chequerboard.find_board import find_board
from simulations.models.error_measures import root_mean_square
from simulations.models.geometry.rotations import exponential, logarithm
from simulations.pictures.chequerboard import Look, View, photograph_of, true_corners

pytestmark = pytest.mark.deep

SIZES = ((10, 7), (8, 6), (12, 9), (7, 5))
PICTURES = ((640, 480), (800, 600), (1280, 960))
COUNT = 60


def _view(number: int, random: np.random.Generator) -> tuple[Board, View]:
    """A board that leans by up to 60°, wholly in the picture, behind a barrel of −0.3."""
    board = Board(*SIZES[number % len(SIZES)], 25.0)
    width, height = PICTURES[number % len(PICTURES)]
    focal_px, extent = width * random.uniform(0.75, 1.3), 25.0 * np.hypot(board.across, board.down)
    lean, to = np.radians(random.uniform(0, 60)), random.uniform(0, 2 * np.pi)
    roll = exponential(np.array([0.0, 0.0, random.uniform(-np.pi, np.pi)]))
    turned = exponential(lean * np.array([np.cos(to), np.sin(to), 0.0])) @ roll
    x, y, z = logarithm(turned)
    distance = focal_px / height * extent * random.uniform(0.75, 1.8)
    while True:
        right, down = random.uniform(-0.2, 0.2, 2) * extent
        view = facing_board(
            board,
            width,
            height,
            focal_px=focal_px,
            tilt=(x, y, z),
            distance_mm=distance,
            aside_mm=(right, down),
        )
        corners = true_corners(board, view)
        if (corners > 8).all() and (corners < [width - 8, height - 8]).all():
            return board, view
        distance *= 1.06


def _codes(board: Board, view: View, number: int, random: np.random.Generator) -> np.ndarray:
    """Noise of one code and JPEG 80."""
    look = Look(
        paper=random.uniform(0.3, 0.9),
        ink=random.uniform(0.01, 0.08),
        shading=random.uniform(0.0, 0.5),
        blur_px=random.uniform(0.5, 1.3),
        noise_codes=1.0,
        seed=number,
    )
    file = io.BytesIO()
    Image.fromarray(photograph_of(board, view, look)).save(file, "JPEG", quality=80)
    return np.asarray(Image.open(file))


def _rms(found: np.ndarray, truth: np.ndarray) -> float:
    distance = np.hypot(*(found[:, None] - truth).transpose(2, 0, 1)).min(axis=1)
    return root_mean_square(distance)


def test_all_are_found_to_a_twentieth_of_a_pixel_and_nearer_than_opencv_s() -> None:
    random = np.random.default_rng(11)
    flags = cv2.CALIB_CB_ACCURACY | cv2.CALIB_CB_EXHAUSTIVE | cv2.CALIB_CB_NORMALIZE_IMAGE
    for number in range(COUNT):
        board, view = _view(number, random)
        codes, truth = _codes(board, view, number, random), true_corners(board, view)
        found = find_board(codes)
        assert len(found.places) == len(truth), number
        assert found.size == board.corners, number
        assert _rms(found.places, truth) < 0.05, number
        there, theirs = cv2.findChessboardCornersSB(codes, board.corners, flags=flags)
        if there:
            ours = _rms(found.places, truth)
            assert ours < 1.1 * _rms(theirs.reshape(-1, 2), truth), number


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
    assert _rms(found.places, 4.0 * (true_corners(board, view) + 0.5) - 0.5) < 0.2
    assert len(found.places) == 54
    assert peak < 100e6
