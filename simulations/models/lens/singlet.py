"""A lens of one piece of glass with two spherical surfaces, and three ways to trace rays through
it.

Lengths in millimetres along the axis, light from the left; the middle of the glass, halfway between
its two vertices, is the origin. A curvature is 1/R, positive where the centre lies to the right of
the surface, 0 for a plane: a lens that bulges both ways has a positive front and a negative back.
Hecht, *Optics*, 5th ed., 2017, sections 5.2 and 6.1-6.3; Jenkins and White, *Fundamentals of
Optics*, 4th ed., 1976, chapters 8 and 9.
"""

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike, NDArray

from simulations.models.arrays import Floats, Mask
from simulations.models.require import require, require_positive

PASSES, MISSES, REFLECTED, LEAVES_BY_RIM = range(4)
"""Fate of a ray: through; past the glass; totally reflected inside; out at the rim."""


@dataclass(frozen=True, slots=True)
class Singlet:
    """One lens."""

    front_per_mm: float
    back_per_mm: float
    """Curvatures."""
    thickness_mm: float
    """Distance between the vertices."""
    index: float
    """Index of the glass, in air."""

    def __post_init__(self) -> None:
        for name in ("front_per_mm", "back_per_mm"):
            value = getattr(self, name)
            require(name, value, abs(value) <= 1e3, "a curvature from -1000 to 1000")
        require_positive("thickness_mm", self.thickness_mm)
        require("index", self.index, 1.0 <= self.index <= 10.0, "1 to 10")


@dataclass(frozen=True, slots=True)
class Rays:
    """Rays in a plane through the axis; NaN after the end of a ray."""

    front: Floats
    """(n, 2) points on the first surface: along the axis, and height."""
    back: Floats
    """(n, 2) points on the second surface."""
    slope: Floats
    """(n,) height per length behind the lens."""
    fate: NDArray[np.intp]
    """(n,) one of `PASSES`, `MISSES`, `REFLECTED` and `LEAVES_BY_RIM`."""

    @property
    def crossing_mm(self) -> Floats:
        """(n,) where they cross the axis: ±inf if parallel to it, negative if they seem to come
        from before the lens, NaN for a ray that ends."""
        with np.errstate(divide="ignore"):
            return self.back[:, 0] - self.back[:, 1] / self.slope


def thin_power_per_mm(lens: Singlet) -> float:
    """1/F by the lensmaker's formula for no thickness: (n − 1)(1/R₁ − 1/R₂)."""
    return (lens.index - 1.0) * (lens.front_per_mm - lens.back_per_mm)


def power_per_mm(lens: Singlet) -> float:
    """1/F with the thickness: light converges between the surfaces."""
    both = lens.front_per_mm * lens.back_per_mm * lens.thickness_mm / lens.index
    return thin_power_per_mm(lens) + (lens.index - 1.0) ** 2 * both


def focal_mm(power_per_mm: float) -> float:
    """1/power: infinite for a pane, negative for a diverging lens."""
    return 1.0 / power_per_mm if power_per_mm else np.inf


@lru_cache(maxsize=4)  # asked for by every bundle of rays
def rim_mm(lens: Singlet, largest_mm: float) -> float:
    """The height of the rim: where the surfaces meet, or ``largest_mm``."""
    require_positive("largest_mm", largest_mm)
    steepest = max(abs(lens.front_per_mm), abs(lens.back_per_mm))
    low, high = 0.0, min(largest_mm, 1.0 / steepest if steepest else np.inf)
    if _edge_mm(lens, high) >= 0.0:
        return high
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if _edge_mm(lens, middle) >= 0.0 else (low, middle)
    return low


def _edge_mm(lens: Singlet, height_mm: float) -> float:
    square = height_mm * height_mm
    back, front = (
        c * square / (1.0 + math.sqrt(max(1.0 - c * c * square, 0.0)))
        for c in (lens.back_per_mm, lens.front_per_mm)
    )
    return lens.thickness_mm + back - front


def sag_mm(curvature_per_mm: float, height_mm: ArrayLike) -> Floats:
    """Sag of a surface, to the right of its vertex, at heights (...): c h²/(1 + √(1 − c²h²)).

    Raises `ValueError` beyond the sphere.
    """
    height = np.asarray(height_mm, float)
    with np.errstate(over="ignore"):
        rest = 1.0 - (curvature_per_mm * height) ** 2
    # The pole itself, reached as 1/c, may round to just beyond the sphere.
    require("height_mm", height, np.all(rest >= -1e-12), "up to the radius of the surface")
    return curvature_per_mm * height**2 / (1.0 + np.sqrt(np.maximum(rest, 0.0)))


@np.errstate(over="ignore", invalid="ignore")
def through_thin(lens: Singlet, distance_mm: float, heights_mm: ArrayLike) -> Rays:
    """Rays from a point on the axis, bent once, in the plane through the middle: by −h/f.

    Parameters
    ----------
    distance_mm : float
        From the point to the middle, positive; inf for parallel rays.
    heights_mm : (n,) floats
        Heights of the rays in the middle plane without the lens.
    """
    heights, slopes = _aimed(lens, distance_mm, heights_mm)
    place = np.stack([np.zeros_like(heights), heights], -1)
    slope = slopes - heights * thin_power_per_mm(lens)
    return Rays(place, place, slope, np.full(heights.shape, PASSES))


