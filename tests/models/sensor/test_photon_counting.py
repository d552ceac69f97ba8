"""A sensor: light and warmth counted, read out with noise, and rounded to codes."""

from typing import Any

import numpy as np
import pytest

from simulations.models.sensor.photon_counting import (
    Sensor,
    capture,
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


def test_quantise_is_defined_for_everything() -> None:
    codes = quantise([-5, 0.4, 0.6, 1e9, np.nan, np.inf], 1)
    np.testing.assert_array_equal(codes, [0, 0, 1, 1, 0, 1])
    assert quantise(1e9, 16) == 65535


def test_exposure_counts_light_and_warmth() -> None:
    sensor = Sensor(quantum_efficiency=0.5, dark_current_e_per_s=2.0)
    assert expose(100.0, 3.0, sensor) == pytest.approx(156)


def test_twice_the_iso_doubles_the_codes() -> None:
    sensor = Sensor(black_level_dn=0)
    light = np.full(20_000, 4000.0)
    single = capture(light, 1.0, sensor, rng()).mean()
    assert capture(light, 1.0, with_iso(sensor, 200), rng()).mean() == pytest.approx(
        2 * single, rel=0.01
    )


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


def test_one_bit_has_two_codes() -> None:
    assert Sensor(bits=1, black_level_dn=0).highest_dn == 1
    assert Sensor(bits=12).highest_dn == 4095


def test_the_usual_sensor_is_that_of_the_chapter() -> None:
    usual = Sensor()
    assert (usual.full_well_e, usual.read_noise_e, usual.dark_current_e_per_s) == (20_000, 3, 0.1)
    assert (usual.gain_e_per_dn, usual.bits, usual.black_level_dn) == (5, 12, 64)
    assert usual.quantum_efficiency == 0.5


def test_iso_divides_the_electrons_per_code() -> None:
    assert with_iso(Sensor(gain_e_per_dn=6.0), 400).gain_e_per_dn == 1.5
    assert with_iso(Sensor(gain_e_per_dn=6.0), 400, 200).gain_e_per_dn == 3.0
    for iso in (0.0, -100.0):
        with pytest.raises(ValueError, match=f"^iso {iso}; legal: above 0$"):
            with_iso(Sensor(), iso)


def test_exposure_may_be_nothing_but_not_endless_and_light_may_be_endless() -> None:
    assert expose(100.0, 0.0, Sensor()) == 0
    assert expose(np.inf, 0.0, Sensor()) == 0
    for exposure in (np.inf, np.nan):
        with pytest.raises(ValueError, match=f"^exposure_s {exposure}; legal: "):
            expose(1.0, exposure, Sensor())
    with pytest.raises(ValueError, match="photons_per_s"):
        expose([1.0, -1.0], 1.0, Sensor())


def test_reading_out_divides_by_the_gain_and_adds_noise_and_black() -> None:
    sensor = Sensor(read_noise_e=4.0, gain_e_per_dn=2.0, black_level_dn=64.0)
    signal = read_out(np.full(200_000, 100.0), sensor, rng())
    assert signal.mean() == pytest.approx(114.0, abs=0.03)
    assert signal.std() == pytest.approx(2.0, rel=0.02)
    silent = Sensor(read_noise_e=0.0, gain_e_per_dn=2.0)
    np.testing.assert_array_equal(read_out([100.0, 0.0], silent, rng()), [114.0, 64.0])


@pytest.mark.parametrize("bits", [0, 17, 8.0])
def test_a_converter_has_1_to_16_bits(bits: Any) -> None:
    with pytest.raises(ValueError, match="bits"):
        quantise(1.0, bits)


def test_rounding_goes_to_the_nearest_code_and_stops_at_the_ends() -> None:
    np.testing.assert_array_equal(quantise([-np.inf, 2.4, 2.6, 6.7, 8.0], 3), [0, 2, 3, 7, 7])


def test_developing_undoes_the_gain() -> None:
    sensor = Sensor(bits=10, black_level_dn=23.0)
    np.testing.assert_allclose(develop([23.0, 523.0, 1023.0, 0.0], sensor), [0, 0.5, 1, -0.023])


def test_signal_to_noise_adds_all_variances() -> None:
    """Of 400 + 3² + 6²/12 the root is √412."""
    sensor = Sensor(read_noise_e=3.0, gain_e_per_dn=6.0)
    assert signal_to_noise(400.0, sensor) == pytest.approx(400 / np.sqrt(412))


def test_an_iso_below_one_is_a_slow_film_and_legal() -> None:
    assert with_iso(Sensor(gain_e_per_dn=2.0), 0.5).gain_e_per_dn == 400.0


def test_read_noise_below_one_electron_is_noise_as_well() -> None:
    quiet = Sensor(read_noise_e=0.5, gain_e_per_dn=1.0, black_level_dn=0.0)
    assert read_out(np.zeros(20_000), quiet, rng()).std() == pytest.approx(0.5, rel=0.02)


@pytest.mark.parametrize("gain", [1e-30, 1e30])
def test_any_gain_amplifies_single_precision_as_well(gain: float) -> None:
    sensor = Sensor(gain_e_per_dn=gain, read_noise_e=0.0)
    signal = read_out(np.array([0.0, 100.0], np.float32), sensor, rng())
    assert signal == pytest.approx([64.0, 64.0 + 100.0 / gain])


def test_noise_beyond_all_light_leaves_no_signal() -> None:
    assert signal_to_noise(1.0, Sensor(read_noise_e=1e15)) == pytest.approx(1e-15)
    assert signal_to_noise(9.0, Sensor(read_noise_e=4.0, gain_e_per_dn=0.1)) == pytest.approx(
        1.8, rel=1e-4
    )
