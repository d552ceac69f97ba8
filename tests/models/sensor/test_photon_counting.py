"""A sensor: light and warmth counted, read out with noise, and rounded to codes."""

from typing import Any

import numpy as np
import pytest

from simulations.models.sensor.photon_counting import (
    Sensor,
    develop,
    expose,
    quantise,
    read_out,
    signal_to_noise,
    with_iso,
)


def rng() -> np.random.Generator:
    return np.random.default_rng(7)


def test_rounding_adds_one_twelfth_of_variance() -> None:
    signal = rng().uniform(100, 900, 200_000)
    assert np.var(quantise(signal, 10) - signal) == pytest.approx(1 / 12, rel=0.01)


def test_exposure_counts_light_and_warmth() -> None:
    sensor = Sensor(quantum_efficiency=0.5, dark_current_e_per_s=2.0)
    assert expose(100.0, 3.0, sensor) == pytest.approx(156)


@pytest.mark.parametrize(
    ("field", "legal", "illegal"),
    [
        ("full_well_e", [1e-3, 1e9, 1e13, np.inf], [0.0, -1.0, np.nan, 1.1e13]),
        ("read_noise_e", [0.0, 5.0, 1e15], [-1e-9, np.nan, 1.1e15, np.inf]),
        ("dark_current_e_per_s", [0.0, 5.0, 1e30], [-1e-9, np.nan, 1.1e30, np.inf]),
        ("gain_e_per_dn", [1e-30, 1e30], [0.0, -1.0, np.nan, 9e-31, 1.1e30]),
        ("bits", [7, 16, np.int64(12)], [0, 17, 12.0]),
        ("black_level_dn", [0.0, 4094.9], [-1e-9, 4095.0, np.nan]),
        ("quantum_efficiency", [0.0, 1.0], [-1e-9, 1.001, np.nan]),
    ],
)
def test_each_property_of_a_sensor_has_its_range(
    field: str, legal: list[Any], illegal: list[Any]
) -> None:
    for value in legal:
        assert getattr(Sensor(**{field: value}), field) == value
    for value in illegal:
        with pytest.raises(ValueError, match=rf"^{field} .*; legal: "):
            Sensor(**{field: value})


def test_iso_divides_the_electrons_per_code() -> None:
    sensor = Sensor(gain_e_per_dn=6.0)
    assert with_iso(sensor, 400).gain_e_per_dn == 1.5
    assert with_iso(sensor, 400, 200).gain_e_per_dn == 3.0
    assert with_iso(sensor, 0.5).gain_e_per_dn == 1200.0


def test_reading_out_divides_by_the_gain_and_adds_noise_and_black() -> None:
    sensor = Sensor(read_noise_e=4.0, gain_e_per_dn=2.0, black_level_dn=64.0)
    signal = read_out(np.full(200_000, 100.0), sensor, rng())
    assert signal.mean() == pytest.approx(114.0, abs=0.03)
    assert signal.std() == pytest.approx(2.0, rel=0.02)
    silent = Sensor(read_noise_e=0.0, gain_e_per_dn=2.0)
    np.testing.assert_array_equal(read_out([100.0, 0.0], silent, rng()), [114.0, 64.0])


def test_rounding_goes_to_the_nearest_code_and_stops_at_the_ends() -> None:
    signal = [-np.inf, -5, np.nan, 2.4, 2.6, 6.7, 8.0, 1e9, np.inf]
    np.testing.assert_array_equal(quantise(signal, 3), [0, 0, 0, 2, 3, 7, 7, 7, 7])
    assert quantise(1e9, 16) == 65535
    assert Sensor(bits=1, black_level_dn=0).highest_dn == 1


def test_developing_undoes_the_gain() -> None:
    sensor = Sensor(bits=10, black_level_dn=23.0)
    np.testing.assert_allclose(develop([23.0, 523.0, 1023.0, 0.0], sensor), [0, 0.5, 1, -0.023])


def test_signal_to_noise_adds_all_variances() -> None:
    """Of 400 + 3² + 6²/12 the root is √412."""
    sensor = Sensor(read_noise_e=3.0, gain_e_per_dn=6.0)
    assert signal_to_noise(400.0, sensor) == pytest.approx(400 / np.sqrt(412))
    assert signal_to_noise(1.0, Sensor(read_noise_e=1e15)) == pytest.approx(1e-15)
    bare = Sensor(read_noise_e=0, gain_e_per_dn=1e-6, black_level_dn=0)
    assert signal_to_noise(10_000, bare) == pytest.approx(100)


@pytest.mark.parametrize("gain", [1e-30, 1e30])
def test_any_gain_amplifies_single_precision_as_well(gain: float) -> None:
    sensor = Sensor(gain_e_per_dn=gain, read_noise_e=0.0)
    signal = read_out(np.array([0.0, 100.0], np.float32), sensor, rng())
    assert signal == pytest.approx([64.0, 64.0 + 100.0 / gain])
