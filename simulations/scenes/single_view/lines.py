"""The lines over a picture, and the book's two pictures of a room with lines drawn in them."""

import math
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from simulations.engine.controls import PointLists
from simulations.engine.photograph import Photograph
from simulations.engine.settings import action, choice, points, slider, toggle
from simulations.models.arrays import Floats
from simulations.models.geometry.rotations import exponential
from simulations.models.projection.pinhole import intrinsics, project
from simulations.pictures.checker_room import HIGH, LOW, TRIM_M, WINDOW

LISTS = {
    "across": "Lines across the room",
    "along": "Lines along the room",
    "upright": "Uprights",
    "floor": "Lengths on the plane",
    "height": "Heights above the plane",
}
"""The lists of lines. The first three are those of the axes 0, 1 and 2."""
UPRIGHT, FLOOR, HEIGHT = 2, 3, 4  # numbers of lists
MOST = 6  # lines of a list
PLANES = {"floor": "Floor", "along": "Wall along the room", "across": "Wall across it"}
CALIBRATIONS = {"same": "If files name the same camera", "any": "Yes", "none": "No"}
TAKES = 20
READER_PICTURE = "own"  # name of the reader's photograph among the pictures
FIRST_SEED = 14  # of which the first draw is an ordinary one

SIZE = (800, 600)  # width and height of the book's pictures in pixels
FOCAL_PX = 480.0
SAMPLES = {f"true f {FOCAL_PX:.0f} px, room.png": "corner"}
"""The book's pictures that serve as samples of a reader's, by the names of their files."""
EYE_M = HIGH[1]  # height of the camera above the floor
AXES = np.array([(1.0, 0.0, 0.0), (0.0, 0.0, 1.0), (0.0, -1.0, 0.0)])
"""The axes across, along and upwards, in the room's: x right, y down, z away from the eye."""

type End = tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class Settings:
    picture: str = choice("Picture", {"corner": "Into a corner", "front": "Straight on"})
    direction: str = choice("Draw", LISTS, default="along")
    lines: str = points(
        "Lines", len(LISTS), 2 * MOST, buttons={"add": "Add a line", "clear": "Clear"}
    )
    all_lines: bool = toggle("Lines of all directions")
    sigma: float = slider("Error of an end point", 1.0, 0.5, 10.0, 0.5, unit="px")
    known: float = slider("Known length", 2.0, 0.05, 20.0, 0.01, unit="m")
    plane: str = choice("Plane of the lengths", PLANES)
    centre: bool = toggle("Find the principal point too")
    calibration: str = choice("Use the lens calibrated on this page", CALIBRATIONS)
    take: int = action(*("Draw the lines anew",) * TAKES)


@dataclass(frozen=True, slots=True)
class Room:
    """A picture of the room, and lines and lengths in it, in metres from the eye."""

    turn: Floats
    """(3, 3) from the room's axes to the camera's."""
    lines: tuple[tuple[tuple[End, End], ...], ...]
    """Lines of each of `LISTS`; the first length is the known one."""

    @property
    def drawn(self) -> tuple[Floats, ...]:
        """The ends (N, 2, 2) of the lines of each list in the picture, without noise, in pixels."""
        K = intrinsics(FOCAL_PX, ((SIZE[0] - 1) / 2, (SIZE[1] - 1) / 2))
        return tuple(
            project(np.array(each, float).reshape(-1, 2, 3) @ self.turn.T, K)[0]
            for each in self.lines
        )

    def metres(self, number: int) -> tuple[float, ...]:
        """The true lengths of a list."""
        return tuple(math.dist(*line) for line in self.lines[number])


def _turned(yaw_deg: float, pitch_deg: float, roll_deg: float) -> Floats:
    """A turn (3, 3) to the right, then downwards, then leaning to the right."""
    yaw, pitch, roll = map(math.radians, (yaw_deg, pitch_deg, roll_deg))
    tilted = exponential((0.0, 0.0, -roll)) @ exponential((pitch, 0.0, 0.0))
    return np.asarray(tilted @ exponential((0.0, -yaw, 0.0)))


LEFT = LOW[0]
RIGHT, GROUND, BACK = HIGH
SKIRTING = GROUND - TRIM_M  # upper edge of the moulding along the floor
RAIL = 0.56  # upper edge of the rail above the panels
FRAME_TOP = -0.95  # of the pictures on the right wall

