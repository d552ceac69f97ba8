"""Demosaicing: six ways to estimate the missing colours, on three kinds of picture.

The mosaics are in linear light, as a sensor's. The results are compared as a display shows them,
and one also in linear light. The methods that combine the colours are best if edges are at the same
place in all three, as in most photographs, and worst if they are not.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np

from simulations.engine.ladder import Ladder, Metric, Tier
from simulations.models.arrays import Floats
from simulations.models.color.srgb import encode_srgb
from simulations.models.error_measures import psnr_db
from simulations.models.sensor.demosaicing import demosaic, mosaic
from simulations.pictures.balloon import HEIGHT, WHOLE, WIDTH
from simulations.pictures.mosaic_subjects import SUBJECTS

PICTURES = ("room", "balloon", "soft")
CROP = 8
"""Pixels at each border that are left out, as they depend on the mirrored mosaic."""


@dataclass(frozen=True, slots=True)
class Workload:
    """The pictures and their mosaics."""

    pictures: tuple[Floats, ...]
    """Each (192, 240, 3), linear, float32, in the order of `PICTURES`."""
    mosaics: tuple[Floats, ...]
    """Each (192, 240)."""


def prepare() -> Workload:
    pictures = tuple(SUBJECTS[name].draw(WHOLE) for name in PICTURES)
    return Workload(pictures, tuple(mosaic(picture) for picture in pictures))


def draw(index: int) -> Workload:
    """Other parts of the pictures, shifted by up to 32 pixels and mirrored, so that other details
    fall on other cells of the mosaic."""
    top, left = np.random.default_rng(index).integers(0, 32, 2)
    rows, columns = (slice(None, None, -1 if index & bit else 1) for bit in (1, 2))
    part = slice(top, HEIGHT - 32 + top), slice(left, WIDTH - 32 + left)
    pictures = tuple(
        np.ascontiguousarray(picture[part][rows, columns]) for picture in prepare().pictures
    )
    return Workload(pictures, tuple(mosaic(picture) for picture in pictures))


def _reconstruct(workload: Workload, *, method: str) -> tuple[Floats, ...]:
    """Each mosaic in full colour, in linear light, clipped to [0, 1]."""
    return tuple(np.clip(demosaic(cfa, method=method), 0.0, 1.0) for cfa in workload.mosaics)


def reference(workload: Workload) -> tuple[Floats, ...]:
    return workload.pictures


def _fidelity(name: str) -> Callable[[tuple[Floats, ...], tuple[Floats, ...], Workload], float]:
    """PSNR of one picture as a display shows it."""
    place = PICTURES.index(name)

    def measure(result: tuple[Floats, ...], truth: tuple[Floats, ...], _work: Workload) -> float:
        return psnr_db(encode_srgb(result[place]), encode_srgb(truth[place]), crop=CROP)

    return measure


def _fidelity_in_light(
    result: tuple[Floats, ...], truth: tuple[Floats, ...], _work: Workload
) -> float:
    """PSNR of the balloon before the display's curve."""
    place = PICTURES.index("balloon")
    return psnr_db(result[place], truth[place], crop=CROP)


LADDER = Ladder(
    id="demosaicing",
    title="Demosaicing",
    workload="three mosaics of linear light, 240 × 192 pixels: a room, a balloon with very fine "
    "detail, and soft colours that have nothing in common",
    prepare=prepare,
    tiers=tuple(
        Tier(method, label, cost, partial(_reconstruct, method=method))
        for method, label, cost in (
            ("nearest", "Nearest, for contrast", "1 tap a missing colour"),
            ("bilinear", "Bilinear", "2 or 4 taps a missing colour"),
            ("malvar", "Malvar–He–Cutler", "9 or 11 taps a missing colour"),
            ("menon-unrefined", "Menon, unrefined", "2 directions of green, choice"),
            ("menon", "Menon", "2 directions of green, choice, refinement"),
            (
                "menon-encoded",
                "Menon, unrefined, on encoded values",
                "2 directions, choice, 4 powers a pixel",
            ),
        )
    ),
    reference=reference,
    reference_label="the picture before two of its three colours were taken away",
    metrics=(
        *(
            Metric(f"psnr-{name}", f"PSNR, {words}", "dB", _fidelity(name), higher_is_better=True)
            for name, words in zip(PICTURES, ("room", "balloon", "soft colours"), strict=True)
        ),
        Metric("light", "PSNR, balloon, in light", "dB", _fidelity_in_light, higher_is_better=True),
    ),
    default_tier="menon-unrefined",
    draw=draw,
    items=138_240,
)
