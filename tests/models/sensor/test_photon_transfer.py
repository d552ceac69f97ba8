"""A sensor’s parameters from flat fields, against the truth and a reference implementation."""

import dataclasses
import math

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.ndimage import convolve, uniform_filter
from support.charts import SENSOR, estimate_of, pairs_of

from simulations.models.arrays import Floats
from simulations.models.sensor.photon_counting import Sensor
from simulations.models.sensor.photon_transfer import estimate_gain, photon_transfer, straight_part
from simulations.models.sensor.photon_transfer_file import (
    Taken,
    camera_of,
    pair_up,
    planes_of,
    unevenness,
)
from simulations.models.sensor.photon_transfer_fit import black_of_dark, characterise, single_cells
from simulations.models.sensor.photon_transfer_pair import Level, measure_pair
from simulations.models.sensor.photon_transfer_standard import standard_estimates


def rng() -> np.random.Generator:
    return np.random.default_rng(7)


LEVELS = {
    "even": np.linspace(500, 15_000, 20),
    "by ratio": np.geomspace(10, 15_000, 20),
    "dim": np.linspace(100, 2000, 10),
    "up to the well": np.linspace(500, 20_000, 20),
    "at the well's edge": np.linspace(15_000, 20_000, 20),
    "one at the edge": np.array([500.0, 2000.0, 19_900.0]),
    "two": np.array([2000.0, 13_000.0]),
    "close together": np.array([5000.0, 5050.0, 9000.0]),
}


@pytest.mark.parametrize("levels", LEVELS.values(), ids=LEVELS)
@pytest.mark.parametrize("gain", [0.5, 20.0, 120.0, 400.0])
def test_gain_agrees_with_truth_within_four_errors_or_is_refused(
    gain: float, levels: Floats
) -> None:
    """No choice of levels and no coarseness of the codes gives a wrong gain without a refusal."""
    sensor, deviations = Sensor(gain_e_per_dn=gain, bits=16), []
    for seed in range(6):
        curve = photon_transfer(levels, sensor, np.random.default_rng(seed), samples=5000)
        try:
            found = estimate_gain(*curve, samples=5000)
        except ValueError:
            continue
        deviations.append((found.e_per_dn - gain) / found.error_e_per_dn)
        assert found.error_e_per_dn < 0.1 * found.e_per_dn
    assert np.all(np.abs(deviations) < 4)
    if levels is LEVELS["even"] and gain <= 50:
        assert len(deviations) == 6
    if levels is LEVELS["at the well's edge"] or gain == 400:
        assert not deviations


def test_straight_part_of_the_levels_follows_the_standard() -> None:
    mean = np.array([1.0, 10.0, 50.0, 70.0, 71.0, 100.0, 110.0])
    variance = np.array([0.4, 0.6, 3.0, 4.0, 4.1, 6.0, 1.0])
    assert straight_part(mean, variance).tolist() == [0, 1, 1, 1, 0, 0, 0]
    assert straight_part([], []).tolist() == []


def test_photon_transfer_curve_adds_the_variances_of_its_sources() -> None:
    sensor = Sensor(read_noise_e=10.0, gain_e_per_dn=2.0, full_well_e=1e6, black_level_dn=50)
    levels = np.array([0.0, 100.0, 4000.0])
    mean, variance = photon_transfer(levels, sensor, rng(), samples=100_000)
    np.testing.assert_allclose(mean, levels / 2, atol=0.2)
    np.testing.assert_allclose(variance, (levels + 100) / 4 + 1 / 12, rtol=0.02)
    assert photon_transfer(5.0, sensor, rng(), samples=2)[0].shape == (1,)


def test_fit_weights_levels_by_their_variance() -> None:
    """Weights of one over the variance of each point: the residuals' weighted sums vanish."""
    mean, variance = np.array([10.0, 20.0, 40.0, 80.0]), np.array([3.0, 4.0, 11.0, 19.0])
    beyond = np.array([150.0]), np.array([40.0])
    found = estimate_gain(np.append(mean, beyond[0]), np.append(variance, beyond[1]))
    slope = 1 / found.e_per_dn
    weight = variance**-2
    centre_x, centre_y = np.average(mean, weights=weight), np.average(variance, weights=weight)
    expected = (weight * (mean - centre_x) * (variance - centre_y)).sum() / (
        weight * (mean - centre_x) ** 2
    ).sum()
    assert slope == pytest.approx(expected)
    moment = (weight * (mean - centre_x) ** 2).sum()
    assert found.error_e_per_dn * slope**2 == pytest.approx(np.sqrt(2 / 19_999 / moment))


