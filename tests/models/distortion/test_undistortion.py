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


@pytest.mark.parametrize("k1", [-0.35, -0.2, -0.01, 0.2, 0.5, 1.5])
def test_where_newton_starts_is_worth_more_than_a_factor_of_five(k1: float) -> None:
    """Than the point as it is seen: for barrels, and pincushions as strong as the book has."""
    lens = Distortion(k1=k1)
    seen = distort(RADII, lens)
    r = plain = seen[:, 0]
    for _ in range(3):
        plain = plain - (plain + k1 * plain**3 - r) / (1 + 3 * k1 * plain**2)
    errors = [
        np.abs(found - RADII[:, 0]).max()
        for found in (undistort_newton(seen, lens, 3)[:, 0], plain)
    ]
    assert errors[0] < 0.2 * errors[1] or errors[0] < 1e-14


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


def test_a_table_reads_from_1025_entries_and_errs_a_quarter_with_twice_as_many() -> None:
    lens = Distortion(k1=0.2)
    seen = distort(RADII, lens)
    worst = [np.abs(undistort_table(seen, lens, n) - RADII).max() for n in (129, 257, 513)]
    assert worst[0] / worst[1] == pytest.approx(4, rel=0.3)
    assert worst[1] / worst[2] == pytest.approx(4, rel=0.3)
    np.testing.assert_array_equal(undistort_table(seen, lens), undistort_table(seen, lens, 1025))


@pytest.mark.parametrize(
    ("lens", "furthest"),
    [
        (Distortion(k1=0.5), 1.2),
        (Distortion(k1=0.5), 1.6),  # the image of 1 is 1.5
        (Distortion(k1=0.5), 40.0),
        (Distortion(k1=1.0, k4=2.0), 0.6),  # that of 1 is 2/3
        (Distortion(k1=-0.3), 0.65),
    ],
)
def test_the_entries_lie_evenly_over_the_squared_radius_out_to_the_furthest_point(
    lens: Distortion, furthest: float
) -> None:
    """At the entries only the reading of the forward map errs, a sixteenth of what is between."""
    squares = np.linspace(0.0, furthest**2, 1025)
    middles = 0.5 * (squares[:-1] + squares[1:])
    at_entries, between = (
        undistort_table(np.stack((np.sqrt(t), 0 * t), -1), lens)
        for t in (squares, np.append(middles, furthest**2))
    )
    truth = [
        undistort_bracketed(np.stack((np.sqrt(t), 0 * t), -1), lens) for t in (squares, middles)
    ]
    off, off_between = np.abs(at_entries - truth[0]).max(), np.abs(between[:-1] - truth[1]).max()
    assert 0 < off < 0.3 * off_between


def test_a_table_ends_at_the_fold() -> None:
    lens = Distortion(k1=-0.5)  # folds at r = 0.816
    inside = RADII[RADII[:, 0] < 0.75]
    np.testing.assert_allclose(undistort_table(distort(inside, lens), lens), inside, atol=1e-5)


@pytest.mark.parametrize("run", [undistort_newton, undistort_fixed_point])
def test_the_axis_stays_where_it_is(run: Callable[..., Floats]) -> None:
    assert run(np.zeros(2), Distortion(k1=-0.3), 3).tolist() == [0.0, 0.0]
    assert undistort_table(np.zeros((1, 2)), Distortion(k1=0.3)).tolist() == [[0.0, 0.0]]
    assert undistort_bracketed(np.zeros((1, 2)), Distortion(k1=0.3)).tolist() == [[0.0, 0.0]]
    assert undistort_table(np.zeros((0, 2)), Distortion(k1=0.3)).shape == (0, 2)


def test_fixed_point_diverges_in_strong_pincushion_where_newton_does_not() -> None:
    lens, ideal = Distortion(k1=1.0), np.array([1.5, 0.0])
    seen = distort(ideal, lens)
    assert abs(undistort_fixed_point(seen, lens, 200)[0] - 1.5) > 0.1
    assert undistort_newton(seen, lens, 12)[0] == pytest.approx(1.5, abs=1e-12)


@pytest.mark.parametrize("name", [name for name in INVERSES if name[-1].isdigit()])
def test_a_name_of_the_table_that_ends_in_a_number_takes_so_many_steps(name: str) -> None:
    kind, _, steps = name.rpartition("-")
    run = {"newton": undistort_newton, "fixed-point": undistort_fixed_point}[kind]
    lens = Distortion(k1=-0.2)
    np.testing.assert_array_equal(INVERSES[name](RADII, lens), run(RADII, lens, int(steps)))


@pytest.mark.parametrize("name", ["closed-form", "checked-table", "newton-bracketed"])
def test_the_careful_ones_put_what_lies_past_the_fold_on_it(name: str) -> None:
    lens = Distortion(k1=-0.5)
    inside = RADII[RADII[:, 0] < 0.8]
    seen = np.concatenate((distort(inside, lens), [[0.0, 0.6], [1.5, 0.0]]))
    fold = fold_radius(lens)
    expected = np.concatenate((inside, [[0.0, fold], [fold, 0.0]]))
    np.testing.assert_allclose(INVERSES[name](seen, lens), expected, atol=1e-12)
