"""Boards cut off, mirrored, seen at a grazing angle or twice, and what only looks like a board."""

import numpy as np

from simulations.engine.hard_cases import HardCase, HardCases, exactly, refused
from simulations.models.chequerboard import find_board
from simulations.models.chequerboard.board import Board
from simulations.models.distortion.lens_model import Distortion
from simulations.models.geometry.rotations import exponential
from simulations.models.projection.pinhole import intrinsics
from simulations.pictures.chequerboard import Codes, Glare, Look, View, photograph_of

BOARD = Board(8, 5, 25.0)


def _photograph(
    tilt: tuple[float, float, float] = (0.2, -0.3, 0.1),
    distance_mm: float = 300.0,
    look: Look | None = None,
) -> Codes:
    """320 × 240 px, through a barrel lens."""
    pose = np.eye(4)
    pose[:3, :3] = exponential(np.array(tilt))
    pose[:3, 3] = np.array([0.0, 0.0, distance_mm]) - pose[:3, :3] @ [75.0, 37.5, 0.0]
    view = View(320, 240, intrinsics(300.0, (160.0, 120.0)), Distortion(k1=-0.3), pose)
    return photograph_of(BOARD, view, look)


def _waves() -> Codes:
    y, x = np.mgrid[:240, :320] / 5.0
    return np.rint(127.5 + 120.0 * np.sin(x) * np.sin(y)).astype(np.uint8)


def _woven() -> Codes:
    y, x = np.mgrid[:240, :320] // 12 % 2
    return (60 + 75 * (x + y)).astype(np.uint8)


SEEN = _photograph()

TABLE = HardCases(
    id="chequerboards",
    title="Chequerboards in photographs",
    names={
        **vars(find_board),
        "SEEN": SEEN,
        "GRAZING": _photograph((0.0, 1.35, 0.0), 220.0),
        "GLARED": _photograph(look=Look(glare=Glare(160.0, 120.0, 12.0))),
        "FAR": _photograph(distance_mm=1850.0),
        "SOFT": _photograph(look=Look(blur_px=8.0)),
        "WAVES": _waves(),
        "WOVEN": _woven(),
    },
    cases=(
        HardCase(
            id="one-pixel",
            call="find_board(np.zeros((1, 1, 3), np.uint8))",
            why="There is not even a neighbour to compare with.",
            returns="A refusal in words, as for every picture without a board.",
            expected=refused("No chequerboard"),
        ),
        HardCase(
            id="cut-off",
            call="find_board(SEEN[:, :180]).size",
            why="The right half of the board is beyond the border of the picture.",
            returns="The columns and rows in view, by which a camera can be calibrated too.",
            expected=exactly((4, 4)),
        ),
        HardCase(
            id="mirrored",
            call="find_board(SEEN[:, ::-1]).size",
            why="A selfie camera's mirror image of a chequerboard is a chequerboard.",
            returns="The same corners, numbered clockwise: nothing tells the two apart.",
            expected=exactly((7, 4)),
        ),
        HardCase(
            id="negative",
            call="find_board(255 - SEEN).size",
            why="Light and dark are exchanged, as on a screen in dark mode.",
            returns="The same corners: only the alternation counts.",
            expected=exactly((7, 4)),
        ),
        HardCase(
            id="grazing",
            call="find_board(GRAZING).size",
            why="The board leans by 77°; squares are four times as high as wide.",
            returns="All corners: neighbours are found along edges, at whatever angle these meet.",
            expected=exactly((7, 4)),
        ),
        HardCase(
            id="glare",
            call="len(find_board(GLARED).places)",
            why="A lamp on the paper outshines some corners in the middle of the board.",
            returns="The corners around it, with the numbers that they would have without it.",
            expected=lambda got: 16 <= got < 28,
        ),
        HardCase(
            id="two-boards",
            call="find_board(np.hstack([SEEN, SEEN]))",
            why="Which one is meant?",
            returns="A refusal, since a calibration takes each photograph to show one.",
            expected=refused("Two chequerboards"),
        ),
        HardCase(
            id="too-far",
            call="find_board(FAR)",
            why="Squares are hardly wider than the blur of a lens.",
            returns="A refusal, with what to do.",
            expected=refused("closer"),
        ),
        HardCase(
            id="out-of-focus",
            call="find_board(SOFT)",
            why="The blur is wider than half a square.",
            returns="A refusal that says how wide it is.",
            expected=refused("blurred"),
        ),
        HardCase(
            id="waves",
            call="find_board(WAVES)",
            why="sin x · sin y has saddles in a perfect grid, and no edges.",
            returns="A refusal: edges so soft would be blurred over a third of a square.",
            expected=refused("blurred"),
        ),
        HardCase(
            id="woven-check",
            call="find_board(WOVEN)",
            why="Gingham: light, dark and two half-tones repeat like the squares of a board.",
            returns="A refusal: at the corners of a board only two tones meet.",
            expected=refused("No chequerboard"),
        ),
    ),
)