def test_read_noise_needs_a_dark_pair() -> None:
    levels = [measure_pair(pair, 4095) for pair in pairs_of(64, 100)]
    assert black_of_dark(levels, 66.0, 4095) == levels[0].mean_dn
    assert math.isnan(black_of_dark(levels[1:], 64.0, 4095))
    without = characterise(levels[1:], 64.0, 4095, dark=False)
    assert "lens cap" in without.read_noise.reason
    assert not without.gain.reason


# From `pairs_of(128, seed, count=23)` by emva1288 1.0.2 (PyPI), Data1288 and Results1288 on
# {'temporal': {1.0: {mean_e: both frames}}, 'spatial': {1.0: pairs 0 and 10}}, with numpy 2.5.5 and
# `np.asfarray = lambda a: np.asarray(a, float)`, which numpy 2 no longer has.
REFERENCE = {
    1: {"gain": 3.99189, "read_noise": 10.02590, "dsnu": 3.92957, "prnu": 0.00992375},
    2: {"gain": 4.01095, "read_noise": 10.01775, "dsnu": 3.86929, "prnu": 0.01003189},
    3: {"gain": 4.00873, "read_noise": 10.00079, "dsnu": 4.10698, "prnu": 0.00998997},
}


@pytest.mark.parametrize("seed", REFERENCE)
def test_estimates_agree_with_the_standards_reference_implementation(seed: int) -> None:
    """The reference fits without weights and takes DSNU and PRNU from one level each."""
    found = estimate_of(pairs_of(128, seed, count=23))
    for name, other in REFERENCE[seed].items():
        estimate = getattr(found, name)
        assert abs(estimate.value - other) < 2 * estimate.error, name
        assert estimate.value == pytest.approx(other, rel=0.01), name


def test_smooth_fall_off_of_the_light_adds_no_pattern() -> None:
    rng = np.random.default_rng(3)
    y, x = np.mgrid[-1:1:64j, -1:1:64j]
    light = 1000 * (1 - 0.2 * (x * x + y * y) + 0.1 * x)
    frames = rng.poisson(light, (2, 64, 64)).astype(np.uint16)
    level = measure_pair(frames, 4095)
    assert abs(level.pattern_dn2) < 3 * level.pattern_error_dn2
    assert level.noise_dn2 == pytest.approx(light.mean(), rel=0.05)


def test_light_is_measured_through_the_files_response() -> None:
    """Codes are the square root of the light, and the light's own noise is recovered."""
    rng = np.random.default_rng(5)
    response = np.arange(256.0) ** 2 / 255
    light = 100 + 4 * rng.standard_normal((2, 96, 96))
    codes = np.rint(np.sqrt(255 * light)).astype(np.uint8)
    level = measure_pair(codes, 255, response)
    assert level.mean_dn == pytest.approx(100, abs=0.2)
    assert level.noise_dn2 == pytest.approx(16, rel=0.04)
    assert level.noise_in_codes == pytest.approx(16 * 255 / 400 + 1 / 12, rel=0.04)


def smoothed(pairs: list[np.ndarray]) -> list[np.ndarray]:
    """Pairs like demosaiced ones: every other column is the mean of its neighbours."""
    out = []
    for pair in pairs:
        codes = pair.astype(float)
        codes[..., 1:-1:2] = (codes[..., :-2:2] + codes[..., 2::2]) / 2
        out.append(np.rint(codes).astype(np.uint16))
    return out


def test_interpolated_files_are_refused() -> None:
    found = estimate_of(smoothed(pairs_of(64, 7)))
    assert "interpolated" in found.gain.reason
    assert "interpolated" in found.prnu.reason
    assert found.noise is not None


KERNELS = {
    "four cells": [[0, 1, 0], [1, 0, 1], [0, 1, 0]],
    "eight cells": [[1, 1, 1], [1, 0, 1], [1, 1, 1]],
    "a row": [[0, 0, 0], [1, 0, 1], [0, 0, 0]],
}


