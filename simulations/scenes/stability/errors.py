"""Errors of two computations of four formulas, by distance from their singularity.

Each formula is computed as a textbook writes it and rearranged, in a given format throughout. At
each distance some random inputs are rounded to the format and then taken as exact. The largest
error counts, as a single rounding may be lucky.

The reference is computed by whole-number arithmetic. A floating-point number is a whole number
times a power of two. Sums and products of such numbers are exact here; a quotient, a root or an
arctangent is cut after `BITS` binary places, of which a double has 53. So the reference has none of
the rounding under test.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from math import isqrt

import numpy as np

from simulations.models.arrays import Floats

LOWEST, STEP = -15.0, 0.25  # power of ten of the smallest distance, and step between distances
DISTANCES: Floats = np.array(
    [float(f"{10.0**power:.4g}") for power in np.arange(LOWEST, 0.1, STEP)]
)
"""(n,) distances from the singularity, nearest first."""
DRAWS = 8
NOTHING_RIGHT = 1.0
NEAREST_SPACINGS = 4  # of the format: numbers closer than this may round to the same

K1 = -0.3
FOLD = float(np.sqrt(-1.0 / (3.0 * K1)))
LARGEST_SEEN = FOLD * 2.0 / 3.0
"""Radius of the barrel lens's fold, and its image radius, in focal lengths."""
ROWS: Floats = np.array([[0.8, 0.0, 0.6], [-0.6, 0.0, 0.8]])
"""The first and the last row of the rotation from the world's axes to the camera's."""

BITS = 256
ONE = 1 << BITS

type Kind = type[np.floating]
type Found = tuple[float, float, float]
"""Error as written, error rearranged, condition number κ."""


@dataclass(frozen=True, slots=True)
class Errors:
    """Largest relative errors (n,) at `DISTANCES`; NaN if the format has no inputs that near."""

    written: Floats
    rearranged: Floats
    bound: Floats
    """κ u: the error from rounding the inputs once."""


def unit_of(digits: str) -> float:
    """u, half the spacing of the numbers just above 1."""
    return float(np.finfo(np.dtype(digits)).eps) / 2


def errors_of(formula: str, digits: str) -> Errors:
    """The curves of one formula in one format."""
    kind = np.dtype(digits).type
    there = 2 * NEAREST_SPACINGS * unit_of(digits) <= DISTANCES
    found = np.full((3, len(DISTANCES)), np.nan)
    found[:, there] = np.array([MEASURED[formula](x, kind) for x in DISTANCES[there].tolist()]).T
    written, rearranged, condition = found
    bound = np.maximum(condition, 1.0) * unit_of(digits)
    return Errors(*(np.minimum(each, NOTHING_RIGHT) for each in (written, rearranged, bound)))


def largest_error(found: Floats, exact: list[int]) -> float:
    pairs = zip(found.tolist(), exact, strict=True)
    return max(relative_error(value, true) for value, true in pairs)


def generator_at(distance: float) -> np.random.Generator:
    return np.random.default_rng(round(-4 * np.log10(distance)))


def angle(distance: float, kind: Kind) -> Found:
    """Pairs of quaternions half of the rotation θ apart; ``distance`` is 2 tan θ/2."""
    rng = generator_at(distance)
    start = unit(rng.uniform(0.2, 1.0, (DRAWS, 4)))
    aside = rng.uniform(-1.0, 1.0, (DRAWS, 4))
    across = unit(aside - (aside * start).sum(axis=-1, keepdims=True) * start)
    a, b = start.astype(kind), unit(start + distance / 2 * across).astype(kind)
    exact = [exact_angle(*pair) for pair in zip(a.tolist(), b.tolist(), strict=True)]
    with np.errstate(invalid="ignore"):
        written = largest_error(angle_by_arccosine(a, b), exact)
    return written, largest_error(angle_by_lengths(a, b), exact), 2.0 / distance


def unit(q: Floats) -> Floats:
    return np.asarray(q / np.sqrt((q * q).sum(axis=-1, keepdims=True)))


