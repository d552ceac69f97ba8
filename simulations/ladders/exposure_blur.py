"""Motion blur: the mean of many instants, a blurred picture, or the time integral."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np

from simulations.engine.ladder import Ladder, Metric, Tier
from simulations.models.arrays import Floats, Mask
from simulations.models.error_measures import root_mean_square
from simulations.models.sensor.exposure import (
    mean_of_instants,
    mean_of_jittered_instants,
    mean_of_random_instants,
)
from simulations.pictures import moving_ball

type MeanOfInstants = Callable[
    [Callable[[Floats], Floats], int, tuple[int, ...], np.random.Generator], Floats
]
"""A mean of ``count`` pictures, given the picture as a function of the times of all pixels."""


@dataclass(frozen=True, slots=True)
class Workload:
    """Pixel centres."""

    x: Floats
    """(1, 160)."""
    y: Floats
    """(96, 1)."""
    seed: int
    """Of the instants that are drawn."""


@dataclass(frozen=True, slots=True)
class Truth:
    """The exposure, and the pixels that are compared."""

    picture: Floats
    """(96, 160)."""
    swept: Mask
    """(96, 160) pixels that the ball covers at some time."""


def prepare() -> Workload:
    return Workload(*moving_ball.grid(), seed=11)


def draw(index: int) -> Workload:
    """Other seeds, and other places of the ball and the wall on the grid."""
    x, y = moving_ball.grid()
    right, down = np.random.default_rng(index).uniform(-6.0, 6.0, 2)
    return Workload(x + right, y + down, seed=index)


def _instants(workload: Workload, *, count: int) -> Floats:
    behind = moving_ball.wall(workload.x, workload.y)
    return mean_of_instants(
        lambda time: moving_ball.instant(workload.x, workload.y, time, behind), count
    )


def _instants_per_pixel(workload: Workload, *, mean: MeanOfInstants, count: int) -> Floats:
    """Every pixel has its own random instants."""
    shape = (moving_ball.HEIGHT, moving_ball.WIDTH)
    rng = np.random.default_rng(workload.seed)
    behind = moving_ball.wall(workload.x, workload.y)
    return mean(
        lambda times: moving_ball.instant(workload.x, workload.y, times, behind), count, shape, rng
    )


def _smear(workload: Workload) -> Floats:
    """The picture at half time, averaged along the motion where it shows the ball.

    The mean over a range of pixels is a difference of running sums, interpolated between pixels.
    """
    behind = moving_ball.wall(workload.x, workload.y)
    still = moving_ball.instant(workload.x, workload.y, 0.5, behind)
    sums = np.pad(np.cumsum(still, axis=1), ((0, 0), (1, 0)))
    first, last = (
        _between_columns(sums, workload.x[0] + 0.5 + side * 0.5 * moving_ball.TRAVEL)
        for side in (-1, 1)
    )
    moving = moving_ball.on_ball(workload.x, workload.y, 0.5)
    return np.where(moving, (last - first) / moving_ball.TRAVEL, still)


def _between_columns(rows: Floats, places: Floats) -> Floats:
    """Every row (H, W) at the same ``places`` (n,) along it, by linear interpolation."""
    at = np.clip(places, 0, rows.shape[1] - 1)
    left = np.minimum(at.astype(np.intp), rows.shape[1] - 2)
    share = at - left
    return rows[:, left] * (1 - share) + rows[:, left + 1] * share


def _integral(workload: Workload) -> Floats:
    return moving_ball.exposed(workload.x, workload.y)


def reference(workload: Workload) -> Truth:
    """The exact mean, from all moments in order at which a pixel changes; it is constant in
    between."""
    x, y = workload.x.ravel(), workload.y.ravel()
    offset, height = np.broadcast_arrays(x - 58.1, y[:, None] - 47.3)
    half_chord = np.sqrt(np.clip(30.7**2 - height**2, 0.0, None))
    borders = [np.full_like(offset, border) for border in np.arange(-28.0, 29.0, 8.0)]
    places = np.array([half_chord, -half_chord, *borders])  # on the ball, from its centre
    changes = np.clip((offset - places) / 37.3, 0.0, 1.0)
    ends = np.array([np.zeros_like(offset), np.ones_like(offset)])
    times = np.sort(np.concatenate([ends, changes]), axis=0)
    along = offset - 37.3 * (times[1:] + times[:-1]) / 2
    inside = np.abs(along) < half_chord
    light_bar = np.abs((along + 4.0) % 16.0 - 4.0) < 4.0
    light_tile = (x // 12 % 2) == (y[:, None] // 12 % 2)
    value = np.where(inside, np.where(light_bar, 0.9, 0.25), np.where(light_tile, 0.55, 0.1))
    lasting = np.diff(times, axis=0)
    return Truth((value * lasting).sum(axis=0), (inside * lasting).sum(axis=0) > 0)


def rms(result: Floats, truth: Truth, _workload: Workload) -> float:
    return root_mean_square((result - truth.picture)[truth.swept])


def worst(result: Floats, truth: Truth, _workload: Workload) -> float:
    return float(np.abs(result - truth.picture).max())


def _instants_tier(count: int) -> Tier:
    label = f"{count} instants" if count > 1 else "One instant"
    cost = f"{count} picture{'s' if count > 1 else ''}"
    return Tier(f"instants-{count}", label, cost, partial(_instants, count=count))


LADDER = Ladder(
    id="exposure-blur",
    title="Motion blur",
    workload="160 × 96 pixels: a striped ball moves by 37.3 pixels before a still wall",
    prepare=prepare,
    tiers=(
        _instants_tier(1),
        Tier("integral", "Integral over time", "1 interval a pixel", _integral),
        _instants_tier(4),
        Tier("smear", "One instant, smeared", "1 picture, 1 running sum", _smear),
        _instants_tier(16),
        Tier(
            "random-16",
            "16 independent instants",
            "16 pictures",
            partial(_instants_per_pixel, mean=mean_of_random_instants, count=16),
        ),
        Tier(
            "jittered-16",
            "16 instants, one in each share",
            "16 pictures",
            partial(_instants_per_pixel, mean=mean_of_jittered_instants, count=16),
        ),
        _instants_tier(64),
    ),
    reference=reference,
    reference_label="all moments of change of each pixel, sorted and summed",
    metrics=(
        Metric("rms", "RMS error where the ball passes", "of range", rms),
        Metric("worst", "Largest error", "of range", worst),
    ),
    default_tier="integral",
    draw=draw,
    items=15_360,
    sampled=("random-16", "jittered-16", "instants-4", "instants-16", "instants-64"),
)
