"""What must be a whole number: counts, qualities, sizes in pixels."""

import math


def as_whole(name: str, value: float, least: int, most: int | None = None) -> int:
    """``value`` as an int; 50.0 will do for 50.

    Raises `ValueError`, naming the parameter, its value and the legal range, for fractions, NaN,
    infinities and numbers outside ``least`` to ``most``.
    """
    whole = math.isfinite(value) and value == math.floor(value)
    if not whole or value < least or (most is not None and value > most):
        legal = f"{least} or more" if most is None else f"{least} to {most}"
        raise ValueError(f"{name} {value}; legal: whole numbers, {legal}")
    return int(value)
