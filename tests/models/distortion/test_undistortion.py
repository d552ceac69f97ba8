"""The cheap inverses of a lens err as their theory says, and find what distort started from."""

from collections.abc import Callable

import numpy as np
import pytest

from simulations.models.arrays import Floats
from simulations.models.distortion.lens_model import Distortion, distort, fold_radius
from simulations.models.distortion.undistortion import (
    INVERSES,
    undistort_bracketed,
    undistort_first_order,
    undistort_fixed_point,
    undistort_newton,
    undistort_table,
)

RADII = np.stack((np.linspace(0.01, 0.9, 50), np.zeros(50)), axis=-1)
SCATTERED = np.random.default_rng(0).uniform(-0.5, 0.5, (200, 2))


def test_first_order_errs_by_twice_k1_squared_times_the_fifth_power_of_the_radius() -> None:
    lens = Distortion(k1=1e-3)
    error = RADII - undistort_first_order(distort(RADII, lens), lens)
    np.testing.assert_allclose(error[:, 0], 2e-6 * RADII[:, 0] ** 5, rtol=0.01)


def test_a_fixed_point_step_shrinks_the_error_by_the_slope_of_its_map() -> None:
    lens, radius = Distortion(k1=-0.2), 0.7
    seen = distort(np.array([radius, 0.0]), lens)
    errors = [undistort_fixed_point(seen, lens, steps)[0] - radius for steps in (11, 12)]
    slope = 2 * lens.k1 * radius**2 / (1 + lens.k1 * radius**2)
    assert abs(errors[1] / errors[0]) == pytest.approx(abs(slope), rel=1e-2)


def test_a_newton_step_squares_the_error() -> None:
    lens = Distortion(k1=-0.2)
    seen = distort(np.array([0.9, 0.0]), lens)
    errors = [abs(undistort_newton(seen, lens, steps)[0] - 0.9) for steps in (1, 2, 3)]
    ratios = np.log(errors[1:]) / np.log(errors[:-1])
    assert np.all(ratios > 1.7)


@pytest.mark.parametrize(("k1", "k2"), [(-0.3, 0.1), (0.2, 0.0), (0.0, -0.2)])
@pytest.mark.parametrize(
    ("undo", "within"),
    [
        (lambda xy, lens: undistort_fixed_point(xy, lens, 60), 1e-12),
        (lambda xy, lens: undistort_newton(xy, lens, 6), 1e-12),
        (undistort_table, 1e-6),
        (undistort_bracketed, 1e-14),
    ],
)
def test_points_all_over_the_picture_come_back(
    undo: Callable[..., Floats], within: float, k1: float, k2: float
) -> None:
    lens = Distortion(k1=k1, k2=k2)
    np.testing.assert_allclose(undo(distort(SCATTERED, lens), lens), SCATTERED, atol=within)


@pytest.mark.parametrize("name", ["closed-form", "checked-table", "newton-bracketed"])
def test_the_careful_ones_put_what_lies_past_the_fold_on_it(name: str) -> None:
    lens = Distortion(k1=-0.5)
    inside = RADII[RADII[:, 0] < 0.8]
    seen = np.concatenate((distort(inside, lens), [[0.0, 0.6], [1.5, 0.0]]))
    fold = fold_radius(lens)
    expected = np.concatenate((inside, [[0.0, fold], [fold, 0.0]]))
    np.testing.assert_allclose(INVERSES[name](seen, lens), expected, atol=1e-12)


@pytest.mark.parametrize("name", INVERSES)
def test_the_axis_stays_where_it_is(name: str) -> None:
    for lens in (Distortion(k1=-0.3), Distortion(k1=0.3)):
        assert INVERSES[name](np.zeros((1, 2)), lens).tolist() == [[0.0, 0.0]]
