"""Resampling: pictures rotated twelve times by an angle that never maps the grid to itself.

The angle matters. Three rotations by 30°, or two by 45°, map the grid to itself: the nearest
neighbour then returns pixels to their own place, again in each further round, and the sum of twelve
displacements is smaller than by chance. With 33° the displacements add up like steps in random
directions.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np

from simulations.engine.ladder import DRAWS, Ladder, Metric, Tier
from simulations.models.arrays import Floats
from simulations.models.error_measures import psnr_db
from simulations.models.sampling.fine_detail import FineDetail, fine_detail
from simulations.models.sampling.resampling import gather, gather_table
from simulations.pictures.round_windows import (
    INSIDE,
    PICTURES,
    SIZE,
    TURN_RAD,
    TURNS,
    pictures_at,
    places,
)

CENTRE = (SIZE - 1) / 2


@dataclass(frozen=True, slots=True)
class Workload:
    """Pictures, and the source place of each pixel of the rotated ones."""

    pictures: Floats
    """(128, 128, 3) float32, in [0, 1]: waves, rings and discs."""
    source_px: Floats
    """(128, 128, 2) positions (x, y)."""
    turn_rad: float
    """Angle of one turn."""


@dataclass(frozen=True, slots=True)
class Turned:
    """The pictures after some rotations, (128, 128, 3) each."""

    once: Floats
    often: Floats
    """After all turns."""


def prepare(turn_rad: float = TURN_RAD) -> Workload:
    """The ladder's workload; tests use other angles too."""
    source = np.stack(places(turn_rad), axis=-1) + CENTRE
    return Workload(pictures_at(*places()).astype(np.float32), source, turn_rad)


def draw(index: int) -> Workload:
    """Turns by 20° to 43°, of the same pictures: 30°, which maps the grid to itself after three
    turns, is passed over."""
    angles = np.delete(np.linspace(20.0, 43.0, DRAWS + 3), slice(27, 30))
    return prepare(float(np.deg2rad(angles[index])))


def _turn(workload: Workload, *, kernel: str) -> Turned:
    """One table, applied twelve times, with separate weights for rows and columns, which needs the
    fewest products."""
    table = gather_table(workload.source_px, (SIZE, SIZE), kernel, np.float32)
    once = gather(table, workload.pictures, fill=0.5)
    pictures = once
    for _ in range(TURNS - 1):
        pictures = gather(table, pictures, fill=0.5)
    return Turned(once, pictures)


def reference(workload: Workload) -> Turned:
    """The formulae of the pictures at places rotated by one and by twelve angles."""
    turn = workload.turn_rad
    return Turned(pictures_at(*places(turn)), pictures_at(*places(TURNS * turn)))


def _psnr(pictures: Floats, truth: Floats) -> float:
    """The error of all pictures together, within the window."""
    return psnr_db(pictures[INSIDE], truth[INSIDE])


def psnr_each(pictures: Floats, truth: Floats) -> list[float]:
    """The error of each picture."""
    return [_psnr(pictures[..., n], truth[..., n]) for n in range(len(PICTURES))]


def detail_each(result: Turned, truth: Turned) -> list[FineDetail]:
    """The fine detail of each picture that is left after all rotations."""
    return [fine_detail(result.often[..., n], truth.often[..., n]) for n in range(len(PICTURES))]


def _psnr_once(result: Turned, truth: Turned, _workload: Workload) -> float:
    return _psnr(result.once, truth.once)


def _psnr_often(result: Turned, truth: Turned, _workload: Workload) -> float:
    return _psnr(result.often, truth.often)


def _share(of: Callable[[FineDetail], float]) -> Callable[[Turned, Turned, Workload], float]:
    """In per cent, as the mean over the pictures."""

    def measure(result: Turned, truth: Turned, _workload: Workload) -> float:
        return float(100 * np.mean([of(each) for each in detail_each(result, truth)]))

    return measure


def _better(id: str, label: str, unit: str, measure: Callable[..., float]) -> Metric:
    return Metric(id, label, unit, measure, higher_is_better=True)


LADDER = Ladder(
    id="resampling",
    title="Interpolation between pixels",
    workload="waves, rings and discs, on 128 × 128 pixels each, turned twelve times by 33°",
    prepare=prepare,
    tiers=tuple(
        Tier(kernel, label, cost, partial(_turn, kernel=kernel))
        for kernel, label, cost in (
            ("nearest", "Nearest", "1 tap a pixel"),
            ("bilinear", "Bilinear", "4 taps a pixel"),
            ("bicubic", "Bicubic", "16 taps a pixel"),
            ("spline", "Cubic B-spline", "16 taps a pixel, 20 sums to pre-filter"),
            ("lanczos3", "Lanczos-3", "36 taps a pixel"),
        )
    ),
    reference=reference,
    reference_label="the formulae of the pictures, evaluated at the turned positions",
    metrics=(
        _better("psnr-once", "PSNR after one turn", "dB", _psnr_once),
        _better("psnr-often", "PSNR after twelve turns", "dB", _psnr_often),
        _better("in-place", "Fine detail left in its place", "%", _share(lambda d: d.in_place)),
        _better("present", "Fine detail present anywhere", "%", _share(lambda d: d.present)),
    ),
    default_tier="spline",
    draw=draw,
    items=589_824,
)
