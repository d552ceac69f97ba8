"""References of the formulas for given floating-point numbers, by whole-number arithmetic.

A floating-point number is a whole number times a power of two. Sums and products of such numbers
are exact here; a quotient, a root or an arctangent is cut after `BITS` binary places, of which a
double has 53. So the reference has none of the rounding under test.
"""

from collections.abc import Sequence
from math import isqrt

BITS = 256
ONE = 1 << BITS


def fixed(value: float) -> int:
    """A number in units of 2⁻²⁵⁶; exact for every double of size 2⁻²⁰³ or more."""
    above, below = float(value).as_integer_ratio()
    return (above << BITS) // below


def times(a: int, b: int) -> int:
    return a * b >> BITS


def over(a: int, b: int) -> int:
    return (a << BITS) // b


def root(a: int) -> int:
    return isqrt(a << BITS)


def arctangent(ratio: int) -> int:
    """Arctangent of 0 or more: the argument is halved until it is small, then Gregory's series is
    summed."""
    if ratio > ONE:
        return 2 * arctangent(over(root(times(ratio, ratio) + ONE) - ONE, ratio))
    halvings = 0
    while ratio > ONE >> 10:
        ratio = over(ratio, ONE + root(ONE + times(ratio, ratio)))
        halvings += 1
    square, power, total, odd = times(ratio, ratio), ratio, 0, 1
    while power:
        total += power // odd if odd % 4 == 1 else -(power // odd)
        power, odd = times(power, square), odd + 2
    return total << halvings


def angle(start: Sequence[float], end: Sequence[float]) -> int:
    """Angle of the rotation between two quaternions: twice the angle between them, in rad."""
    a, b = [fixed(x) for x in start], [fixed(x) for x in end]
    along = sum(x * y for x, y in zip(a, b, strict=True))
    squares = sum(x * x for x in a) * sum(y * y for y in b)
    across = isqrt(squares - along * along)
    return 2 * arctangent((across << BITS) // along)


def blur(scale: float, focus: float, depth: float) -> int:
    """scale |s − Z| / ((s − 1) Z), lengths in focal lengths."""
    s, z = fixed(focus), fixed(depth)
    return over(times(fixed(scale), abs(s - z)), times(s - ONE, z))


def pixel(rows: Sequence[Sequence[float]], point: Sequence[float], centre: Sequence[float]) -> int:
    """X/Z of a point turned by the first and the last row of a rotation, seen from ``centre``."""
    away = [fixed(p) - fixed(c) for p, c in zip(point, centre, strict=True)]
    x, z = (sum(times(fixed(r), d) for r, d in zip(row, away, strict=True)) for row in rows)
    return over(x, z)


def ideal_radius(k1: float, seen: float, guess: float) -> int:
    """The inner solution of r (1 + k₁ r²) = r_d by Newton's steps from a double near it."""
    k, wanted, r = fixed(k1), fixed(seen), fixed(guess)
    for _ in range(9):
        square = times(r, r)
        missing = times(r, ONE + times(k, square)) - wanted
        r -= over(missing, ONE + 3 * times(k, square))
    return r


def relative_error(found: float, truth: int) -> float:
    """|found − truth| / |truth|; 1, with no right digit, for NaN."""
    if found != found or abs(found) == float("inf"):
        return 1.0
    return over(abs(fixed(found) - truth), abs(truth)) / ONE
