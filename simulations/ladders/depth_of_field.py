"""Depth of field: filters on one sharp picture, blurred layers, or rays through the whole lens."""

from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray

from simulations.engine.ladder import Ladder, Metric, Tier
from simulations.models.aperture import fibonacci_disc, random_disc
from simulations.models.depth_of_field import Layer, Planes, blur_by_depth, blur_layer, composite
from simulations.models.screen_blur import binned_gaussian, gather_discs
from simulations.pictures import cards

type Floats = NDArray[np.floating]

LENS_RADIUS = 0.18
"""Metres: a disc of confusion of 4 pixels' radius for the nearest card, 2.8 for the wall."""
CROP = 8
"""Pixels of border left out: the filters cannot know what lies beyond."""


@dataclass(frozen=True, slots=True)
class Workload:
    """Directions of the pixels."""

    x: Floats
    """(1, 80), at z = 1, float32."""
    y: Floats
    """(60, 1)."""


def prepare() -> Workload:
    return Workload(*cards.normalised_pixels(np.float32))


def _radius_px(depth: Floats | float) -> Floats:
    """Of the disc of confusion."""
    defocus = np.abs(1.0 / np.asarray(depth) - 1.0 / cards.FOCUS_Z)
    radius: Floats = cards.FOCAL_PX * LENS_RADIUS * defocus
    return radius


def _pinhole(workload: Workload) -> Planes:
    return cards.radiance(workload.x, workload.y, 0.0, 0.0).astype(np.float32)


def _depth(workload: Workload) -> Floats:
    """Depth (H, W) of what the pinhole sees."""
    _, depth = cards.background(workload.x, workload.y)
    for card in cards.CARDS:
        _, cover = cards.card_light(card, workload.x, workload.y)
        depth = np.where(cover > 0.5, card.z, depth)
    return depth


def _binned(workload: Workload) -> Planes:
    return binned_gaussian(_pinhole(workload), _radius_px(_depth(workload)))


def _discs(workload: Workload) -> Planes:
    return blur_by_depth(_pinhole(workload), _radius_px(_depth(workload)))


def _gather(workload: Workload) -> Planes:
    depth = _depth(workload)
    return gather_discs(_pinhole(workload), _radius_px(depth), depth)


def _layered(workload: Workload) -> Planes:
    """Each card on a layer of its own, complete also where another hides it."""
    picture, depth = cards.background(workload.x, workload.y)
    base = blur_by_depth(picture.astype(np.float32), _radius_px(depth))
    layers = []
    for card in cards.CARDS:
        colour, cover = cards.card_light(card, workload.x, workload.y)
        planes = np.concatenate([colour * cover, cover[None]]).astype(np.float32)
        layers.append(blur_layer(Layer(planes, 0, 0, float(_radius_px(card.z)))))
    return composite(base, layers)


def _fibonacci(workload: Workload, *, rays: int) -> Planes:
    """Every pixel looks through the same points."""
    total = np.zeros((3, cards.HEIGHT, cards.WIDTH), np.float32)
    for x, y in (LENS_RADIUS * fibonacci_disc(rays)).tolist():
        total += cards.radiance(workload.x, workload.y, x, y)
    return total / np.float32(rays)


def _random(workload: Workload, *, rays: int) -> Planes:
    """Every pixel looks through points of its own: the error is grain."""
    total = np.zeros((3, cards.HEIGHT, cards.WIDTH), np.float32)
    points = random_disc(rays, (cards.HEIGHT, cards.WIDTH), np.random.default_rng(7))
    for x, y in np.float32(LENS_RADIUS) * points:
        total += cards.radiance(workload.x, workload.y, x, y)
    return total / np.float32(rays)


def reference(_workload: Workload) -> Floats:
    """2048 rays in float64: Gauss–Legendre in the squared radius, even steps in angle."""
    nodes, weights = np.polynomial.legendre.leggauss(32)
    x, y = cards.normalised_pixels(np.float64)
    picture = np.zeros((3, cards.HEIGHT, cards.WIDTH))
    for ring, (node, weight) in enumerate(zip(nodes, weights, strict=True)):
        radius = LENS_RADIUS * np.sqrt((node + 1) / 2)
        for angle in 2 * np.pi * (np.arange(64) + ring / 32) / 64:
            light = cards.radiance(x, y, radius * np.cos(angle), radius * np.sin(angle))
            picture += weight / 128 * light
    return picture


def _errors(result: Planes, truth: Floats) -> Floats:
    inner = (slice(None), slice(CROP, -CROP), slice(CROP, -CROP))
    errors: Floats = result[inner].astype(np.float64) - truth[inner]
    return errors


def psnr_db(result: Planes, truth: Floats, _workload: Workload) -> float:
    return float(-10 * np.log10(np.mean(np.square(_errors(result, truth)))))


def worst(result: Planes, truth: Floats, _workload: Workload) -> float:
    return float(np.abs(_errors(result, truth)).max())


LADDER = Ladder(
    id="depth-of-field",
    title="Depth of field",
    workload="80 × 60 pixels: three cards, floor and wall, discs of confusion up to 9 pixels wide",
    prepare=prepare,
    tiers=(
        Tier("pinhole", "Pinhole", "1 ray a pixel", _pinhole),
        Tier("discs", "Discs chosen by depth", "1 ray, 4 blurred pictures", _discs),
        Tier("layered", "Layers blurred and laid over", "4 layers, 1 blur each", _layered),
        Tier("binned", "Gaussians chosen by depth", "1 ray, 6 blurred pictures", _binned),
        Tier("gather", "Gather from neighbours", "1 ray, 89 taps a pixel", _gather),
        *(
            Tier(
                f"{kind}-{rays}", f"{rays} {label}", f"{rays} rays a pixel", partial(run, rays=rays)
            )
            for rays in (16, 64)
            for kind, label, run in (
                ("random", "random rays", _random),
                ("fibonacci", "rays on a spiral", _fibonacci),
            )
        ),
    ),
    reference=reference,
    reference_label="2048 rays on 32 rings of the lens, in float64",
    metrics=(
        Metric("psnr", "PSNR", "dB", psnr_db, higher_is_better=True),
        Metric("worst", "Largest error", "of range", worst),
    ),
    default_tier="layered",
)
