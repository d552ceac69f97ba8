"""Depth of field: filters on one sharp picture, blurred layers, or rays through the whole lens."""

from dataclasses import dataclass
from functools import partial

import numpy as np

from simulations.engine.ladder import Ladder, Metric, Tier
from simulations.models.arrays import Floats, Mask, Planes
from simulations.models.error_measures import psnr_db
from simulations.models.lens.aperture import fibonacci_disc, jittered_disc, random_disc, turned_disc
from simulations.models.lens.depth_of_field import Blur, Layer, blur_by_depth, blur_layer, composite
from simulations.models.lens.disc_blur import disc_blur
from simulations.models.lens.screen_blur import binned_gaussian, gather_discs
from simulations.pictures import cards

type Ray = tuple[Floats, Floats, Floats, Floats]
"""Coordinates of rays on the lens, and their slopes right and down per metre forward."""


@dataclass(frozen=True, slots=True)
class Workload:
    """A picture and the lens."""

    pixels: cards.Pixels
    """The pixels, in float32."""
    lens_radius: float
    """Metres: large, as the cards are large and metres away."""
    crop: int
    """Pixels of border that are left out, as no filter has the picture beyond it."""
    seed: int = 7
    """Of the rays that are drawn."""


def workload_of(width: int, lens_radius: float, crop: int, seed: int = 7) -> Workload:
    """The cards on a sensor of ``width`` columns."""
    return Workload(cards.pixels(width, np.float32), lens_radius, crop, seed)


def prepare() -> Workload:
    """Discs of confusion of 4 pixels' radius for the nearest card, 2.8 for the wall."""
    return workload_of(80, lens_radius=0.18, crop=8)


def draw(index: int) -> Workload:
    """Other seeds, and lenses from half as wide to one and a half times as wide."""
    return workload_of(80, 0.18 * np.random.default_rng(index).uniform(0.5, 1.5), 12, index)


def radius_px(workload: Workload, depth: Floats | float) -> Floats:
    """Radius of the disc of confusion."""
    defocus = np.abs(1.0 / np.asarray(depth) - 1.0 / cards.FOCUS_Z)
    return workload.pixels.focal_px * workload.lens_radius * defocus


def pinhole(workload: Workload) -> Planes:
    return cards.radiance(workload.pixels, 0.0, 0.0).astype(np.float32)


def _depth(workload: Workload) -> Floats:
    """Depth (H, W) seen by the pinhole."""
    _, depth = cards.background(workload.pixels)
    for card in cards.CARDS:
        _, cover = cards.card_light(card, workload.pixels)
        depth = np.where(cover > 0.5, card.z, depth)
    return depth


def binned(workload: Workload) -> Planes:
    return binned_gaussian(pinhole(workload), radius_px(workload, _depth(workload)))


def discs(workload: Workload) -> Planes:
    return blur_by_depth(pinhole(workload), radius_px(workload, _depth(workload)))


def gather(workload: Workload) -> Planes:
    depth = _depth(workload)
    return gather_discs(pinhole(workload), radius_px(workload, depth), depth)


def layered(workload: Workload, blur: Blur = disc_blur) -> Planes:
    """Each card on its own layer, complete with the parts that others hide."""
    picture, depth = cards.background(workload.pixels)
    base = blur_by_depth(picture.astype(np.float32), radius_px(workload, depth), blur)
    layers = []
    for card in cards.CARDS:
        colour, cover = cards.card_light(card, workload.pixels)
        planes = np.concatenate([colour * cover, cover[None]]).astype(np.float32)
        layers.append(blur_layer(Layer(planes, 0, 0, float(radius_px(workload, card.z))), blur))
    return composite(base, layers)


def _fibonacci(workload: Workload, *, rays: int) -> Planes:
    """All pixels use the same points of the lens: the error is ghosts."""
    return _through(workload, fibonacci_disc(rays).astype(np.float32))


def _random(workload: Workload, *, rays: int) -> Planes:
    """Every pixel uses its own random points of the lens: the error is grain."""
    return _through(workload, random_disc(rays, workload.pixels.shape, _random_numbers(workload)))