def angle_by_arccosine(start: Floats, end: Floats) -> Floats:
    """2 acos |q₀ · q₁| of quaternions (n, 4)."""
    return 2 * np.arccos(np.abs((start * end).sum(axis=-1)))


def angle_by_lengths(start: Floats, end: Floats) -> Floats:
    """4 atan2(|q₁ − q₀|, |q₁ + q₀|), of quaternions (n, 4) on the same side."""
    apart, together = (np.sqrt((q * q).sum(axis=-1)) for q in (end - start, end + start))
    return 4 * np.arctan2(apart, together)


def blur(distance: float, kind: Kind) -> Found:
    """|Z − s| is ``distance`` s. Lengths in focal lengths, the lens focused at 40 to 80 of them."""
    focus = generator_at(distance).uniform(40.0, 80.0, DRAWS).astype(kind)
    depth = (focus * (1.0 + distance)).astype(kind)
    given = np.full(DRAWS, 0.5, kind), focus, depth
    triples = zip(*(numbers.tolist() for numbers in given), strict=True)
    exact = [exact_blur(*triple) for triple in triples]
    written, rearranged = blur_in_dioptres(*given), blur_by_distances(*given)
    return largest_error(written, exact), largest_error(rearranged, exact), 1.0 / distance


def blur_in_dioptres(scale: Floats, focus: Floats, depth: Floats) -> Floats:
    """The reciprocals are rounded, then subtracted."""
    return scale / (1 - 1 / focus) * np.abs(1 / depth - 1 / focus)


def blur_by_distances(scale: Floats, focus: Floats, depth: Floats) -> Floats:
    """The distances are subtracted first, which is exact if they are close."""
    return scale * np.abs(focus - depth) / ((focus - 1) * depth)


def origin(distance: float, kind: Kind) -> Found:
    """The point is 5 m to 10 m in front of a camera at 10 m / ``distance`` from the origin."""
    rng = generator_at(distance)
    depth = rng.uniform(5.0, 10.0, DRAWS)
    across = rng.uniform(0.2, 0.5, DRAWS) * depth
    centre = (10.0 / distance * np.array([0.64, 0.48, 0.6])).astype(kind)
    away = across[:, None] * ROWS[0] + depth[:, None] * ROWS[1]
    point, rows = (centre + away).astype(kind), ROWS.astype(kind)
    exact = [exact_pixel(rows.tolist(), one, centre.tolist()) for one in point.tolist()]
    with np.errstate(divide="ignore", invalid="ignore"):
        written = largest_error(pixel_from_origin(rows, point, centre), exact)
    rearranged = largest_error(pixel_from_camera(rows, point, centre), exact)
    return written, rearranged, 1.0 / distance


def pixel_from_origin(rows: Floats, point: Floats, centre: Floats) -> Floats:
    """X/Z by R p + t with t = −R c: both terms are as large as the distance from the origin."""
    x, z = (dot(row, point) + -dot(row, centre) for row in rows)
    return np.asarray(x / z)


def pixel_from_camera(rows: Floats, point: Floats, centre: Floats) -> Floats:
    """X/Z by R (p − c)."""
    x, z = (dot(row, point - centre) for row in rows)
    return np.asarray(x / z)


def dot(row: Floats, points: Floats) -> Floats:
    """Written out, as a library may fuse or reorder the terms, and the rounding matters."""
    x, y, z = (points[..., axis] for axis in range(3))
    return np.asarray(row[0] * x + row[1] * y + row[2] * z)


def fold(distance: float, kind: Kind) -> Found:
    """r_d is short of its largest value by this share of it. Five Newton steps from r_d, or
    halvings from 1 to the last bit of a double, and some more."""
    spread = generator_at(distance).uniform(0.8, 1.2, DRAWS)
    inside = 1.0 - np.minimum(distance * spread, 1.0 - 1e-3)
    distorted = (LARGEST_SEEN * inside).astype(kind)
    k1, start = float(kind(K1)), newton(distorted.astype(np.float64), 60).tolist()
    pairs = zip(distorted.tolist(), start, strict=True)
    exact = [exact_radius(k1, r_d, guess) for r_d, guess in pairs]
    r = np.array([true / ONE for true in exact])
    condition = float(np.abs((1.0 + k1 * r**2) / (1.0 + 3.0 * k1 * r**2)).max())
    few, many = (largest_error(newton(distorted, steps), exact) for steps in (5, 60))
    return few, many, condition


