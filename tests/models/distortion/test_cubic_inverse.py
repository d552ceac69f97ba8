"""The formula for a lens of k₁ alone: against arithmetic of sixty digits, and where it ends."""

from decimal import Decimal, localcontext

import numpy as np
import pytest

from simulations.models.distortion.cubic_inverse import shrinkage, shrinkage_of_cubic
from simulations.models.distortion.radial_profile import RadialProfile, largest_image_radius


def error_in_conditions(k1: float, image_squared: float) -> float:
    """Relative error in units of 2⁻⁵³ times the condition, by Newton's method in sixty digits."""
    found = float(shrinkage_of_cubic(k1, np.array(image_squared)))
    with localcontext(prec=60):
        k, seen = Decimal(k1), Decimal(image_squared).sqrt()
        r = Decimal(found) * seen
        for _ in range(9):
            r -= (r + k * r**3 - seen) / (1 + 3 * k * r * r)
        condition = seen / (r * (1 + 3 * k * r * r))
        return float(abs(Decimal(found) * seen / r - 1) / condition) * 2.0**53


@pytest.mark.parametrize("k1", [-50.0, -0.3, -1e-9])
def test_barrels_are_undone_to_three_units_of_the_condition(k1: float) -> None:
    limit = largest_image_radius(RadialProfile((k1,)))
    shares = [*np.logspace(-100, -2, 50), *np.linspace(0.02, 0.99, 60), 0.9999, 1 - 1e-9]
    assert max(error_in_conditions(k1, (limit * each) ** 2) for each in shares) < 3.5


@pytest.mark.parametrize(("k1", "most"), [(1e-9, 3.5), (0.2, 10.0), (1.5, 12.0), (1e6, 22.0)])
def test_pincushions_are_undone_to_a_logarithm_of_how_strong_they_are(
    k1: float, most: float
) -> None:
    radii = [*np.logspace(-100, -2, 50), *np.linspace(0.02, 40.0, 60)]
    assert max(error_in_conditions(k1, each**2) for each in radii) < most


def test_it_vouches_for_nothing_at_the_fold_and_beyond() -> None:
    profile = RadialProfile((-1 / 3,))  # folds at 1, whose image is 2/3
    images = np.array([0.1, 0.666, 2 / 3, 0.7, np.inf, np.nan])
    factor, known = shrinkage(profile, images**2)
    assert known.tolist() == [True, True, False, False, False, False]
    assert factor[2:].tolist() == [1.0] * 4
    np.testing.assert_allclose((factor * images)[:2], [0.10034, 0.97407], rtol=1e-3)
