"""The mean of a moving picture over the time that the shutter is open, by single moments of it.

Time runs from 0 to 1, the exposure. Where a closed form of the mean is known it is quicker and
exact; these need nothing but the picture at one moment. Szeliski, 2nd ed., section 2.3.1.
"""

from collections.abc import Callable, Iterator

import numpy as np

from simulations.models.arrays import Floats, as_floats
from simulations.models.whole_numbers import as_whole


def mean_of_instants(picture_at: Callable[[float], Floats], count: int) -> Floats:
    """Mean of ``count`` pictures, each for the middle of an equal share of the exposure.

    The error falls with 1/count and shows as that many ghosts of every edge that moves.
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
    """Mean of ``count`` pictures for which every pixel draws its own time, uniform and independent.

    ``picture_at`` takes the times of all pixels, of ``shape``. The error falls with the root of
    the count only, and shows as grain instead of ghosts.
    """
    count = as_whole("count", count, 1)
    return _mean(picture_at(rng.random(shape)) for _ in range(count))


def mean_of_jittered_instants(
    picture_at: Callable[[Floats], Floats],
    count: int,
    shape: tuple[int, ...],
    rng: np.random.Generator,
) -> Floats:
    """Mean of ``count`` pictures: each pixel draws a time of its own in each equal share of it all.

    ``picture_at`` takes the times of all pixels, of ``shape``. Grain as from independent times, but
    less of it. Cook, Porter and Carpenter, "Distributed ray tracing", SIGGRAPH 1984.
    """
    count = as_whole("count", count, 1)
    return _mean(picture_at((share + rng.random(shape)) / count) for share in range(count))


def _mean(pictures: Iterator[Floats]) -> Floats:
    """Of one picture or more, of which only one is kept at a time."""
    total, count = as_floats(next(pictures)).copy(), 1  # sums of whole codes would wrap around
    for picture in pictures:
        total += picture
        count += 1
    return total / count
