"""Resampling: twelve turns by 30° bring a picture back to where it was, if less sharp.

Fidelity alone would rank a crude copy of the nearest pixel above linear interpolation, which
blurs a little with every turn; so the contrast that is left of fine detail is measured too.
"""

from dataclasses import dataclass
from functools import partial

import numpy as np

from simulations.engine.ladder import Ladder, Metric, Tier
from simulations.models.arrays import Floats
from simulations.models.error_measures import psnr_db
from simulations.models.pixel_grid import centred
from simulations.models.sampling.resampling import gather, gather_table

SIZE = 128
CENTRE = (SIZE - 1) / 2
TURNS = 12
TURN_RAD = 2 * np.pi / TURNS
JUDGED_RADIUS_PX, FADE_PX = 52.0, 16.0
"""Detail fades out from here, so that the kernels' edges meet flat grey and no corner is lost."""

FINE = slice(6, 12)
"""Which of the waves count as fine: 0.21 to 0.35 cycles per pixel."""
FREQUENCIES = np.array([0.02, 0.03, 0.05, 0.08, 0.11, 0.15, 0.21, 0.24, 0.27, 0.30, 0.33, 0.35])
"""Of the plane waves that make up the picture: cycles per pixel."""
GOLDEN_RAD = np.pi * (3 - np.sqrt(5))
"""Angle from one wave to the next: all directions are served evenly."""


@dataclass(frozen=True, slots=True)
class Workload:
    """A picture, and where each pixel of the turned picture comes from."""

    picture: Floats
    """(128, 128) float32, in [0, 1]."""
    source_px: Floats
    """(128, 128, 2) positions (x, y)."""


@dataclass(frozen=True, slots=True)
class Turned:
    """The picture on its way round."""

    once: Floats
    """(128, 128) after a single turn."""
    round: Floats
    """(128, 128) after the full circle."""


def prepare() -> Workload:
    x, y = _grid()
    cos, sin = np.cos(TURN_RAD), np.sin(TURN_RAD)
    source = np.stack([cos * x - sin * y, sin * x + cos * y], axis=-1) + CENTRE
    return Workload(_picture(x, y).astype(np.float32), source)


def _grid() -> tuple[Floats, Floats]:
    """Position of each pixel from the centre."""
    along = centred(SIZE)
    x, y = np.meshgrid(along, along)
    return x, y


def _picture(x: Floats, y: Floats) -> Floats:
    """Waves under a round window: the value at any place, between pixels too."""
    total: Floats = sum(_waves(x, y), start=np.zeros_like(x))
    return 0.5 + _window(x, y) * total / (2 * len(FREQUENCIES)) * 1.3


def _waves(x: Floats, y: Floats) -> list[Floats]:
    """One wave per frequency; together they are bounded by their number."""
    return [
        np.cos(2 * np.pi * f * (x * np.cos(n * GOLDEN_RAD) + y * np.sin(n * GOLDEN_RAD)) + n)
        for n, f in enumerate(FREQUENCIES)
    ]


def _window(x: Floats, y: Floats) -> Floats:
    """1 within the judged radius, then half a cosine down to 0: smooth, so band-limited."""
    beyond = np.clip((np.hypot(x, y) - (JUDGED_RADIUS_PX - FADE_PX)) / FADE_PX, 0.0, 1.0)
    return 0.5 + 0.5 * np.cos(np.pi * beyond)


def _turn(workload: Workload, *, kernel: str) -> Turned:
    """One table, used twelve times over. In it rows and columns have weights of their own, so that
    every kernel takes as few products as it can."""
    table = gather_table(workload.source_px, (SIZE, SIZE), kernel, np.float32)
    once = gather(table, workload.picture, fill=0.5)
    picture = once
    for _ in range(TURNS - 1):
        picture = gather(table, picture, fill=0.5)
    return Turned(once, picture)


def reference(workload: Workload) -> Turned:
    """The formula at turned places, and the picture itself, to which a full circle leads back."""
    return Turned(
        _picture(*np.moveaxis(workload.source_px - CENTRE, -1, 0)), workload.picture.astype(float)
    )


def _psnr_inside_db(picture: Floats, truth: Floats) -> float:
    """Within the judged circle only."""
    inside = np.hypot(*_grid()) < JUDGED_RADIUS_PX
    return psnr_db(picture[inside], truth[inside])


def psnr_once(result: Turned, truth: Turned, _workload: Workload) -> float:
    return _psnr_inside_db(result.once, truth.once)


def psnr_round(result: Turned, truth: Turned, _workload: Workload) -> float:
    return _psnr_inside_db(result.round, truth.round)


def fine_contrast(result: Turned, _truth: Turned, workload: Workload) -> float:
    """Share of the fine waves' amplitude that the full circle leaves, by regression."""
    x, y = _grid()
    probe = _window(x, y) * sum(_waves(x, y)[FINE], start=np.zeros_like(x))
    kept = np.sum(probe * (result.round - 0.5))
    return float(100 * kept / np.sum(probe * (workload.picture - 0.5)))


LADDER = Ladder(
    id="resampling",
    title="Interpolation between pixels",
    workload="128 × 128 pixels of waves up to 0.35 cycles a pixel, turned twelve times by 30°",
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
    reference_label="the formula of the picture, evaluated at the turned positions",
    metrics=(
        Metric("psnr-once", "PSNR after one turn", "dB", psnr_once, higher_is_better=True),
        Metric("psnr-round", "PSNR after twelve turns", "dB", psnr_round, higher_is_better=True),
        Metric(
            "contrast", "Contrast left of fine detail", "%", fine_contrast, higher_is_better=True
        ),
    ),
    default_tier="spline",
)
