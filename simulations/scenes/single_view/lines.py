"""The lines over a picture: those of the settings, else the book's, in pixels and as points."""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from simulations.engine.controls import PointLists
from simulations.engine.photograph import Photograph
from simulations.models.arrays import Floats
from simulations.scenes.single_view.room import ROOMS, SIZE
from simulations.scenes.single_view.settings import LISTS, MOST

OWN = "own"
"""Name of the reader's photograph among the pictures."""
UPRIGHT, FLOOR, HEIGHT = 2, 3, 4
"""Numbers of lists."""
FIRST_SEED = 14  # of which the first draw is an ordinary one


@dataclass(frozen=True, slots=True)
class Drawn:
    """What is drawn over a picture."""

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
    reader's photograph."""
    found, name = PointLists.from_text(lines), OWN if photograph else picture
    if lines and found.picture in (name, ""):
        missing = len(LISTS) - len(found.lists)
        return PointLists(name, found.touched, (*found.lists, *((),) * missing))
    return (
        PointLists(name, 0, ((),) * len(LISTS)) if photograph else _of_the_book(name, sigma, take)
    )


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


def drawn(
    lines: str, picture: str, sigma: float, take: int, photograph: Photograph | None
) -> Drawn:
    """The lines in pixels. An end without another is left out."""
    size, points = size_of(photograph), current(lines, picture, sigma, take, photograph)
    shares = [
        np.array(each[: len(each) // 2 * 2], float).reshape(-1, 2, 2) for each in points.lists
    ]
    return Drawn(
        size,
        points,
        tuple(each * size - 0.5 for each in shares),
        tuple(_placed(each, number) for number, each in enumerate(shares)),
    )


def _placed(shares: Floats, number: int) -> Floats:
    starts = np.array([start_of(number, line) for line in range(len(shares))]).reshape(-1, 2, 2)
    untouched = (np.abs(shares - starts) < 1e-4).all(axis=-1).any(axis=-1)
    without_length = (shares[:, 0] == shares[:, 1]).all(axis=-1)
    return np.asarray(~(untouched | without_length))


def start_of(number: int, line: int) -> tuple[tuple[float, float], tuple[float, float]]:
    """Where a new line lies before its ends are put in place."""
    across = 0.2 + 0.6 * line / (MOST - 1)
    if number in (UPRIGHT, HEIGHT):
        return (across, 0.65), (across, 0.35)
    return (0.35, across), (0.65, across)
