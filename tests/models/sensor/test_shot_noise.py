"""Counted electrons: their distribution, their well, and quicker models of both."""

import numpy as np
import pytest
from numpy.typing import DTypeLike
from scipy import stats

from simulations.models.sensor.photon_counting import (
    LARGEST_WELL_E,
    SHOT_MODELS,
    Sensor,
    ShotModel,
    expose,
    shot_noise,
    shot_noise_from_normal,
)


def rng() -> np.random.Generator:
    return np.random.default_rng(7)


@pytest.mark.parametrize("model", SHOT_MODELS)
def test_no_light_frees_no_electron_and_any_light_is_held_by_the_well(model: ShotModel) -> None:
    held = shot_noise([0.0, 1e9, 1e300, np.inf], rng(), 1000.0, model)
    np.testing.assert_array_equal(held, [0, 1000, 1000, 1000])
    # Without a well, as much as a sampler can draw.
    assert shot_noise([1e300, np.inf], rng(), model=model) == pytest.approx([1e13, 1e13], rel=1e-5)


@pytest.mark.parametrize("model", SHOT_MODELS)
@pytest.mark.parametrize("mean", [30.0, 400.0])
def test_every_model_of_shot_noise_has_the_mean_and_variance_of_poisson(
    model: ShotModel, mean: float
) -> None:
    counted = shot_noise(np.full(200_000, mean), rng(), model=model)
    assert np.array_equal(counted, np.rint(counted))
    assert counted.mean() == pytest.approx(mean, abs=5 * np.sqrt(mean / 200_000))
    assert counted.var() == pytest.approx(mean, rel=0.02)


@pytest.mark.parametrize("model", ["skewed", "gaussian"])
def test_an_approximation_frees_no_negative_electrons_and_none_in_the_dark(
    model: ShotModel,
) -> None:
    assert shot_noise(np.full(10_000, 0.05), rng(), model=model).min() == 0
    assert shot_noise(np.zeros(10_000), rng(), model=model).max() == 0


def test_a_well_spills_what_it_cannot_hold() -> None:
    counted = shot_noise(np.full(50_000, 100.0), rng(), 100.0)
    assert counted.max() == 100
    assert np.mean(counted == 100) == pytest.approx(stats.poisson.sf(99, 100), abs=0.01)


def test_normals_drawn_beforehand_give_the_counts_of_the_same_draws() -> None:
    mean = np.linspace(0, 1500, 4000, dtype=np.float32)
    z = rng().standard_normal(mean.shape, np.float32)
    counted = shot_noise_from_normal(mean, z, 1000.0)
    np.testing.assert_array_equal(counted, shot_noise(mean, rng(), 1000.0, model="quantile"))
    assert counted[0] == 0
    assert counted.max() == 1000


def test_the_second_term_leans_counts_to_the_right() -> None:
    """Cornish and Fisher: m + sqrt(m) z + (z^2 - 1) / 6, rounded."""
    z = rng().standard_normal(1000)
    expected = np.rint(100 + 10 * z + (z**2 - 1) / 6)
    drawn = shot_noise(np.full(1000, 100.0), rng(), model="skewed")
    np.testing.assert_array_equal(drawn, expected)


@pytest.mark.parametrize("mean", [1e9, 1e11, LARGEST_WELL_E])
def test_up_to_the_largest_well_the_variance_is_the_mean(mean: float) -> None:
    """Above it the sampler loses digits: 2 % at 3e13. A million counts tell 0.14 %."""
    counted = shot_noise(np.full(1_000_000, mean), rng()) - mean
    assert counted.var() / mean == pytest.approx(1, abs=0.006)
    assert abs(counted.mean()) < 4e-3 * np.sqrt(mean)


@pytest.mark.parametrize("kind", [np.float32, np.float64])
def test_light_beyond_all_numbers_is_infinite_and_fills_the_well(kind: DTypeLike) -> None:
    mean = expose(np.full(3, 1e30, kind), 1e300, Sensor())
    assert mean.dtype == kind
    assert np.isinf(mean).all()
    assert (shot_noise(mean, rng(), 20_000.0) == 20_000).all()
