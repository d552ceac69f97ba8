"""JPEG's coarse colours brought back to every pixel, with and without the rounding of a file.

The means alone favour methods that sharpen; once the coefficients have been rounded, as in every
file, there is noise to be sharpened as well.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np

from simulations.engine.ladder import Ladder, Metric, Tier
from simulations.models.arrays import Floats
from simulations.models.color.srgb import encode_srgb
from simulations.models.compression import jpeg
from simulations.models.compression.chroma_subsampling import coarsen
from simulations.models.compression.chroma_upsampling import refine
from simulations.models.error_measures import root_mean_square
from simulations.pictures.balloon import WHOLE
from simulations.pictures.mosaic_subjects import SUBJECTS

FACTOR, SUBSAMPLING, QUALITY = (2, 2), "4:2:0", 75
PICTURES = ("room", "balloon")


@dataclass(frozen=True, slots=True)
class Workload:
    """By picture, and each picture twice: as a file of quality 75 keeps it, and not rounded."""

    truth: tuple[Floats, ...]
    """Luma and colour differences (3, 192, 240) of each picture, in codes about 0."""
    decoded: tuple[jpeg.Planes, ...]
    """Twice as many: luma (192, 240) and coarse differences (96, 120), rounded, then not."""


def prepare() -> Workload:
    pictures = (encode_srgb(SUBJECTS[name].draw(WHOLE).astype(float)) for name in PICTURES)
    truth = tuple(jpeg.to_planes(np.rint(255 * picture) / 255) for picture in pictures)
    rounded = (jpeg.restore(jpeg.encode(planes, QUALITY, SUBSAMPLING)) for planes in truth)
    means = ((luma, coarsen(blue, FACTOR), coarsen(red, FACTOR)) for luma, blue, red in truth)
    return Workload(truth, (*rounded, *means))


def _fill_in(workload: Workload, *, method: str) -> tuple[Floats, ...]:
    """Both differences (2, 192, 240) of each entry of ``decoded``."""
    return tuple(
        np.stack([refine(plane, FACTOR, luma, method) for plane in differences])
        for luma, *differences in workload.decoded
    )


def reference(workload: Workload) -> tuple[Floats, ...]:
    return tuple(planes[1:] for planes in workload.truth) * 2


def _rms(place: int) -> Callable[[tuple[Floats, ...], tuple[Floats, ...], Workload], float]:
    def measure(result: tuple[Floats, ...], truth: tuple[Floats, ...], _work: Workload) -> float:
        return root_mean_square(result[place] - truth[place])

    return measure


LADDER = Ladder(
    id="chroma-upsampling",
    title="Filling in colour",
    workload="the colour differences of two pictures of 240 × 192 pixels, kept once in 2 × 2: "
    "rounded as in a file of quality 75, and as plain means",
    prepare=prepare,
    tiers=tuple(
        Tier(method, label, cost, partial(_fill_in, method=method))
        for method, label, cost in (
            ("repeated", "Repetition", "1 tap along each axis"),
            ("triangle", "Triangle", "2 taps along each axis"),
            ("parabola", "Parabola", "3 taps along each axis"),
            ("cubic", "Cubic (Catmull–Rom)", "4 taps along each axis"),
            ("guided", "Following luma", "3 parabolas, 4 means of 3 × 3"),
        )
    ),
    reference=reference,
    reference_label="the colour differences of every pixel, before they were averaged",
    metrics=(
        Metric("room", "RMS, room, file", "codes", _rms(0)),
        Metric("balloon", "RMS, balloon, file", "codes", _rms(1)),
        Metric("room-means", "RMS, room, means", "codes", _rms(2)),
        Metric("balloon-means", "RMS, balloon, means", "codes", _rms(3)),
    ),
    default_tier="triangle",
)
