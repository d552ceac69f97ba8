"""Photographs of a chequerboard with known corners, for a camera that is to be calibrated.

Each pixel is the board's brightness, blurred by a Gaussian that stands for lens and pixel together;
edges are exact (`blurred_corner`), so no samples are taken within a pixel. Corners bear this as
long as a square is wider than six standard deviations of the blur.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from simulations.models.arrays import Floats, as_array
from simulations.models.chequerboard.blurred_corner import FAR, blurred_corner, blurred_edge
from simulations.models.chequerboard.board import Board
from simulations.models.color.srgb import encode_srgb
from simulations.models.distortion.lens_model import Distortion, distort, undistort
from simulations.models.projection.pinhole import project
from simulations.models.require import as_whole, require, require_positive

type Codes = NDArray[np.uint8]

ROWS = 256  # rows that are computed at once, which bounds the memory of large photographs


@dataclass(frozen=True, slots=True)
class Glare:
    """A reflected lamp, which is added to the light of the board."""

    x: float
    """Column of its middle, px."""
    y: float
    """Row of its middle, px."""
    radius_px: float
    """Standard deviation."""
    strength: float = 2.0
    """Light at the middle; 1 is the brightest that the picture can show."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Look:
    """Light, blur and noise of a photograph; luminances are linear, 1 is white."""

    paper: float = 0.75
    ink: float = 0.04
    around: float = 0.25
    """Luminance beyond the sheet, whose margin is one square wide."""
    shading: float = 0.0
    """Share of the light that is lost from the left to the right side."""
    glare: Glare | None = None
    blur_px: float = 0.7
    """Standard deviation of the blur; a pixel alone has 0.29."""
    noise_codes: float = 0.0
    """Standard deviation of the noise, in codes of 255."""
    seed: int = 0


@dataclass(frozen=True, slots=True)
class View:
    """A camera in front of a board."""

    width: int
    height: int
    K: Floats
    """(3, 3) from `pinhole.intrinsics`; pixel (0, 0) is centred at (0, 0)."""
    lens: Distortion
    board_to_camera: Floats
    """(4, 4), from millimetres in the board frame to millimetres in the camera frame."""


def true_corners(board: Board, view: View) -> Floats:
    """(N, 2) places of the inner corners in the picture in px, NaN for those behind the camera."""
    in_camera = board.points_mm @ view.board_to_camera[:3, :3].T + view.board_to_camera[:3, 3]
    ideal, _ = project(in_camera, np.eye(3))
    distorted: Floats = distort(ideal, view.lens)
    return distorted @ view.K[:2, :2].T + view.K[:2, 2]


def photograph_of(board: Board, view: View, look: Look | None = None) -> Codes:
    """The photograph (height, width), grey sRGB codes. Raises `ValueError` for a blur of 0."""
    look = look or Look()
    width, height = as_whole("width", view.width, 2), as_whole("height", view.height, 2)
    require_positive("blur_px", look.blur_px)
    as_array("board_to_camera", view.board_to_camera, 4, 4)
    facing = view.board_to_camera[:3, :3] @ view.board_to_camera[:3, 3]
    require("board_to_camera", facing, bool(np.isfinite(facing).all()), "finite")
    random = np.random.default_rng(look.seed)
    codes = np.empty((height, width), np.uint8)
    for rows in _strips(height):
        light = _light(board, view, look, rows)
        values = 255.0 * encode_srgb(np.clip(light, 0.0, 1.0))
        if look.noise_codes:
            values += look.noise_codes * random.standard_normal(values.shape)
        codes[rows] = np.clip(np.rint(values), 0.0, 255.0)
    return codes


def _strips(height: int) -> Iterator[slice]:
    return (slice(top, min(top + ROWS, height)) for top in range(0, height, ROWS))


def _light(board: Board, view: View, look: Look, rows: slice) -> Floats:
    """(h, W) linear luminance of some rows."""
    x, y = _pixels(view.width, rows)
    u, v = _squares(board, view, rows)
    light = look.around + _sheet(board, look, u, v)
    light *= 1.0 - look.shading * x / view.width
    if look.glare:
        square = (x - look.glare.x) ** 2 + (y - look.glare.y) ** 2
        light += look.glare.strength * np.exp(-0.5 * square / look.glare.radius_px**2)
    return light


