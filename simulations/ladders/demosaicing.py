"""Demosaicing: four ways to guess the missing colours, tried on three kinds of picture.

The methods that let the colours help one another win where edges lie at the same place in all
three, as they do in most photographs, and lose where they do not.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray

from simulations.engine.ladder import Ladder, Metric, Tier
from simulations.models.demosaicing import demosaic, mosaic, psnr_db
from simulations.pictures.balloon import balloon
from simulations.pictures.checker_room import checker_room

type Floats = NDArray[np.floating]

WIDTH, HEIGHT, FOCAL_PX = 240, 192, 170.0
SOFT_PERIOD_PX = 12.0
ROOM, BALLOON, SOFT = 0, 1, 2


@dataclass(frozen=True, slots=True)
class Workload:
    """The pictures, and what a Bayer sensor kept of them."""

    pictures: tuple[Floats, ...]
    """Each (192, 240, 3), linear, float32: the room, the balloon, soft colours."""
    mosaics: tuple[Floats, ...]
    """Each (192, 240)."""


def prepare() -> Workload:
    pictures = (checker_room(WIDTH, HEIGHT, FOCAL_PX), balloon(), _soft_colours())
    return Workload(pictures, tuple(mosaic(picture) for picture in pictures))


def _soft_colours() -> Floats:
    """Smooth waves that run another way in each colour: nothing to be learnt from the others."""
    x, y = np.meshgrid(np.arange(WIDTH, dtype=float), np.arange(HEIGHT, dtype=float))
    waves = [
        0.5 + 0.35 * np.cos(2 * np.pi * (x * np.cos(way) + y * np.sin(way)) / SOFT_PERIOD_PX + lag)
        for way, lag in ((0.2, 0.0), (1.3, 2.1), (2.2, 4.2))
    ]
    return np.stack(waves, axis=-1).astype(np.float32)


def _reconstruct(workload: Workload, *, method: str) -> tuple[Floats, ...]:
    """Each mosaic in full colour, clipped to what a display can show."""
    return tuple(np.clip(demosaic(cfa, method=method), 0.0, 1.0) for cfa in workload.mosaics)


def reference(workload: Workload) -> tuple[Floats, ...]:
    return workload.pictures


def _fidelity(
    picture: int,
) -> Callable[[tuple[Floats, ...], tuple[Floats, ...], Workload], float]:
    def measure(
        result: tuple[Floats, ...], truth: tuple[Floats, ...], _workload: Workload
    ) -> float:
        return psnr_db(result[picture], truth[picture])

    return measure


LADDER = Ladder(
    id="demosaicing",
    title="Demosaicing",
    workload="three mosaics of 240 × 192 pixels: a room, a balloon with very fine detail, "
    "and soft colours that have nothing in common",
    prepare=prepare,
    tiers=tuple(
        Tier(method, label, cost, partial(_reconstruct, method=method))
        for method, label, cost in (
            ("nearest", "Nearest", "1 tap a missing colour"),
            ("bilinear", "Bilinear", "2 or 4 taps a missing colour"),
            ("malvar", "Malvar–He–Cutler", "9 or 11 taps a missing colour"),
            ("menon", "Menon", "2 directions of green, choice, refinement"),
        )
    ),
    reference=reference,
    reference_label="the picture before two of its three colours were taken away",
    metrics=(
        Metric("psnr-room", "PSNR, room", "dB", _fidelity(ROOM), higher_is_better=True),
        Metric("psnr-balloon", "PSNR, balloon", "dB", _fidelity(BALLOON), higher_is_better=True),
        Metric("psnr-soft", "PSNR, soft colours", "dB", _fidelity(SOFT), higher_is_better=True),
    ),
    default_tier="malvar",
)
