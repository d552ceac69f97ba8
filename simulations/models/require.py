"""Checks of parameters; errors state the name, the value, and what is legal.

See `arrays` for shapes of arrays.
"""

import math
from collections.abc import Collection

import numpy as np

MOST_SHOWN = 16
"""Numbers of an array; of a larger one the shape is told."""


def require(name: str, value: object, holds: bool | np.bool_, legal: str) -> None:
    """Raises `ValueError`, ``name value; legal: …``, unless the condition holds."""
    if not holds:
        raise ValueError(f"{name} {_value_text(value)}; legal: {legal}")


def require_positive(name: str, value: float) -> None:
    """Raises `ValueError` for 0, negative numbers, NaN and infinity."""
    require(name, value, 0 < value < math.inf, "above 0, finite")


def require_one_of(name: str, value: str, legal: Collection[str]) -> None:
    """Raises `ValueError` for a word that is not legal."""
    require(name, value, value in legal, ", ".join(legal))


def _value_text(value: object) -> str:
    if isinstance(value, np.ndarray):
        return str(value.tolist()) if value.size <= MOST_SHOWN else f"of shape {value.shape}"
    return repr(value) if isinstance(value, str) else str(value)


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