def _pixels(width: int, rows: slice) -> tuple[Floats, Floats]:
    """Columns (W,) and rows (h, 1) of some rows' pixels."""
    return np.arange(width, dtype=float), np.arange(rows.start, rows.stop, dtype=float)[:, None]


@lru_cache(maxsize=3)  # the same camera takes many photographs, and a decentred lens is slow
def _ideal(width: int, first: int, last: int, K: tuple[float, ...], lens: Distortion) -> Floats:
    """(h, W, 2) where a pinhole would image what some rows of pixels show; NaN for nothing."""
    x, y = _pixels(width, slice(first, last))
    fx, fy, cx, cy = K
    flat = np.meshgrid((x - cx) / fx, (y[:, 0] - cy) / fy)
    return undistort(np.stack(flat, axis=-1), lens)[0]


def _squares(board: Board, view: View, rows: slice) -> tuple[Floats, Floats]:
    """Places (h, W) on the board in squares from its outer corner; NaN where there is none."""
    K = (view.K[0, 0], view.K[1, 1], view.K[0, 2], view.K[1, 2])
    ideal = _ideal(view.width, rows.start, rows.stop, tuple(map(float, K)), view.lens)
    pose = view.board_to_camera
    to_board = np.linalg.inv(pose[:3, [0, 1, 3]])
    place = ideal @ to_board[:, :2].T + to_board[:, 2]
    with np.errstate(divide="ignore", invalid="ignore"):
        in_front = place[..., 2] * np.linalg.det(to_board) * np.linalg.det(pose[:3, [0, 1, 3]]) > 0
        u, v = (
            np.where(in_front, place[..., axis] / place[..., 2], np.nan) / board.side_mm + 1.0
            for axis in range(2)
        )
    return u, v


def _sheet(board: Board, look: Look, u: Floats, v: Floats) -> Floats:
    """(h, W) what the sheet adds to the light around it."""
    steps = [np.gradient(along) for along in (u, v)]
    known = np.isfinite(sum(step for pair in steps for step in pair))
    u, v = (np.where(known, along, -FAR) for along in (u, v))
    steps = [[np.where(known, step, 1.0) for step in pair] for pair in steps]
    scale = [look.blur_px * np.maximum(np.hypot(*step), 1e-12) for step in steps]
    lean = (steps[0][0] * steps[1][0] + steps[0][1] * steps[1][1]) * (
        look.blur_px**2 / (scale[0] * scale[1])
    )
    light = (look.paper - look.around) * _inside(u, -1.0, board.across + 1.0, scale[0])
    light *= _inside(v, -1.0, board.down + 1.0, scale[1])
    squares = _inside(u, 0.0, board.across, scale[0]) * _inside(v, 0.0, board.down, scale[1])
    light -= (look.paper - look.ink) * squares * (0.5 + 0.5 * _pattern(board, u, v, scale, lean))
    return np.where(known, light, 0.0)


def _inside(along: Floats, low: float, high: float, scale: Floats) -> Floats:
    return 0.5 * (blurred_edge((along - low) / scale) - blurred_edge((along - high) / scale))


def _pattern(board: Board, u: Floats, v: Floats, scale: list[Floats], lean: Floats) -> Floats:
    """(h, W) 1 on dark squares, −1 on light ones; exact where one edge of each family is near.

    The lines between squares alternate in sign; the border is no such line, so that `_inside` alone
    draws it.
    """
    line_u = np.clip(np.rint(u), 1.0, board.across - 1.0)
    line_v = np.clip(np.rint(v), 1.0, board.down - 1.0)
    h, k = (u - line_u) / scale[0], (v - line_v) / scale[1]
    signs = 1.0 - 2.0 * ((line_u + line_v) % 2.0)
    pattern = np.sign(h) * np.sign(k)
    edge = (np.abs(h) < FAR) | (np.abs(k) < FAR)
    pattern[edge] = blurred_edge(h[edge]) * blurred_edge(k[edge])
    corner = (np.abs(h) < FAR) & (np.abs(k) < FAR)
    pattern[corner] = blurred_corner(h[corner], k[corner], lean[corner])
    return signs * pattern