def newton(distorted: Floats, steps: int) -> Floats:
    """r (1 + k₁ r²) = r_d, started on the axis's side, from which no step passes the solution."""
    k, r = distorted.dtype.type(K1), distorted
    for _ in range(steps):
        square = r * r
        r = r - (r * (1 + k * square) - distorted) / (1 + 3 * k * square)
    return r


MEASURED: Mapping[str, Callable[[float, Kind], Found]] = {
    "angle": angle,
    "blur": blur,
    "origin": origin,
    "fold": fold,
}


def fixed(value: float) -> int:
    """A number in units of 2⁻²⁵⁶; exact for every double of size 2⁻²⁰³ or more."""
    above, below = float(value).as_integer_ratio()
    return (above << BITS) // below


def times(a: int, b: int) -> int:
    return a * b >> BITS


def over(a: int, b: int) -> int:
    return (a << BITS) // b


def fixed_point_root(a: int) -> int:
    return isqrt(a << BITS)


def arctangent(ratio: int) -> int:
    """Arctangent of 0 or more: the argument is halved until it is small, then Gregory's series is
    summed."""
    if ratio > ONE:
        return 2 * arctangent(over(fixed_point_root(times(ratio, ratio) + ONE) - ONE, ratio))
    halvings = 0
    while ratio > ONE >> 10:
        ratio = over(ratio, ONE + fixed_point_root(ONE + times(ratio, ratio)))
        halvings += 1
    square, power, total, odd = times(ratio, ratio), ratio, 0, 1
    while power:
        total += power // odd if odd % 4 == 1 else -(power // odd)
        power, odd = times(power, square), odd + 2
    return total << halvings


def exact_angle(start: Sequence[float], end: Sequence[float]) -> int:
    """Angle of the rotation between two quaternions: twice the angle between them, in rad."""
    a, b = [fixed(x) for x in start], [fixed(x) for x in end]
    along = sum(x * y for x, y in zip(a, b, strict=True))
    squares = sum(x * x for x in a) * sum(y * y for y in b)
    return 2 * arctangent((isqrt(squares - along * along) << BITS) // along)


def exact_blur(scale: float, focus: float, depth: float) -> int:
    """scale |s − Z| / ((s − 1) Z), lengths in focal lengths."""
    s, z = fixed(focus), fixed(depth)
    return over(times(fixed(scale), abs(s - z)), times(s - ONE, z))


def exact_pixel(
    rows: Sequence[Sequence[float]], point: Sequence[float], centre: Sequence[float]
) -> int:
    """X/Z of a point turned by the first and the last row of a rotation, seen from ``centre``."""
    away = [fixed(p) - fixed(c) for p, c in zip(point, centre, strict=True)]
    x, z = (sum(times(fixed(r), d) for r, d in zip(row, away, strict=True)) for row in rows)
    return over(x, z)


def exact_radius(k1: float, distorted: float, guess: float) -> int:
    """The inner solution of r (1 + k₁ r²) = r_d by Newton's steps from a double near it."""
    k, target, r = fixed(k1), fixed(distorted), fixed(guess)
    for _ in range(9):
        square = times(r, r)
        missing = times(r, ONE + times(k, square)) - target
        r -= over(missing, ONE + 3 * times(k, square))
    return r


def relative_error(found: float, truth: int) -> float:
    """|found − truth| / |truth|; 1, with no right digit, for NaN."""
    if found != found or abs(found) == float("inf"):
        return 1.0
    return over(abs(fixed(found) - truth), abs(truth)) / ONE
