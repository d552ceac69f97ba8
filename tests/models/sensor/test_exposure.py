"""Means over the exposure, of pictures whose mean is known."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from simulations.models.arrays import Floats
from simulations.models.sensor.exposure import (
    mean_of_instants,
    mean_of_jittered_instants,
    mean_of_random_instants,
)


def test_a_square_is_short_by_the_midpoint_rules_error() -> None:
    """∫t² dt = 1/3, and n midpoints miss 1/(12 n²) of it."""
    for count in (1, 3, 10):
        found = mean_of_instants(lambda time: np.array([time * time]), count)
        assert found[0] == pytest.approx(1 / 3 - 1 / (12 * count**2), abs=1e-15)


def test_pictures_in_whole_codes_do_not_wrap_around() -> None:
    bright: Any = np.full(2, 200, np.uint8)
    np.testing.assert_array_equal(mean_of_instants(lambda _: bright, 3), 200.0)


@pytest.mark.parametrize(
    ("mean", "shares"),
    [(mean_of_random_instants, 1), (mean_of_jittered_instants, 5)],
    ids=["random", "one in each share"],
)
def test_every_pixel_draws_times_of_its_own(mean: Callable[..., Floats], shares: int) -> None:
    asked: list[Floats] = []

    def note(times: Floats) -> Floats:
        asked.append(times)
        return times

    found = mean(note, 5, (40, 30), np.random.default_rng(3))
    times = np.array(asked)
    assert times.shape == (5, 40, 30)
    assert np.unique(times).size == times.size
    assert np.histogram(times, 10, (0, 1))[0] == pytest.approx(times.size / 10, rel=0.2)
    np.testing.assert_allclose(found, times.mean(axis=0))
    share = np.floor(shares * times)
    assert (share == np.arange(5)[:, None, None] * (shares > 1)).all()
