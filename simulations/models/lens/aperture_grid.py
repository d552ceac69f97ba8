"""A square grid of points on a lens: the rays of a reference picture, unlike those of any tier."""

import math

from simulations.models.whole_numbers import as_whole

type Point = tuple[float, float]
"""(right, down) in the unit disc."""

GOLDEN_RATIO = (1.0 + math.sqrt(5.0)) / 2.0


def aperture_grid(across: int) -> tuple[Point, ...]:
    """The points of an ``across`` by ``across`` grid that lie in the unit disc.

    They are ordered so that any first few of them are spread over the disc. Raises `ValueError` for
    a grid of no points.
    """
    across = as_whole("across", across, 1)
    places = [(2 * index + 1) / across - 1 for index in range(across)]
    inside = [(x, y) for y in places for x in places if x * x + y * y <= 1.0]
    stride = _coprime_near(len(inside) / GOLDEN_RATIO, len(inside))
    return tuple(inside[index * stride % len(inside)] for index in range(len(inside)))


def _coprime_near(wanted: float, modulus: int) -> int:
    candidates = (step for step in range(1, modulus + 1) if math.gcd(step, modulus) == 1)
    return min(candidates, key=lambda step: abs(step - wanted))
