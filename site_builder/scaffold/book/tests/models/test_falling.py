"""A fall through air, against what is known without the model."""

import numpy as np
import pytest

from simulations.models.falling import GRAVITY_M_S2, RULES, in_steps, speed


def test_at_first_it_falls_freely() -> None:
    np.testing.assert_allclose(speed(0.001, 50.0), GRAVITY_M_S2 * 0.001, rtol=1e-7)


def test_after_long_it_has_its_terminal_speed() -> None:
    np.testing.assert_allclose(speed(1e4, 30.0), 30.0, rtol=1e-15)


def test_its_speed_obeys_the_law_of_motion() -> None:
    time, step, terminal = 1.7, 1e-4, 25.0
    slope = (speed(time + step, terminal) - speed(time - step, terminal)) / (2 * step)
    law = GRAVITY_M_S2 * (1 - (speed(time, terminal) / terminal) ** 2)
    np.testing.assert_allclose(slope, law, rtol=1e-7)


@pytest.mark.parametrize(("rule", "order"), [("euler", 1), ("middle", 2), ("classic", 4)])
def test_twice_the_steps_leave_the_share_that_the_rule_s_order_says(rule: str, order: int) -> None:
    terminal = np.array([20.0, 40.0])
    errors = [
        np.abs(in_steps(rule, steps, 2.0, terminal) - [speed(2.0, each) for each in terminal])
        for steps in (32, 64)
    ]
    np.testing.assert_allclose(errors[0] / errors[1], 2.0**order, rtol=0.15)


def test_every_rule_is_tested() -> None:
    assert set(RULES) == {"euler", "middle", "classic"}


@pytest.mark.parametrize("terminal", [0.0, -1.0])
def test_a_terminal_speed_that_cannot_be_is_refused(terminal: float) -> None:
    with pytest.raises(ValueError, match="legal: above 0"):
        speed(1.0, terminal)


def test_an_unknown_rule_is_refused() -> None:
    with pytest.raises(ValueError, match="'leap'; legal: euler, middle, classic"):
        in_steps("leap", 4, 1.0, np.array([10.0]))
