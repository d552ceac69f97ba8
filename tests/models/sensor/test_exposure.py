"""Means over the exposure, of pictures whose mean is known."""

from typing import Any

import numpy as np
import pytest

from simulations.models.arrays import Floats
from simulations.models.sensor.exposure import (
    mean_of_instants,
    mean_of_jittered_instants,
    mean_of_random_instants,
)


def ramp(time: float) -> Floats:
    """Three pixels that brighten at unlike rates: their mean is what they are halfway."""
    return np.multiply.outer(np.ones(2), [0.0, 1.0, 3.0]) * time


@pytest.mark.parametrize("count", [1, 2, 7])
def test_even_change_is_averaged_exactly(count: int) -> None:
    np.testing.assert_allclose(mean_of_instants(ramp, count), ramp(0.5), atol=1e-15)


def test_each_instant_is_the_middle_of_its_share() -> None:
    asked: list[float] = []

    def note(time: float) -> Floats:
        asked.append(time)
        return np.zeros(1)

    mean_of_instants(note, 4)
    assert asked == [0.125, 0.375, 0.625, 0.875]


def test_a_square_is_short_by_the_midpoint_rules_error() -> None:
    """∫t² dt = 1/3, and n midpoints miss 1/(12 n²) of it."""
    for count in (1, 3, 10):
        found = mean_of_instants(lambda time: np.array([time * time]), count)
        assert found[0] == pytest.approx(1 / 3 - 1 / (12 * count**2), abs=1e-15)


def test_every_pixel_draws_times_of_its_own_over_the_whole_exposure() -> None:
    asked: list[Floats] = []
    rng = np.random.default_rng(3)

    def note(times: Floats) -> Floats:
        asked.append(times)
        return times

    mean_of_random_instants(note, 5, (40, 30), rng)
    times = np.array(asked)
    assert times.shape == (5, 40, 30)
    assert np.unique(times).size == times.size
    assert np.histogram(times, 10, (0, 1))[0] == pytest.approx(times.size / 10, rel=0.2)


def test_random_instants_are_right_on_average_and_off_by_the_root_of_their_count() -> None:
    rng = np.random.default_rng(4)
    found = mean_of_random_instants(lambda times: times, 16, (20_000,), rng)
    assert found.mean() == pytest.approx(0.5, abs=4 * np.sqrt(1 / 12 / 16 / 20_000))
    assert found.std() == pytest.approx(np.sqrt(1 / 12 / 16), rel=0.02)


def test_every_pixel_draws_one_jittered_time_in_each_share_of_the_exposure() -> None:
    asked: list[Floats] = []

    def note(times: Floats) -> Floats:
        asked.append(times)
        return times

    mean_of_jittered_instants(note, 5, (40, 30), np.random.default_rng(3))
    times = np.array(asked)
    assert np.unique(times).size == times.size
    np.testing.assert_array_equal(np.floor(5 * times), np.arange(5)[:, None, None] + 0 * times)


def test_jittered_instants_of_a_ramp_are_off_by_a_share_s_spread_over_the_root_of_their_count() -> (
    None
):
    rng = np.random.default_rng(4)
    found = mean_of_jittered_instants(lambda times: times, 16, (20_000,), rng)
    assert found.mean() == pytest.approx(0.5, abs=4 * np.sqrt(1 / 12 / 16**3 / 20_000))
    assert found.std() == pytest.approx(np.sqrt(1 / 12 / 16**3), rel=0.02)


def test_no_instant_is_refused() -> None:
    for refused in (0, -3):
        with pytest.raises(ValueError, match=f"count {refused}; legal: whole numbers, 1 or more"):
            mean_of_instants(ramp, refused)
        with pytest.raises(ValueError, match="legal: whole numbers, 1 or more"):
            mean_of_random_instants(lambda times: times, refused, (2, 3), np.random.default_rng(1))
        with pytest.raises(ValueError, match="legal: whole numbers, 1 or more"):
            mean_of_jittered_instants(lambda times: times, refused, (2,), np.random.default_rng(1))


def test_pictures_in_whole_codes_do_not_wrap_around() -> None:
    bright: Any = np.full(2, 200, np.uint8)
    np.testing.assert_array_equal(mean_of_instants(lambda _: bright, 3), 200.0)