def _jittered(workload: Workload) -> Planes:
    """Every pixel uses its own random point in each of sixteen cells of the lens."""
    return _through(workload, jittered_disc(2, 8, workload.pixels.shape, _random_numbers(workload)))


def _turned(workload: Workload, *, rays: int) -> Planes:
    """All pixels use the same points of the lens, each rotated by its own random angle."""
    spiral, rng = fibonacci_disc(rays), _random_numbers(workload)
    return _through(workload, turned_disc(spiral, workload.pixels.shape, rng))


def _random_numbers(workload: Workload) -> np.random.Generator:
    return np.random.default_rng(workload.seed)


def _through(workload: Workload, points: Floats) -> Planes:
    """Mean of the pictures through ``points`` (n, 2) of the unit disc, or (n, 2, H, W)."""
    total = np.zeros((3, *workload.pixels.shape), np.float32)
    for x, y in np.float32(workload.lens_radius) * points:
        total += cards.radiance(workload.pixels, x, y)
    return total / np.float32(len(points))


def reference(workload: Workload, rays: int = 4096) -> Floats:
    """Mean light (3, H, W) over each pixel and over the lens, in float64.

    It shares the scene with the tiers, but no code that draws it. A ray of zero width hits a card,
    the floor or the wall at one point, which is light or dark. The means are taken over many rays,
    each through a different place in pixel and lens.
    """
    pixels = cards.pixels(workload.pixels.shape[1], np.float64)
    shades = np.zeros((1 + len(cards.CARDS), *pixels.shape))
    for right, down, square, turn in spread_evenly(rays).tolist():
        radius, angle = workload.lens_radius * np.sqrt(square), 2 * np.pi * turn
        x = pixels.x + (right - 0.5) / pixels.focal_px
        y = pixels.y + (down - 0.5) / pixels.focal_px
        _add_shades(shades, x, y, radius * np.cos(angle), radius * np.sin(angle))
    colours = np.array([cards.TINT, *(card.colour for card in cards.CARDS)])
    return np.einsum("sc,shw->chw", colours, shades / rays)


def spread_evenly(count: int) -> Floats:
    """(count, 4) evenly spread places in the four-dimensional unit cube.

    Multiples of powers of 1/g, without their whole part, where g⁵ = g + 1: M. Roberts, *The
    unreasonable effectiveness of quasirandom sequences*, 2018.
    """
    g = 1.1673039782614187
    return (0.5 + np.arange(1, count + 1)[:, None] * g ** -np.arange(1.0, 5.0)) % 1.0


def _add_shades(shades: Floats, x: Floats, y: Floats, lens_x: float, lens_y: float) -> None:
    """Add the brightness of the hit points to the plane of the room or of a card (1 + cards, H, W).

    The rays leave the lens at one point, towards the points x (1, W) and y (H, 1) of the plane in
    focus.
    """
    ray = (
        np.array(lens_x),
        np.array(lens_y),
        x - lens_x / cards.FOCUS_Z,
        y - lens_y / cards.FOCUS_Z,
    )
    free = np.ones(shades.shape[1:], bool)
    for card, shade in reversed([*zip(cards.CARDS, shades[1:], strict=True)]):  # the nearest first
        around, hit, light = _card_light(card, ray)
        hit &= free[around]
        shade[around] += hit * light
        free[around] &= ~hit
    shades[0] += free * _room(ray)


def _place(ray: Ray, z: float) -> tuple[Floats, Floats]:
    return ray[0] + ray[2] * z, ray[1] + ray[3] * z


