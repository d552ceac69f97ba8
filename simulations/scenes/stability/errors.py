"""Errors of two computations of a formula, by distance from its singularity.

At each distance some random inputs are rounded to the format and then taken as exact. The largest
error counts, as a single rounding may be lucky.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from simulations.models.arrays import Floats
from simulations.scenes.stability import formulas, truth
from simulations.scenes.stability.settings import LOWEST, STEP

DISTANCES: Floats = np.array(
    [float(f"{10.0**power:.4g}") for power in np.arange(LOWEST, 0.1, STEP)]
)
"""(n,) distances from the singularity, nearest first."""
DRAWS = 8
NOTHING_RIGHT = 1.0
NEAREST_SPACINGS = 4
"""Relative spacing of the format: numbers closer than this may round to the same."""


@dataclass(frozen=True, slots=True)
class Errors:
    """Largest relative errors (n,) at `DISTANCES`; NaN if the format has no inputs that near."""

    written: Floats
    rearranged: Floats
    bound: Floats
    """κ u: the error from rounding the inputs once."""


def errors_of(formula: str, digits: str) -> Errors:
    """The curves of one formula in one format."""
    kind = np.dtype(digits).type
    spacing = float(np.finfo(kind).eps)
    there = NEAREST_SPACINGS * spacing <= DISTANCES
    found = np.full((3, len(DISTANCES)), np.nan)
    found[:, there] = np.array([MEASURED[formula](x, kind) for x in DISTANCES[there].tolist()]).T
    written, rearranged, condition = found
    bound = np.maximum(condition, 1.0) * spacing / 2
    return Errors(*(np.minimum(each, NOTHING_RIGHT) for each in (written, rearranged, bound)))


type Kind = type[np.floating]
type Found = tuple[float, float, float]
"""Error as written, error rearranged, condition number κ."""


def _worst(found: Floats, exact: list[int]) -> float:
    pairs = zip(found.tolist(), exact, strict=True)
    return max(truth.relative_error(value, true) for value, true in pairs)


def _drawn(distance: float) -> np.random.Generator:
    return np.random.default_rng(round(-4 * np.log10(distance)))


def _angle(distance: float, kind: Kind) -> Found:
    """Pairs of quaternions half of the rotation θ apart; ``distance`` is 2 tan θ/2."""
    rng = _drawn(distance)
    start = _unit(rng.uniform(0.2, 1.0, (DRAWS, 4)))
    aside = rng.uniform(-1.0, 1.0, (DRAWS, 4))
    across = _unit(aside - (aside * start).sum(axis=-1, keepdims=True) * start)
    end = _unit(start + distance / 2 * across)
    a, b = start.astype(kind), end.astype(kind)
    exact = [truth.angle(*pair) for pair in zip(a.tolist(), b.tolist(), strict=True)]
    with np.errstate(invalid="ignore"):
        written = formulas.angle_by_arccosine(a, b)
    return _worst(written, exact), _worst(formulas.angle_by_lengths(a, b), exact), 2.0 / distance


def _unit(q: Floats) -> Floats:
    return np.asarray(q / np.sqrt((q * q).sum(axis=-1, keepdims=True)))


def _blur(distance: float, kind: Kind) -> Found:
    """|Z − s| is ``distance`` s. Lengths in focal lengths, the lens focused at 40 to 80 of them."""
    focus = _drawn(distance).uniform(40.0, 80.0, DRAWS).astype(kind)
    depth = (focus * (1.0 + distance)).astype(kind)
    scale = np.full(DRAWS, 0.5, kind)
    triples = zip(scale.tolist(), focus.tolist(), depth.tolist(), strict=True)
    exact = [truth.blur(*triple) for triple in triples]
    return (
        _worst(formulas.blur_in_dioptres(scale, focus, depth), exact),
        _worst(formulas.blur_by_distances(scale, focus, depth), exact),
        1.0 / distance,
    )


ROWS: Floats = np.array([[0.8, 0.0, 0.6], [-0.6, 0.0, 0.8]])
"""The rotation from the world's axes to the camera's."""


def _origin(distance: float, kind: Kind) -> Found:
    """The point is 5 m to 10 m in front of a camera at 10 m / ``distance`` from the origin."""
    rng = _drawn(distance)
    depth = rng.uniform(5.0, 10.0, DRAWS)
    seen = np.stack([rng.uniform(0.2, 0.5, DRAWS) * depth, np.zeros(DRAWS), depth], axis=-1)
    centre = (10.0 / distance * np.array([0.64, 0.48, 0.6])).astype(kind)
    away = seen[:, :1] * ROWS[0] + seen[:, 2:] * ROWS[1]
    point, rows = (centre + away).astype(kind), ROWS.astype(kind)
    given = rows.tolist(), centre.tolist()
    exact = [truth.pixel(given[0], one, given[1]) for one in point.tolist()]
    with np.errstate(divide="ignore", invalid="ignore"):
        written = formulas.pixel_from_origin(rows, point, centre)
    return (
        _worst(written, exact),
        _worst(formulas.pixel_from_camera(rows, point, centre), exact),
        1.0 / distance,
    )


def _fold(distance: float, kind: Kind) -> Found:
    """r_d is short of its largest value by this share of it."""
    spread = _drawn(distance).uniform(0.8, 1.2, DRAWS)
    inside = 1.0 - np.minimum(distance * spread, 1.0 - 1e-3)
    seen = (formulas.LARGEST_SEEN * inside).astype(kind)
    start = formulas.radius_by_many_steps(seen.astype(np.float64)).tolist()
    k1 = float(kind(formulas.K1))
    pairs = zip(seen.tolist(), start, strict=True)
    exact = [truth.ideal_radius(k1, r_d, guess) for r_d, guess in pairs]
    r = np.array([true / truth.ONE for true in exact])
    condition = (1.0 + k1 * r**2) / (1.0 + 3.0 * k1 * r**2)
    return (
        _worst(formulas.radius_by_few_steps(seen), exact),
        _worst(formulas.radius_by_many_steps(seen), exact),
        float(np.abs(condition).max()),
    )


MEASURED: Mapping[str, Callable[[float, Kind], Found]] = {
    "angle": _angle,
    "blur": _blur,
    "origin": _origin,
    "fold": _fold,
}
