"""A ball that falls through air, whose drag grows with the square of the speed."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

type Floats = NDArray[np.float64]

GRAVITY_M_S2 = 9.81


def speed(time_s: ArrayLike, terminal_m_s: float) -> Floats:
    """Metres a second (...), so many seconds (...) after it was let go.

    Raises `ValueError` for a terminal speed that is not above 0.
    """
    _check(terminal_m_s)
    time = np.asarray(time_s, float)
    return np.asarray(terminal_m_s * np.tanh(GRAVITY_M_S2 * time / terminal_m_s))


def in_steps(rule: str, steps: int, time_s: float, terminal_m_s: Floats) -> Floats:
    """The same at one time, for many terminal speeds (...), in equal steps.

    ``rule`` is ``euler``, ``middle`` or ``classic``, the rule of Runge and Kutta. Raises
    `ValueError` for another.
    """
    if rule not in RULES:
        raise ValueError(f"rule {rule!r}; legal: {', '.join(RULES)}")
    length = time_s / steps
    now = np.zeros_like(terminal_m_s)
    for _ in range(steps):
        now = now + length * RULES[rule](now, length, terminal_m_s)
    return now


def _acceleration(now: Floats, terminal: Floats) -> Floats:
    return np.asarray(GRAVITY_M_S2 * (1.0 - (now / terminal) ** 2))


def _euler(now: Floats, _length: float, terminal: Floats) -> Floats:
    return _acceleration(now, terminal)


def _middle(now: Floats, length: float, terminal: Floats) -> Floats:
    halfway = now + 0.5 * length * _acceleration(now, terminal)
    return _acceleration(halfway, terminal)


def _classic(now: Floats, length: float, terminal: Floats) -> Floats:
    first = _acceleration(now, terminal)
    second = _acceleration(now + 0.5 * length * first, terminal)
    third = _acceleration(now + 0.5 * length * second, terminal)
    fourth = _acceleration(now + length * third, terminal)
    return np.asarray((first + 2.0 * second + 2.0 * third + fourth) / 6.0)


RULES = {"euler": _euler, "middle": _middle, "classic": _classic}


def _check(terminal_m_s: float) -> None:
    if not terminal_m_s > 0:
        raise ValueError(f"terminal speed {terminal_m_s!r} m/s; legal: above 0")