def _room(ray: Ray) -> Floats:
    """Brightness (H, W) of the floor where the ray meets it before the wall, else of the wall."""
    wall_x, wall_y = _place(ray, cards.WALL_Z)
    wall = np.where(_striped(wall_x, cards.BAR_PERIOD, cards.BAR), cards.LIGHT_BAR, cards.DARK_BAR)
    room = np.repeat(wall, len(wall_y), axis=0)
    on_floor = slice(np.count_nonzero(wall_y <= cards.FLOOR_Y), None)  # y grows from row to row
    z = (cards.FLOOR_Y - ray[1]) / ray[3][on_floor]
    x = ray[0] + ray[2] * z
    # Counted from the middle of a light tile; tiles that are even or odd in both directions are
    # light.
    same = _is_odd(np.rint(x / cards.TILE)) == _is_odd(np.rint(z / cards.TILE))
    room[on_floor] = np.where(same, cards.LIGHT_TILE, cards.DARK_TILE)
    return room


def _is_odd(whole: Floats) -> Mask:
    return whole.astype(np.int64) & 1 > 0


def _card_light(card: cards.Card, ray: Ray) -> tuple[tuple[slice, slice], Mask, Floats]:
    """The rows and columns around a card, which of their rays hit it, and its brightness."""
    x, y = _place(ray, card.z)
    across, down = _within(x - card.x, card.radius), _within(y - card.y, card.radius)
    x, y = x[:, across], y[down]
    hit = np.hypot(x - card.x, y - card.y) < card.radius
    light = _striped(x + cards.STRIPE_SLOPE * y, card.radius / 2, card.radius / 4)
    return (down, across), hit, np.where(light, 1.0, 0.5)


def _within(along: Floats, radius: float) -> slice:
    """The range of increasing places that are less than a radius away from 0."""
    return slice(*np.searchsorted(along.ravel(), (-radius, radius)))


def _striped(along: Floats, period: float, width: float) -> Mask:
    """Whether a place is on a stripe; one is centred on 0."""
    return np.abs(along - period * np.rint(along / period)) < width / 2


def fidelity_db(result: Planes, truth: Floats, workload: Workload) -> float:
    """PSNR within the border."""
    picture, reference = np.moveaxis(result, 0, -1), np.moveaxis(truth, 0, -1)
    return psnr_db(picture, reference, crop=workload.crop)


def worst(result: Planes, truth: Floats, workload: Workload) -> float:
    inner = slice(workload.crop, -workload.crop)
    return float(np.abs(result[:, inner, inner].astype(np.float64) - truth[:, inner, inner]).max())


SPIRALS = tuple(
    Tier(
        f"fibonacci-{rays}",
        f"{rays} rays on a spiral",
        f"{rays} rays a pixel",
        partial(_fibonacci, rays=rays),
    )
    for rays in (16, 64)
)

METRICS = (
    Metric("psnr", "PSNR", "dB", fidelity_db, higher_is_better=True),
    Metric("worst", "Largest error", "of range", worst),
)

LADDER = Ladder(
    id="depth-of-field",
    title="Depth of field",
    workload="80 × 60 pixels: three cards, floor and wall, discs of confusion up to 8 pixels wide",
    prepare=prepare,
    tiers=(
        Tier("pinhole", "Pinhole", "1 ray a pixel", pinhole),
        Tier("discs", "Discs chosen by depth", "1 ray, 4 blurred pictures", discs),
        Tier("layered", "Layers blurred and laid over", "4 layers, 1 to 4 blurs each", layered),
        Tier("binned", "Gaussians chosen by depth", "1 ray, 6 blurred pictures", binned),
        Tier("gather", "Gather from neighbours", "1 ray, 89 taps a pixel", gather),
        Tier("random-16", "16 independent rays", "16 rays a pixel", partial(_random, rays=16)),
        Tier("jittered-16", "16 rays, one in each cell", "16 rays a pixel", _jittered),
        Tier("turned-16", "16 rays, a spiral turned", "16 rays a pixel", partial(_turned, rays=16)),
        *SPIRALS,
    ),
    reference=reference,
    reference_label="4096 rays a pixel that hit or miss, by code of their own, in float64",
    metrics=METRICS,
    draw=draw,
    default_tier="layered",
    items=4_800,
    sampled=("random-16", "jittered-16", "turned-16", "fibonacci-16", "fibonacci-64"),
)
