"""Checks of whole numbers: counts, qualities, sizes in pixels."""

import math

from simulations.models.require import require


def as_whole(name: str, value: float, least: int, most: int | None = None) -> int:
    """``value`` as an int; 50.0 is accepted as 50. Raises `ValueError`, naming the parameter, its
    value and the legal range, for fractions, NaN, infinities and numbers outside ``least`` to
    ``most``.
    """
    whole = math.isfinite(value) and value == math.floor(value)
    inside = least <= value and (most is None or value <= most)
    legal = f"{least} or more" if most is None else f"{least} to {most}"
    require(name, value, whole and inside, f"whole numbers, {legal}")
    return int(value)
