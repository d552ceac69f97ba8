"""Measured numbers as a reader wants them: two digits, decimals where short, else powers of ten."""

from simulations.engine.frame import format_number, power_of_ten
from site_builder.languages.words import ENGLISH, Words

NARROW_SPACE = "\u202f"


def quantity(value: float, digits: int = 2) -> str:
    """A finite ``value`` to ``digits`` significant digits: 1400, 0.41, 6.2 × 10⁻⁵, −3."""
    if value == 0.0:
        return "0"
    mantissa, _, exponent = f"{abs(value):.{digits - 1}e}".partition("e")
    power = int(exponent)
    if -3 <= power < 5:
        text = f"{float(f'{mantissa}e{power}'):.{max(digits - 1 - power, 0)}f}"
    else:
        text = f"{mantissa}{NARROW_SPACE}×{NARROW_SPACE}{power_of_ten(power)}"
    return f"−{text}" if value < 0 else text


def milliseconds(value: float) -> str:
    """A time without its unit: two digits, three from 100 on."""
    return quantity(value, 2 if value < 100 else 3)


def error_text(value: float | None, unit: str, words: Words = ENGLISH) -> str:
    """An error without its unit; ratios in decibels to a tenth; ``none`` where there is none."""
    if is_none(value, unit):
        return words("ladder.none")
    if value is None:
        return "∞"
    return words.numeral(format_number(value, 1) if unit == "dB" else quantity(value))


def is_none(value: float | None, unit: str) -> bool:
    """Whether an error is none at all, which has no unit."""
    return unit != "dB" and not value


def with_unit(text: str, unit: str) -> str:
    """``16.0 px``, on one line; degrees stand close, and what has no unit stands alone."""
    space = "" if unit in ("", "°") else "\u00a0"
    return f"{text}{space}{unit}"
