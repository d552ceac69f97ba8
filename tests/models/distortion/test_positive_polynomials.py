"""Whether a polynomial stays positive is decided, however narrow the dip."""

import numpy as np
import pytest
from numpy.polynomial import Polynomial

from simulations.models.distortion.positive_polynomials import stay_positive


def judged(*polynomials: Polynomial) -> list[bool]:
    size = max(polynomial.coef.size for polynomial in polynomials)
    rows = [np.pad(polynomial.coef, (0, size - polynomial.coef.size)) for polynomial in polynomials]
    return stay_positive(np.array(rows)).tolist()


T = Polynomial((0.0, 1.0))


@pytest.mark.parametrize(
    ("polynomial", "positive"),
    [
        (0.5 - T, False),
        (0.999 - T, False),
        (1.1 - T, True),
        (T - 0.1, False),
        (T + 0.1, True),
        ((T - 0.5) ** 2, False),
        ((T - 1 / 3) ** 2, False),
        (T, False),
        (1.0 - T, False),
        (Polynomial((1.0,)), True),
        (Polynomial((-1.0,)), False),
        (Polynomial((0.0,)), False),
    ],
    ids=str,
)
def test_a_root_from_0_to_1_is_noticed_and_one_beyond_not(
    polynomial: Polynomial, positive: bool
) -> None:
    assert judged(polynomial) == [positive]


@pytest.mark.parametrize("place", [0.03, 0.4, 2 / 3, 0.97])
@pytest.mark.parametrize("depth", [1e-4, 1e-9, 1e-12])
def test_a_dip_is_found_however_narrow(place: float, depth: float) -> None:
    """Between the roots of (t − c)² = δ it is negative; no sampling would meet that."""
    dip = Polynomial((-place, 1.0)) ** 2
    assert judged(dip - depth, dip + depth) == [False, True]


def test_random_polynomials_are_judged_as_by_their_roots() -> None:
    rng = np.random.default_rng(1)
    rows = rng.uniform(-1, 1, (3000, 9)) * 3.0 ** np.arange(9)
    rows[:, 0] = 1.0
    expected = []
    for row in rows:
        roots = np.roots(row[::-1])
        real = roots.real[np.abs(roots.imag) < 1e-9]
        expected.append(not ((real >= 0) & (real <= 1)).any())
    assert 0.1 < np.mean(expected) < 0.9
    np.testing.assert_array_equal(stay_positive(rows), expected)


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_what_is_not_a_number_is_not_positive_and_holds_up_no_other(bad: float) -> None:
    assert stay_positive(np.array([[1.0, bad], [1.0, 0.0]])).tolist() == [False, True]
