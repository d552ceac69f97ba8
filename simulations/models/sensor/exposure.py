"""The mean of a moving picture over the exposure, from pictures at single moments.

The exposure lasts from time 0 to 1. A closed form of the mean, if known, is faster and exact; these
methods need only the picture at a moment. Szeliski, 2nd ed., section 2.3.1.
"""

from collections.abc import Callable, Iterator

import numpy as np

from simulations.models.arrays import Floats, as_floats
from simulations.models.require import as_whole


def mean_of_instants(picture_at: Callable[[float], Floats], count: int) -> Floats:
    """Mean of ``count`` pictures, each for the middle of an equal share of the exposure.

    The error falls with 1/count and shows as ``count`` ghosts of every moving edge.
    """
    count = as_whole("count", count, 1)
    times = (np.arange(count) + 0.5) / count
    return _mean(picture_at(time) for time in times.tolist())


def mean_of_random_instants(
    picture_at: Callable[[Floats], Floats],
    count: int,
    shape: tuple[int, ...],
    rng: np.random.Generator,
) -> Floats:
    """Mean of ``count`` pictures in which every pixel has its own random time, uniform and
    independent.

    ``picture_at`` takes the times of all pixels, of ``shape``. The error falls only with the root
    of the count, and shows as grain instead of ghosts.
    """
    count = as_whole("count", count, 1)
    return _mean(picture_at(rng.random(shape)) for _ in range(count))


def mean_of_jittered_instants(
    picture_at: Callable[[Floats], Floats],
    count: int,
    shape: tuple[int, ...],
    rng: np.random.Generator,
) -> Floats:
    """Mean of ``count`` pictures: each pixel has a random time in each equal share of the exposure.

    ``picture_at`` takes the times of all pixels, of ``shape``. Grain as from independent times, but
    less of it. Cook, Porter and Carpenter, "Distributed ray tracing", SIGGRAPH 1984.
    """
    count = as_whole("count", count, 1)
    return _mean(picture_at((share + rng.random(shape)) / count) for share in range(count))


def _mean(pictures: Iterator[Floats]) -> Floats:
    """Mean of pictures, of which only one is in memory at a time."""
    total, count = as_floats(next(pictures)).copy(), 1  # sums of whole codes would wrap around
    for picture in pictures:
        total += picture
        count += 1
    return total / count