@pytest.mark.parametrize("kernel", KERNELS)
@pytest.mark.parametrize("share", [0.0, 0.03, 0.1])
def test_smoothing_of_raw_files_is_taken_out_of_the_noise(share: float, kernel: str) -> None:
    """A share of each cell is the mean of its neighbours; 3 % make the gain 6 % too large."""
    weights = share * np.array(KERNELS[kernel], float) / np.sum(KERNELS[kernel])
    weights[1, 1] = 1 - share
    mixed = [
        np.rint([convolve(frame.astype(float), weights, mode="wrap") for frame in pair])
        for pair in pairs_of(128, 3)
    ]
    levels = [measure_pair(pair.astype(np.uint16), 4095) for pair in mixed]
    black = levels[0].mean_dn
    found, plain = (
        characterise(levels, black, 4095, single=single) for single in (single_cells(levels), None)
    )
    for estimate, truth in (
        (found.gain, SENSOR.gain_e_per_dn),
        (found.read_noise, SENSOR.read_noise_e),
        (found.saturation, SENSOR.full_well_e),
    ):
        assert abs(estimate.value - truth) < 2.5 * estimate.error
    if share:
        assert plain.gain.reason or abs(plain.gain.value - 4.0) > 5 * plain.gain.error


def test_noise_that_was_smoothed_far_or_much_is_not_corrected() -> None:
    """The error counts means over more than neighbours; those of half of the cell are refused."""
    for size, share in ((5, 0.06), (3, 0.5)):
        mixed = [
            np.rint(
                (1 - share) * pair + share * uniform_filter(pair.astype(float), (1, size, size))
            )
            for pair in pairs_of(128, 3)
        ]
        levels = [measure_pair(pair.astype(np.uint16), 4095) for pair in mixed]
        found = characterise(levels, levels[0].mean_dn, 4095, single=single_cells(levels)).gain
        assert found.reason or abs(found.value - 4.0) < 2.5 * found.error


def test_dark_pair_clipped_at_black_gives_no_read_noise() -> None:
    pairs = [np.maximum(pair, 64) for pair in pairs_of(96, 5)]  # black is at 64
    levels = [measure_pair(pair, 4095) for pair in pairs]
    assert levels[0].clipped == pytest.approx(0.5, abs=0.1)
    assert math.isnan(black_of_dark(levels, 64.0, 4095))
    found = characterise(levels, 64.0, 4095, dark=False)
    assert "clipped at black" in found.read_noise.reason
    assert abs(found.gain.value - 4.0) < 3 * found.gain.error


def test_fit_up_to_the_full_well_is_refused() -> None:
    found = estimate_of(pairs_of(64, 8), most=1.0)
    assert "saturated" in found.gain.reason
    assert math.isnan(found.gain.value)


def test_saturation_of_an_unsaturated_sensor_has_only_a_lower_bound() -> None:
    found = estimate_of(pairs_of(64, 9)[:8])
    assert found.saturation.bound == "above"
    assert found.saturation.value == pytest.approx(0.7 * SENSOR.full_well_e, rel=0.02)
    assert not found.gain.reason


def test_read_noise_below_its_error_has_only_an_upper_bound() -> None:
    sensor = dataclasses.replace(SENSOR, read_noise_e=0.5)
    pairs = pairs_of(64, 10, sensor)
    levels = [measure_pair(pair, 4095) for pair in pairs[2:]]
    found = characterise(levels, 64.0, 4095)
    assert found.read_noise.bound == "below"
    assert 0.5 < found.read_noise.value < 20


def test_texture_of_a_focused_surface_gives_no_prnu() -> None:
    found = estimate_of(pairs_of(64, 11, prnu=0.08))
    assert "surface" in found.prnu.reason
    assert not found.gain.reason


def test_missing_gain_states_its_reason() -> None:
    pairs = pairs_of(64, 12)
    assert "three exposures" in estimate_of(pairs[:2]).gain.reason
    assert "no pair" in characterise([], 0.0, 255).gain.reason
    steady = [np.full((2, 16, 16), code, np.uint16) for code in (100, 200, 300)]
    assert "raise the ISO" in estimate_of(steady).gain.reason
    clipped = [np.full((2, 16, 16), 4095, np.uint16) for _ in range(3)]
    assert (
        "clipped"
        in characterise([measure_pair(pair, 4095) for pair in clipped], 0.0, 4095).gain.reason
    )


def level_at(mean: float, noise: float) -> Level:
    return Level(
        mean,
        noise,
        0.01 * noise,
        pattern_dn2=0.0,
        pattern_error_dn2=1.0,
        noise_in_codes=noise,
        correlation=0.0,
        clipped=0.0,
        pixels=20_000,
    )