@np.errstate(over="ignore", invalid="ignore")
def through_paraxial(lens: Singlet, distance_mm: float, heights_mm: ArrayLike) -> Rays:
    """The same rays, bent twice, at both vertices, by Snell's law for small angles."""
    heights, slopes = _aimed(lens, distance_mm, heights_mm)
    half, n = lens.thickness_mm / 2.0, lens.index
    front = heights - half * slopes
    inside = (slopes - (n - 1.0) * lens.front_per_mm * front) / n
    back = front + lens.thickness_mm * inside
    slope = n * inside + (n - 1.0) * lens.back_per_mm * back
    return Rays(
        np.stack([np.full_like(front, -half), front], -1),
        np.stack([np.full_like(back, half), back], -1),
        slope,
        np.full(heights.shape, PASSES),
    )


def through_exact(
    lens: Singlet, distance_mm: float, heights_mm: ArrayLike, largest_mm: float
) -> Rays:
    """The same rays, by Snell's law at both spheres; the glass ends at `rim_mm`."""
    heights, slopes = _aimed(lens, distance_mm, heights_mm)
    half, rim = lens.thickness_mm / 2.0, rim_mm(lens, largest_mm)
    along = _unit(np.stack([np.ones_like(slopes), slopes], -1))
    start = np.stack([np.zeros_like(heights), heights], -1)
    front, normal, hits = meet(start, along, -half, lens.front_per_mm)
    hits &= _within(front, rim)
    inside, _ = refract(along, normal, 1.0 / lens.index)
    back, normal, hits_back = meet(front, inside, half, lens.back_per_mm)
    hits_back &= _within(back, rim)
    out, passed = refract(inside, normal, lens.index)
    # At the rim of a ball light may leave backwards.
    sideways = out[:, 0] <= 0.0
    fate = np.select(
        [~hits, ~hits_back, ~passed, sideways],
        [MISSES, LEAVES_BY_RIM, REFLECTED, LEAVES_BY_RIM],
        PASSES,
    )
    front = np.where(hits[:, None], front, np.nan)
    back = np.where((hits & hits_back)[:, None], back, np.nan)
    through = fate == PASSES
    slope = np.full(heights.shape, np.nan)
    slope[through] = out[through, 1] / out[through, 0]
    return Rays(front, back, slope, fate)


def paraxial_image_mm(lens: Singlet, distance_mm: float) -> float:
    """Distance at which all rays near the axis meet: behind the lens, or, if negative, in front."""
    return float(through_paraxial(lens, distance_mm, [1.0]).crossing_mm[0])


def thin_image_mm(lens: Singlet, distance_mm: float) -> float:
    """The same distance for the thin lens."""
    return float(through_thin(lens, distance_mm, [1.0]).crossing_mm[0])


@np.errstate(over="ignore", invalid="ignore")
def meet(
    start: Floats, along: Floats, vertex_mm: float, curvature_per_mm: float
) -> tuple[Floats, Floats, Mask]:
    """Where rays (n, 2) meet a sphere near its vertex, its unit normal there, and whether they do.

    The formula for the root includes planes. Normals point to the right.
    """
    place = start - np.array([vertex_mm, 0.0])
    c = curvature_per_mm
    half = along[:, 0] - c * np.einsum("ni,ni->n", place, along)
    rest = c * np.einsum("ni,ni->n", place, place) - 2.0 * place[:, 0]
    inside = half * half - c * rest
    hits = (inside >= 0.0) & (half > 0.0)
    root = np.sqrt(np.where(hits, inside, 0.0))
    step = np.where(hits, rest / np.where(hits, half + root, 1.0), 0.0)
    place = place + step[:, None] * along
    normal = np.array([1.0, 0.0]) - c * place
    return place + np.array([vertex_mm, 0.0]), normal, hits


@np.errstate(over="ignore", invalid="ignore")
def refract(along: Floats, normal: Floats, ratio: float) -> tuple[Floats, Mask]:
    """Snell's law: unit directions (n, 2) behind a surface, and whether any light passes it.

    ``ratio`` is the index before the surface over the one behind; beyond the critical angle light
    is totally reflected, and the direction is unchanged.
    """
    cosine = np.einsum("ni,ni->n", along, normal)
    squared = 1.0 - ratio**2 * (1.0 - cosine**2)
    passed = squared >= 0.0
    behind = np.sqrt(np.where(passed, squared, 0.0))
    bent = ratio * along + (behind - ratio * cosine)[:, None] * normal
    return np.where(passed[:, None], bent, along), passed


def _aimed(lens: Singlet, distance_mm: float, heights_mm: ArrayLike) -> tuple[Floats, Floats]:
    """Heights (n,) in the middle plane, and the slopes of the rays."""
    nearest = lens.thickness_mm / 2.0
    require(
        "distance_mm", distance_mm, distance_mm > nearest, f"before the glass: above {nearest:g}"
    )
    heights = np.atleast_1d(np.asarray(heights_mm, float))
    require("heights_mm", heights, np.isfinite(heights).all(), "finite")
    return heights, heights / distance_mm


def _within(places: Floats, rim: float) -> Mask:
    """Whether heights are within the rim, with a tolerance for rounding: the rim itself is
    glass."""
    inside: Mask = np.abs(places[:, 1]) <= rim * (1.0 + 1e-12)
    return inside


def _unit(vectors: Floats) -> Floats:
    return vectors / np.hypot(vectors[..., :1], vectors[..., 1:])  # whose squares may overflow
