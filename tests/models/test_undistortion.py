"""The cheap inverses of a lens err as their theory says, and find what distort started from."""

import numpy as np
import pytest

from simulations.models.distortion import Distortion, distort
from simulations.models.undistortion import (
    undistort_bracketed,
    undistort_first_order,
    undistort_fixed_point,
    undistort_newton,
    undistort_table,
)

RADII = np.stack((np.linspace(0.01, 0.9, 50), np.zeros(50)), axis=-1)
SCATTERED = np.random.default_rng(0).uniform(-0.5, 0.5, (200, 2))


def test_first_order_errs_by_twice_k1_squared_times_the_fifth_power_of_the_radius():
    lens = Distortion(k1=1e-3)
    error = RADII - undistort_first_order(distort(RADII, lens), lens)
    np.testing.assert_allclose(error[:, 0], 2e-6 * RADII[:, 0] ** 5, rtol=0.01)


def test_a_fixed_point_step_shrinks_the_error_by_the_slope_of_its_map():
    lens, radius = Distortion(k1=-0.2), 0.7
    seen = distort(np.array([radius, 0.0]), lens)
    errors = [undistort_fixed_point(seen, lens, steps)[0] - radius for steps in (11, 12)]
    slope = 2 * lens.k1 * radius**2 / (1 + lens.k1 * radius**2)
    assert abs(errors[1] / errors[0]) == pytest.approx(abs(slope), rel=1e-2)


def test_a_newton_step_squares_the_error():
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
def test_points_all_over_the_picture_come_back(undo, within, k1, k2):
    lens = Distortion(k1=k1, k2=k2)
    np.testing.assert_allclose(undo(distort(SCATTERED, lens), lens), SCATTERED, atol=within)


def test_a_table_reads_from_1025_entries_and_errs_a_quarter_with_twice_as_many():
    lens = Distortion(k1=0.2)
    seen = distort(RADII, lens)
    worst = [np.abs(undistort_table(seen, lens, n) - RADII).max() for n in (129, 257, 513)]
    assert worst[0] / worst[1] == pytest.approx(4, rel=0.3)
    assert worst[1] / worst[2] == pytest.approx(4, rel=0.3)
    np.testing.assert_array_equal(undistort_table(seen, lens), undistort_table(seen, lens, 1025))


@pytest.mark.parametrize(
    ("lens", "furthest", "reach"),
    [
        (Distortion(k1=0.5), 1.2, 1.0),  # the image of 1 is 1.5 ...
        (Distortion(k1=0.5), 1.5, 1.0),
        (Distortion(k1=0.5), 1.6, 1.25),
        (Distortion(k1=0.5), 4.0, 1.25**3),  # ... that of 1.25³ is 5.7, that of 1.25² is 3.5
        (Distortion(k1=1.0, k4=2.0), 0.6, 1.0),  # that of 1 is 2/3
    ],
)
def test_without_a_fold_the_entries_end_at_1_or_a_power_of_five_quarters(lens, furthest, reach):
    """What is read right at the entries is exact."""
    radii = np.linspace(0.0, reach, 1025)[1:]
    images = distort(np.stack((radii, 0 * radii), -1), lens)
    seen = np.concatenate((images[images[:, 0] < furthest], [[furthest, 0.0]]))
    found = undistort_table(seen, lens)[:-1, 0]
    np.testing.assert_allclose(found, radii[: found.size], rtol=1e-14)


def test_a_table_without_a_fold_ends_a_quarter_beyond_the_furthest_point_at_most():
    """The step of interpolation is then known, and so is its error: step² f″ / (8 f′)."""
    lens, seen = Distortion(k1=0.05), np.array([[30.0, 0.0]])
    radius = undistort_newton(seen, lens, 60)[0, 0]
    step = 1.25 * radius / 1024
    bound = step**2 * 6 * lens.k1 * radius / (8 * (1 + 3 * lens.k1 * radius**2))
    near = np.linspace(0.99 * radius, radius, 400)
    images = distort(np.stack((near, 0 * near), -1), lens)
    assert np.abs(undistort_table(images, lens)[:, 0] - near).max() < 1.05 * bound


def test_a_table_ends_at_the_fold():
    lens = Distortion(k1=-0.5)  # folds at r = 0.816
    inside = RADII[RADII[:, 0] < 0.75]
    np.testing.assert_allclose(undistort_table(distort(inside, lens), lens), inside, atol=1e-5)


@pytest.mark.parametrize("run", [undistort_newton, undistort_fixed_point])
def test_the_axis_stays_where_it_is(run):
    assert run(np.zeros(2), Distortion(k1=-0.3), 3).tolist() == [0.0, 0.0]
    assert undistort_table(np.zeros((1, 2)), Distortion(k1=0.3)).tolist() == [[0.0, 0.0]]
    assert undistort_bracketed(np.zeros((1, 2)), Distortion(k1=0.3)).tolist() == [[0.0, 0.0]]
    assert undistort_table(np.zeros((0, 2)), Distortion(k1=0.3)).shape == (0, 2)


def test_fixed_point_diverges_in_strong_pincushion_where_newton_does_not():
    lens, ideal = Distortion(k1=1.0), np.array([1.5, 0.0])
    seen = distort(ideal, lens)
    assert abs(undistort_fixed_point(seen, lens, 200)[0] - 1.5) > 0.1
    assert undistort_newton(seen, lens, 12)[0] == pytest.approx(1.5, abs=1e-12)
