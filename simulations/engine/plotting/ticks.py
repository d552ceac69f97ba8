"""Round numbers along an axis, and how they are written."""

import math

from simulations.engine.frame import power_of_ten

STEPS = (1, 2, 5, 10)
NEAR = 1e-9
"""Tolerance as a share of a step, so that ends get their tick despite rounding."""

type Tick = tuple[float, str]


def round_ticks(low: float, high: float, most: int = 6) -> tuple[Tick, ...]:
    """Multiples of 1, 2 or 5 times a power of ten from ``low`` to ``high``, at most ``most``."""
    if most < 2:
        raise ValueError(f"at most {most} ticks; two or more are legal")
    # There is one step fewer than there are ticks.
    rough = (high - low) / (most - 1)
    power = math.floor(math.log10(rough) + NEAR)
    step = next(s * 10.0**power for s in STEPS if s * 10.0**power >= rough * (1 - NEAR))
    first, last = math.ceil(low / step - NEAR), math.floor(high / step + NEAR)
    decimals = max(0, -math.floor(math.log10(step) + NEAR))
    values = [round(n * step, decimals) for n in range(first, last + 1)]
    return tuple((value, number_words(value)) for value in values)


def log_ticks(low: float, high: float, most: int = 6) -> tuple[Tick, ...]:
    """Powers of ten from ``low`` to ``high``, with 2 and 5 times them if there is space."""
    first, last = math.ceil(math.log10(low) - NEAR), math.floor(math.log10(high) + NEAR)
    decades = last - first + 1
    for factors in ((1, 2, 5), (1, 3)):
        values = [s * 10.0**n for n in range(first - 1, last + 1) for s in factors]
        inside = [v for v in values if low * (1 - NEAR) <= v <= high * (1 + NEAR)]
        if len(inside) <= most:
            return tuple((value, log_name(value)) for value in inside)
    every = max(1, math.ceil(decades / most))
    powers = [n for n in range(first, last + 1) if n % every == 0]
    plain = all(-3 <= n <= 4 for n in powers)
    return tuple((10.0**n, number_words(10.0**n) if plain else power_of_ten(n)) for n in powers)


def number_words(value: float) -> str:
    """``0.5``, ``−20``."""
    return f"{value:.10g}".replace("-", "\u2212")


def log_name(value: float) -> str:
    """``0.001``, ``200``, ``10⁻⁵``, ``2 × 10⁵``."""
    if 1e-3 * (1 - NEAR) <= value < 1e4 * (1 - NEAR):
        return number_words(float(f"{value:.6g}"))
    exponent = math.floor(math.log10(value) + NEAR)
    first = round(value / 10.0**exponent)
    power = power_of_ten(exponent)
    return power if first == 1 else f"{first}\u00a0×\u00a0{power}"