ROOMS = {
    # It shows three vanishing points.
    "corner": Room(
        _turned(33.0, 21.0, 2.0),
        (
            (
                ((-0.1, RAIL, BACK), (2.6, RAIL, BACK)),
                ((-0.4, SKIRTING, BACK), (2.0, SKIRTING, BACK)),
                ((0.0, GROUND, 3.75), (2.5, GROUND, 3.75)),
                ((0.5, GROUND, 1.75), (2.5, GROUND, 1.75)),
            ),
            (
                ((RIGHT, RAIL, 1.9), (RIGHT, RAIL, 5.0)),
                ((RIGHT, SKIRTING, 1.7), (RIGHT, SKIRTING, 4.1)),
                ((1.5, GROUND, 1.25), (1.5, GROUND, 4.25)),
                ((0.0, GROUND, 2.25), (0.0, GROUND, 4.75)),
            ),
            (
                ((RIGHT, -0.75, 3.3), (RIGHT, 0.15, 3.3)),
                ((RIGHT, -0.5, 2.15), (RIGHT, 0.15, 2.15)),
                ((2.2, -0.8, BACK), (2.2, 0.2, BACK)),
                ((WINDOW[1], -0.9, BACK), (WINDOW[1], 0.38, BACK)),
            ),
            (
                ((0.5, GROUND, 2.25), (2.5, GROUND, 2.25)),
                ((0.5, GROUND, 4.75), (2.0, GROUND, 2.75)),
            ),
            (((RIGHT, GROUND, 4.45), (RIGHT, FRAME_TOP, 4.45)),),
        ),
    ),
    # Of its three vanishing points, one is in the middle and two are at infinity.
    "front": Room(
        _turned(0.0, 0.0, 0.0),
        (
            (
                ((-2.0, RAIL, BACK), (2.4, RAIL, BACK)),
                ((-2.0, SKIRTING, BACK), (2.4, SKIRTING, BACK)),
                ((-0.9, WINDOW[2], BACK), (0.6, WINDOW[2], BACK)),
                ((-1.75, GROUND, 3.25), (1.75, GROUND, 3.25)),
            ),
            (
                ((LEFT, RAIL, 3.2), (LEFT, RAIL, 5.0)),
                ((RIGHT, RAIL, 3.8), (RIGHT, RAIL, 5.0)),
                ((-0.5, GROUND, 2.75), (-0.5, GROUND, 4.75)),
                ((1.5, GROUND, 2.75), (1.5, GROUND, 4.75)),
            ),
            (
                ((WINDOW[0], -1.1, BACK), (WINDOW[0], 0.3, BACK)),
                ((WINDOW[1], -1.1, BACK), (WINDOW[1], 0.3, BACK)),
                ((2.2, -0.8, BACK), (2.2, 0.2, BACK)),
                ((RIGHT, -0.9, 3.75), (RIGHT, 0.1, 3.75)),
            ),
            (
                ((-1.5, GROUND, 3.75), (0.5, GROUND, 3.75)),
                ((1.5, GROUND, 3.25), (1.5, GROUND, 4.75)),
                ((-0.5, GROUND, 2.75), (1.0, GROUND, 2.75)),
            ),
            (((RIGHT, GROUND, 4.45), (RIGHT, FRAME_TOP, 4.45)),),
        ),
    ),
}


@dataclass(frozen=True, slots=True)
class Lines:
    """The lines over a picture."""

    size: tuple[int, int]
    """Width and height of the picture in pixels."""
    points: PointLists
    ends: tuple[Floats, ...]
    """(N, 2, 2) pixels, for each list."""
    placed: tuple[Floats, ...]
    """(N,) bool, for each list: whether both ends have been put somewhere. Others do not count."""

    def counted(self, number: int) -> Floats:
        """The ends (N, 2, 2) of the lines of a list that count."""
        return self.ends[number][self.placed[number]]


def size_of(photograph: Photograph | None) -> tuple[int, int]:
    return SIZE if photograph is None else (photograph.codes.shape[1], photograph.codes.shape[0])


def current(
    lines: str, picture: str, sigma: float, take: int, photograph: Photograph | None
) -> PointLists:
    """The points of the settings if they lie in this picture; else the book's, or none in the
    reader's photograph, unless it is a sample."""
    found, name = PointLists.from_text(lines), READER_PICTURE if photograph else picture
    if lines and found.picture in (name, ""):
        missing = len(LISTS) - len(found.lists)
        return PointLists(name, found.touched, (*found.lists, *((),) * missing))
    room = SAMPLES.get(photograph.name) if photograph else picture
    if room is None:
        return PointLists(name, 0, ((),) * len(LISTS))
    return replace(_of_the_book(room, sigma, take), picture=name)


@lru_cache(maxsize=4)
def _of_the_book(picture: str, sigma: float, take: int) -> PointLists:
    """True lines with noise."""
    rng = np.random.default_rng(FIRST_SEED + take)
    lists = []
    for ends in ROOMS[picture].drawn:
        noisy = ends + sigma * rng.normal(size=ends.shape)
        shares = (noisy.reshape(-1, 2) + 0.5) / SIZE
        lists.append(tuple((float(x), float(y)) for x, y in np.clip(shares, 0.0, 1.0)))
    return PointLists(picture, 0, tuple(lists))


def drawn_lines(
    lines: str, picture: str, sigma: float, take: int, photograph: Photograph | None
) -> Lines:
    """The lines in pixels. An end without another is left out."""
    size, points = size_of(photograph), current(lines, picture, sigma, take, photograph)
    shares = [
        np.array(each[: len(each) // 2 * 2], float).reshape(-1, 2, 2) for each in points.lists
    ]
    placed = tuple(_placed(each, number) for number, each in enumerate(shares))
    return Lines(size, points, tuple(each * size - 0.5 for each in shares), placed)


def _placed(shares: Floats, number: int) -> Floats:
    starts = np.array([start_of(number, line) for line in range(len(shares))]).reshape(-1, 2, 2)
    untouched = (np.abs(shares - starts) < 1e-4).all(axis=-1).any(axis=-1)
    without_length = (shares[:, 0] == shares[:, 1]).all(axis=-1)
    return np.asarray(~(untouched | without_length))


def start_of(number: int, line: int) -> tuple[tuple[float, float], tuple[float, float]]:
    """The place of a new line before its ends are put in place."""
    across = 0.2 + 0.6 * line / (MOST - 1)
    if number in (UPRIGHT, HEIGHT):
        return (across, 0.65), (across, 0.35)
    return (0.35, across), (0.65, across)
