"""A striped shirt, worn: the stripes bend with the cloth, and are even on the chest, where the
figure reads its row. Lengths are in the figure's pixels, 160 × 120."""

import math
from dataclasses import KW_ONLY, dataclass
from functools import lru_cache

import numpy as np

from simulations.models.arrays import Floats
from simulations.models.sampling.prefilters import Prefilter, transfer
from simulations.scenes.aliasing.light import FRAMED_AT, SIZE_PX, Pattern

MIDDLE = 80.0  # of the body
FLAT = 28.0  # half the width of the chest that faces the camera; towards its sides, cloth recedes
PALE, DARK, SKIN, WALL = np.array(
    [[0.86, 0.84, 0.80], [0.03, 0.07, 0.24], [0.62, 0.36, 0.24], [0.36, 0.31, 0.25]], np.float32
)
FINEST = 4.0  # cycles per sample; no stripes get finer


@dataclass(frozen=True, slots=True)
class Fold:
    """A fold of the shirt, in pixels."""

    centre: tuple[float, float]
    _: KW_ONLY
    turn_deg: float
    """Direction of its length, from x towards y."""
    length: float
    """Half of it, as of the width."""
    width: float
    height: float
    """How far its crest moves the stripes to the right."""

    def shift_at(self, x: Floats, y: Floats) -> Floats:
        """How far it moves the stripes at a place to the right; 0 beyond its ends."""
        turn = math.radians(self.turn_deg)
        right, down = x - self.centre[0], y - self.centre[1]
        along = (right * math.cos(turn) + down * math.sin(turn)) / self.length
        off = (down * math.cos(turn) - right * math.sin(turn)) / self.width
        shift, inside = np.zeros_like(along), (np.abs(along) < 1.0) & (np.abs(off) < 1.0)
        hill = np.cos(np.pi / 2 * along[inside]) * np.cos(np.pi / 2 * off[inside])
        shift[inside] = self.height * hill**2
        return shift


FOLDS = (
    Fold((50, 62), turn_deg=55, length=30, width=9, height=1.5),
    Fold((57, 98), turn_deg=70, length=34, width=8, height=-1.8),
    Fold((114, 66), turn_deg=118, length=28, width=9, height=-1.6),
    Fold((106, 104), turn_deg=102, length=36, width=9, height=1.7),
    Fold((78, 108), turn_deg=92, length=26, width=8, height=1.2),
)


@dataclass(frozen=True, slots=True)
class Cloth:
    """The shirt without its stripes, at every sample (h, w)."""

    along: Floats
    """Place on the cloth, across the stripes, from the first of the figure's row."""
    fineness: tuple[Floats, Floats]
    """How much finer the stripes are down and across than where the cloth faces the camera."""
    shade: Floats
    cover: Floats
    """Share of each pixel that shows striped cloth."""
    behind: Floats
    """(h, w, 3) linear RGB of all else."""


def shirt_light(pattern: Pattern, kernel: Prefilter) -> Floats:
    """(h, w, 3) linear RGB of the shirt, filtered and sampled."""
    cloth = cloth_at(pattern.rate)
    passed = 1.0
    if kernel.weights.size > 1:
        finer = np.linspace(0.0, FINEST, 401)
        curve = transfer(kernel, finer)
        for fineness in cloth.fineness:
            passed = passed * np.interp(pattern.frequency * fineness, finer, curve)
    turns = 2 * np.pi * pattern.frequency * pattern.rate
    wave = 0.5 + 0.5 * passed * np.sin(pattern.phase_rad + turns * cloth.along)
    dyed = cloth.shade[..., None] * (DARK + wave[..., None] * (PALE - DARK))
    return cloth.behind + cloth.cover[..., None] * (dyed - cloth.behind)


@lru_cache(maxsize=4)
def cloth_at(rate: float) -> Cloth:
    """The shirt at ``rate`` samples a pixel."""
    columns, rows = (round(length * rate) for length in SIZE_PX)
    # The first sample of the row lies on the first of its pixels, as in the second panel.
    x = FRAMED_AT + (np.arange(columns) - round(FRAMED_AT * rate)) / rate
    y = (np.arange(rows) + 0.5) / rate
    x, y = np.meshgrid(x.astype(np.float32), y.astype(np.float32))
    right, side = x - MIDDLE, np.abs(x - MIDDLE)
    beyond = np.maximum(side - FLAT, 0.0)
    # The body, with sloping shoulders, and an arm at each side, from shoulder to elbow.
    body = np.maximum(side - 43.0 - 0.03 * y, 27.0 + 0.3 * side - y)
    arm = np.maximum(segment(side, y, (41.0, 49.0), (57.0, 140.0)) - 14.0, side - 76.0)
    seam = np.maximum(arm, FLAT + 8.0 - side)  # of the sleeve, which is in front
    round_arm = np.clip((side - 41.0 - 0.175 * (y - 49.0)) / 15.0, -1.0, 1.0)
    bend = sum(each.shift_at(x, y) for each in FOLDS)
    on_body = right + np.sign(right) * beyond**2 / 36.0 + bend
    on_arm = np.sign(right) * (0.84 * side - 0.42 * y + 3.0 * round_arm * round_arm**2) + 0.4 * bend
    along = np.where(seam < 0.0, on_arm, on_body)
    down, across = (np.abs(each) * rate for each in np.gradient(along))
    shade = np.where(seam < 0.0, 0.95 - 0.4 * round_arm**2, 1.02 - 0.55 * (side / 50.0) ** 2)
    shade = shade - 0.16 * np.gradient(bend, axis=1) * rate
    sewn = np.exp(-(seam**2)) + np.exp(-((right + 3.5) ** 2))
    shade = np.clip(shade * (1.0 - 0.35 * sewn), 0.12, 1.1)
    low = np.clip(y - 22.0, 0.0, 24.0)
    wing = np.abs(side - 9.0 - 0.22 * low) - 8.0 + 0.2 * low
    collar = np.maximum(wing, np.abs(y - 34.0 + 0.25 * side) - 12.0)
    neck = np.maximum(side - 13.0 + 0.55 * np.maximum(y - 26.0, 0.0), y - 52.0)
    wall = WALL * (1.15 - 0.5 * (x / SIZE_PX[0]) - 0.2 * (y / SIZE_PX[1]))[..., None]
    shirt = coverage(np.minimum(body, arm), rate)
    flesh = coverage(neck, rate)
    skin = SKIN * (1.0 - 0.45 * (right / 13.0).clip(-1, 1) ** 2 - 0.2 * (right > 6))[..., None]
    pale = PALE * (0.98 - 0.012 * side - 0.12 * (right > 0))[..., None]
    behind = wall + flesh[..., None] * (skin - wall)
    points = coverage(collar, rate)
    behind = behind + points[..., None] * (pale - behind)
    cover = shirt * (1.0 - np.maximum(flesh, points))
    return Cloth(along + MIDDLE - FRAMED_AT, (down, across), shade, cover, behind)


def segment(x: Floats, y: Floats, start: tuple[float, float], end: tuple[float, float]) -> Floats:
    """Distance from the line between two points."""
    dx, dy = end[0] - start[0], end[1] - start[1]
    share = np.clip(((x - start[0]) * dx + (y - start[1]) * dy) / (dx * dx + dy * dy), 0.0, 1.0)
    return np.hypot(x - start[0] - share * dx, y - start[1] - share * dy)


def coverage(outside: Floats, rate: float) -> Floats:
    """Share of each sample inside, given its distance from a border, negative inside."""
    return np.clip(0.5 - outside * rate, 0.0, 1.0)