def test_scatter_beyond_chance_increases_the_errors() -> None:
    means = np.linspace(100.0, 1000.0, 8)
    calm = characterise([level_at(m, m / 4) for m in means], 0.0, 2000)
    bumps = 1 + 0.04 * (-1.0) ** np.arange(8)
    rough = characterise(
        [level_at(m, m / 4 * b) for m, b in zip(means, bumps, strict=True)], 0.0, 2000
    )
    assert calm.gain.value == pytest.approx(4.0)
    assert rough.gain.error > 3 * calm.gain.error


def test_nearly_equal_levels_give_no_gain() -> None:
    levels = [level_at(m, m / 4) for m in (500.0, 505.0, 510.0)]
    assert "too alike" in characterise(levels, 0.0, 2000).gain.reason
    assert characterise([level_at(500.0, 125.0)] * 3, 0.0, 2000).gain.reason


def even(light: float, size: int = 64) -> NDArray[np.uint8]:
    grain = np.random.default_rng(1).normal(light, 3.0, (size, size))
    return np.clip(np.rint(grain), 0, 255).astype(np.uint8)


def test_grey_file_is_split_into_the_four_cells_of_a_mosaic() -> None:
    grey = np.repeat(np.arange(15, dtype=np.uint8).reshape(3, 5, 1), 3, axis=2)
    planes = planes_of(grey)
    assert [plane.tolist() for plane in planes.values()] == [[[0, 2]], [[1, 3]], [[5, 7]], [[6, 8]]]


def test_grain_and_fall_off_count_as_even_but_an_edge_does_not() -> None:
    assert unevenness(even(120.0)) < 0.01
    falling = even(120.0) - np.arange(64, dtype=np.uint8)[:, None]
    assert unevenness(falling) < 0.01
    edge = even(120.0)
    edge[:, 30:] //= 2
    assert unevenness(edge) > 0.1
    assert unevenness(np.zeros((64, 64), np.uint8)) == 0.0
    assert unevenness(np.zeros((5, 3), np.uint8)) == 0.0


def test_pairs_share_light_exposure_and_camera() -> None:
    taken = [
        Taken(50.0, "A", 0.1), Taken(100.0, "A", 0.2), Taken(51.0, "A", 0.1),
        Taken(101.0, "A", 0.4), Taken(99.0, "A", 0.2), Taken(50.0, "B", 0.1),
    ]  # fmt: skip
    assert pair_up(taken) == ((0, 2), (4, 1))


def test_pairs_without_exif_share_their_light() -> None:
    lights = [0.1, 0.3, 40.0, 60.0, 41.0, 40.5, 61.0]
    assert pair_up([Taken(light) for light in lights]) == ((0, 1), (2, 5), (3, 6))
    assert pair_up([]) == ()


def test_camera_is_named_by_its_files_exif() -> None:
    assert camera_of({"make": "Acme", "model": "X1", "iso": 400.0}) == "Acme, X1, ISO 400"
    assert camera_of({}) == ""


def test_full_well_range_and_linearity_follow_the_standard() -> None:
    pairs = pairs_of(96, 5, count=23)
    levels = [measure_pair(pair, 4095) for pair in pairs]
    sensor, times = characterise(levels, levels[0].mean_dn, 4095), np.arange(23.0)
    found = standard_estimates(levels, levels[0].mean_dn, times.tolist(), sensor)
    assert found.full_well.value == pytest.approx(SENSOR.full_well_e, rel=0.03)
    floor = math.hypot(10.0, 4.0 / math.sqrt(12)) + 0.5
    assert found.dynamic_range.value == pytest.approx(found.full_well.value / floor, rel=0.02)
    assert found.linearity_error.value < 5e-4
    bent = standard_estimates(levels, levels[0].mean_dn, (times**1.02).tolist(), sensor)
    assert 0.002 < bent.linearity_error.value < 0.01
    unknown = standard_estimates(levels[:12], levels[0].mean_dn, [math.nan] * 12, sensor)
    assert "do not say" in unknown.linearity_error.reason
    assert unknown.dynamic_range.bound == "above"


def test_row_noise_is_measured_and_not_mistaken_for_smoothing() -> None:
    rng = np.random.default_rng(1)
    pairs = [pair + rng.normal(0, 3, (2, 96, 1)) for pair in pairs_of(96, 5)]
    found = estimate_of([np.clip(np.rint(pair), 0, 4095).astype(np.uint16) for pair in pairs])
    assert not found.gain.reason
    assert found.row_noise.value == pytest.approx(12.0, abs=3 * found.row_noise.error)
