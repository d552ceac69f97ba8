"""Damped steps, against SciPy's and against closed forms."""

import numpy as np
from scipy.optimize import least_squares

from simulations.models.arrays import Floats
from simulations.models.least_squares import levenberg_marquardt


def rosenbrock(at: Floats) -> tuple[Floats, Floats]:
    x, y = at
    return np.array([10 * (y - x * x), 1 - x]), np.array([[-20 * x, 10], [-1, 0.0]])


def test_a_curved_valley_is_followed_to_its_end() -> None:
    found = levenberg_marquardt(rosenbrock, np.add, np.array([-1.2, 1.0]), rounds=100)
    np.testing.assert_allclose(found, (1.0, 1.0), atol=1e-8)


def test_a_curve_is_fitted_as_by_scipy() -> None:
    rng = np.random.default_rng(3)
    t = np.linspace(0, 4, 40)
    y = 2.0 * np.exp(-0.7 * t) + rng.normal(0, 0.05, 40)

    def residuals(at: Floats) -> tuple[Floats, Floats]:
        decay = np.exp(-at[1] * t)
        return at[0] * decay - y, np.column_stack([decay, -at[0] * t * decay])

    found = levenberg_marquardt(residuals, np.add, np.array([1.0, 0.1]))
    expected = least_squares(lambda at: residuals(at)[0], (1.0, 0.1), xtol=1e-14, ftol=1e-14)
    np.testing.assert_allclose(found, expected.x, rtol=1e-6)


def test_an_unknown_that_changes_nothing_stays() -> None:
    def residuals(at: Floats) -> tuple[Floats, Floats]:
        return at[:1] - 3.0, np.array([[1.0, 0.0]])

    found = levenberg_marquardt(residuals, np.add, np.array([0.0, 7.0]))
    np.testing.assert_allclose(found, (3.0, 7.0), atol=1e-6)


def test_no_step_makes_the_sum_larger() -> None:
    """From a start where the full step of Gauss and Newton diverges."""

    def residuals(at: Floats) -> tuple[Floats, Floats]:
        return np.arctan(at), np.diag(1.0 / (1.0 + at * at))

    found = levenberg_marquardt(residuals, np.add, np.array([5.0]))
    np.testing.assert_allclose(found, 0.0, atol=1e-5)
