"""The sensor against the Poisson distribution and the laws of its noise."""

import numpy as np
import pytest
from scipy import stats

from simulations.models.sensor import (
    SHOT_MODELS,
    Sensor,
    capture,
    develop,
    estimate_gain,
    expose,
    photon_transfer,
    quantise,
    read_out,
    shot_noise,
    shot_noise_from_normal,
    signal_to_noise,
    with_iso,
)


def rng():
    return np.random.default_rng(7)


def ks_distance(samples, mean):
    """Largest gap between the samples' distribution and the Poisson's, at whole numbers."""
    codes = np.arange(0, samples.max() + 1)
    empirical = np.searchsorted(np.sort(samples), codes, side="right") / samples.size
    return np.abs(empirical - stats.poisson.cdf(codes, mean)).max()


@pytest.mark.parametrize("mean", [0.5, 4.0, 60.0])
def test_shot_noise_follows_the_poisson_distribution(mean):
    samples = shot_noise(np.full(50_000, mean), rng())
    assert ks_distance(samples, mean) < 1.63 / np.sqrt(50_000)  # the 1 % bound of the test


def test_the_skewed_normal_is_nearer_to_poisson_than_the_plain_one():
    gaps = {
        model: ks_distance(shot_noise(np.full(200_000, 9.0), rng(), model=model), 9.0)
        for model in ("gaussian", "skewed")
    }
    assert gaps["skewed"] < 0.5 * gaps["gaussian"]
    assert gaps["gaussian"] == pytest.approx(0.0665 / 3, rel=0.3)


def test_no_light_frees_no_electron_and_any_light_is_held_by_the_well():
    for model in ("poisson", "skewed", "gaussian"):
        held = shot_noise([0.0, 1e300, np.inf], rng(), 1000.0, model)
        np.testing.assert_array_equal(held, [0, 1000, 1000])


def test_gain_is_measured_within_one_percent():
    mean, variance = photon_transfer(np.linspace(500, 15_000, 20), Sensor(), rng())
    assert estimate_gain(mean, variance) == pytest.approx(5.0, rel=0.01)


def test_rounding_adds_one_twelfth_of_variance():
    signal = rng().uniform(100, 900, 200_000)
    assert np.var(quantise(signal, 10) - signal) == pytest.approx(1 / 12, rel=0.01)


def test_quantise_is_defined_for_everything():
    codes = quantise([-5, 0.4, 0.6, 1e9, np.nan, np.inf], 1)
    np.testing.assert_array_equal(codes, [0, 0, 1, 1, 0, 1])
    assert quantise(1e9, 16) == 65535


def test_exposure_counts_light_and_warmth():
    sensor = Sensor(quantum_efficiency=0.5, dark_current_e_per_s=2.0)
    assert expose(100.0, 3.0, sensor) == pytest.approx(156)


def test_signal_to_noise_of_shot_noise_is_the_root_of_the_electrons():
    bare = Sensor(read_noise_e=0, gain_e_per_dn=1e-6, black_level_dn=0)
    assert signal_to_noise(10_000, bare) == pytest.approx(100)
    assert signal_to_noise(0, Sensor()) == 0


def test_twice_the_iso_doubles_the_codes():
    sensor = Sensor(black_level_dn=0)
    light = np.full(20_000, 4000.0)
    single = capture(light, 1.0, sensor, rng()).mean()
    assert capture(light, 1.0, with_iso(sensor, 200), rng()).mean() == pytest.approx(
        2 * single, rel=0.01
    )


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: shot_noise([-1.0], rng()), "mean_e"),
        (lambda: shot_noise([np.nan], rng()), "mean_e"),
        (lambda: shot_noise([1.0], rng(), model="fast"), "fast"),
        (lambda: Sensor(bits=17), "bits"),
        (lambda: Sensor(bits=4), "black_level_dn"),
        (lambda: quantise(1.0, 0), "bits"),
        (lambda: expose(1.0, -1.0, Sensor()), "exposure_s"),
    ],
)
def test_meaningless_parameters_are_refused_by_name(call, message):
    with pytest.raises(ValueError, match=message):
        call()


@pytest.mark.parametrize(
    ("field", "legal", "illegal"),
    [
        ("full_well_e", [1e-3, 1e9, 1e15, np.inf], [0.0, -1.0, np.nan, 1.1e15]),
        ("read_noise_e", [0.0, 5.0, 1e15], [-1e-9, np.nan, 1.1e15, np.inf]),
        ("dark_current_e_per_s", [0.0, 5.0, 1e30], [-1e-9, np.nan, 1.1e30, np.inf]),
        ("gain_e_per_dn", [1e-30, 1e30], [0.0, -1.0, np.nan, 9e-31, 1.1e30]),
        ("bits", [7, 16, np.int64(12)], [0, 17, 12.0]),
        ("black_level_dn", [0.0, 4094.9], [-1e-9, 4095.0, np.nan]),
        ("quantum_efficiency", [0.0, 1.0], [-1e-9, 1.001, np.nan]),
    ],
)
def test_each_property_of_a_sensor_has_its_range(field, legal, illegal):
    for value in legal:
        assert getattr(Sensor(**{field: value}), field) == value
    for value in illegal:
        with pytest.raises(ValueError, match=field):
            Sensor(**{field: value})


def test_one_bit_has_two_codes():
    assert Sensor(bits=1, black_level_dn=0).highest_dn == 1
    assert Sensor(bits=12).highest_dn == 4095


def test_the_usual_sensor_is_that_of_the_chapter():
    usual = Sensor()
    assert (usual.full_well_e, usual.read_noise_e, usual.dark_current_e_per_s) == (20_000, 3, 0.1)
    assert (usual.gain_e_per_dn, usual.bits, usual.black_level_dn) == (5, 12, 64)
    assert usual.quantum_efficiency == 0.5


def test_iso_divides_the_electrons_per_code():
    assert with_iso(Sensor(gain_e_per_dn=6.0), 400).gain_e_per_dn == 1.5
    assert with_iso(Sensor(gain_e_per_dn=6.0), 400, 200).gain_e_per_dn == 3.0
    for iso in (0.0, -100.0):
        with pytest.raises(ValueError, match="iso"):
            with_iso(Sensor(), iso)


def test_exposure_may_be_nothing_but_not_endless_and_light_may_be_endless():
    assert expose(100.0, 0.0, Sensor()) == 0
    assert expose(np.inf, 0.0, Sensor()) == 0
    for exposure in (np.inf, np.nan):
        with pytest.raises(ValueError, match="exposure_s"):
            expose(1.0, exposure, Sensor())
    with pytest.raises(ValueError, match="photons_per_s"):
        expose([1.0, -1.0], 1.0, Sensor())


@pytest.mark.parametrize("model", ["poisson", "skewed", "gaussian"])
@pytest.mark.parametrize("mean", [30.0, 400.0])
def test_every_model_of_shot_noise_has_the_mean_and_variance_of_poisson(model, mean):
    counted = shot_noise(np.full(200_000, mean), rng(), model=model)
    assert np.array_equal(counted, np.rint(counted))
    assert counted.mean() == pytest.approx(mean, abs=5 * np.sqrt(mean / 200_000))
    assert counted.var() == pytest.approx(mean, rel=0.02)


def test_the_skewed_model_leans_as_poisson_does():
    mean = 100.0
    counted = shot_noise(np.full(1_000_000, mean), rng(), model="skewed")
    skewness = np.mean((counted - mean) ** 3) / mean**1.5
    assert skewness == pytest.approx(mean**-0.5, rel=0.1)


@pytest.mark.parametrize("model", ["skewed", "gaussian"])
def test_an_approximation_frees_no_negative_electrons_and_none_in_the_dark(model):
    assert shot_noise(np.full(10_000, 0.05), rng(), model=model).min() == 0
    assert shot_noise(np.zeros(10_000), rng(), model=model).max() == 0


def test_a_well_spills_what_it_cannot_hold():
    counted = shot_noise(np.full(50_000, 100.0), rng(), 100.0)
    assert counted.max() == 100
    assert np.mean(counted == 100) == pytest.approx(stats.poisson.sf(99, 100), abs=0.01)


def test_the_cap_is_too_far_above_the_well_to_be_noticed():
    for well in (1.0, 1000.0):
        assert shot_noise(np.full(100_000, 1e9), rng(), well).min() == well


def test_reading_out_divides_by_the_gain_and_adds_noise_and_black():
    sensor = Sensor(read_noise_e=4.0, gain_e_per_dn=2.0, black_level_dn=64.0)
    signal = read_out(np.full(200_000, 100.0), sensor, rng())
    assert signal.mean() == pytest.approx(114.0, abs=0.03)
    assert signal.std() == pytest.approx(2.0, rel=0.02)
    silent = Sensor(read_noise_e=0.0, gain_e_per_dn=2.0)
    np.testing.assert_array_equal(read_out([100.0, 0.0], silent, rng()), [114.0, 64.0])


def test_single_precision_stays_single():
    few = np.full(4, 10.0, np.float32)
    assert shot_noise(few, rng(), model="skewed").dtype == np.float32
    assert shot_noise(few, rng()).dtype == np.float32
    assert read_out(few, Sensor(), rng()).dtype == np.float32
    assert read_out(few.astype(float), Sensor(), rng()).dtype == np.float64


@pytest.mark.parametrize("bits", [0, 17, 8.0])
def test_a_converter_has_1_to_16_bits(bits):
    with pytest.raises(ValueError, match="bits"):
        quantise(1.0, bits)


def test_rounding_goes_to_the_nearest_code_and_stops_at_the_ends():
    np.testing.assert_array_equal(quantise([-np.inf, 2.4, 2.6, 6.7, 8.0], 3), [0, 2, 3, 7, 7])


def test_developing_undoes_the_gain():
    sensor = Sensor(bits=10, black_level_dn=23.0)
    np.testing.assert_allclose(develop([23.0, 523.0, 1023.0, 0.0], sensor), [0, 0.5, 1, -0.023])


def test_signal_to_noise_adds_all_variances():
    """Of 400 + 3² + 6²/12 the root is √412."""
    sensor = Sensor(read_noise_e=3.0, gain_e_per_dn=6.0)
    assert signal_to_noise(400.0, sensor) == pytest.approx(400 / np.sqrt(412))


def test_the_photon_transfer_curve_has_the_variances_of_its_sources():
    sensor = Sensor(read_noise_e=10.0, gain_e_per_dn=2.0, full_well_e=1e6, black_level_dn=50)
    levels = np.array([0.0, 100.0, 4000.0])
    mean, variance = photon_transfer(levels, sensor, rng(), samples=100_000)
    np.testing.assert_allclose(mean, levels / 2, atol=0.2)
    np.testing.assert_allclose(variance, (levels + 100) / 4 + 1 / 12, rtol=0.02)
    assert photon_transfer(5.0, sensor, rng(), samples=2)[0].shape == (1,)
    with pytest.raises(ValueError, match="samples"):
        photon_transfer(levels, sensor, rng(), samples=1)


def test_the_gain_is_one_over_the_slope_whatever_the_offset():
    mean = np.array([10.0, 20.0, 50.0])
    assert estimate_gain(mean, 3.0 + mean / 4) == pytest.approx(4.0)
    assert estimate_gain(mean[:2], mean[:2]) == pytest.approx(1.0)
    for levels in ([5.0], [5.0, 5.0]):
        with pytest.raises(ValueError, match="levels"):
            estimate_gain(levels, levels)


def test_a_fit_trusts_small_variances_more():
    """Weights of one over the variance of each point: the residuals' weighted sums vanish."""
    mean, variance = np.array([10.0, 20.0, 40.0, 80.0]), np.array([3.0, 4.0, 11.0, 19.0])
    slope = 1 / estimate_gain(mean, variance)
    weight = variance**-2
    centre_x, centre_y = np.average(mean, weights=weight), np.average(variance, weights=weight)
    expected = (weight * (mean - centre_x) * (variance - centre_y)).sum() / (
        weight * (mean - centre_x) ** 2
    ).sum()
    assert slope == pytest.approx(expected)


def test_both_exposures_of_a_transfer_curve_count():
    """The mean of two fields of two samples has a quarter of the variance of one sample."""
    sensor = Sensor(read_noise_e=0.0, gain_e_per_dn=1.0, bits=16, full_well_e=1e5)
    mean, variance = photon_transfer(np.full(20_000, 400.0), sensor, rng(), samples=2)
    assert mean.var() == pytest.approx(400 / 4, rel=0.05)
    assert variance.mean() == pytest.approx(400, rel=0.05)


def test_normals_drawn_beforehand_give_the_skewed_counts_of_the_same_draws():
    mean = np.linspace(0, 1500, 4000, dtype=np.float32)
    z = rng().standard_normal(mean.shape, np.float32)
    counted = shot_noise_from_normal(mean, z, 1000.0)
    np.testing.assert_array_equal(counted, shot_noise(mean, rng(), 1000.0, model="skewed"))
    assert counted[0] == 0
    assert counted.max() == 1000


def test_counts_of_a_float32_picture_stay_float32():
    mean = np.full((2, 3), 40, np.float32)
    assert shot_noise(mean, rng(), 1000.0).dtype == np.float32
    assert shot_noise_from_normal(mean, np.ones_like(mean), 1000.0).dtype == np.float32
    assert shot_noise_from_normal(mean, np.zeros_like(mean)).dtype == np.float32


def test_the_second_term_leans_counts_to_the_right():
    """Cornish and Fisher: m + sqrt(m) z + (z^2 - 1) / 6, rounded."""
    z = np.array([-2.0, 0.0, 1.0, 3.0])
    expected = np.rint(100 + 10 * z + (z**2 - 1) / 6)
    np.testing.assert_array_equal(shot_noise_from_normal(np.full(4, 100.0), z), expected)


def test_a_pixel_that_never_fills_counts_any_light_up_to_what_a_sampler_can_draw():
    for model in ("poisson", "skewed", "gaussian"):
        counted = shot_noise([1e300, np.inf], rng(), model=model)
        assert counted == pytest.approx([1e15, 1e15], rel=1e-6)


@pytest.mark.parametrize("well", [0.0, -1.0, np.nan, 2e15])
def test_a_well_that_holds_nothing_or_more_than_can_be_counted_is_refused(well):
    with pytest.raises(ValueError, match=f"^full_well_e {well}; legal: above 0, to 1e\\+15, or"):
        shot_noise([1.0], rng(), well)
    with pytest.raises(ValueError, match=r"^full_well_e"):
        shot_noise_from_normal([1.0], [0.0], well)


@pytest.mark.parametrize(
    ("name", "wrong"),
    [
        ("full_well_e", 0.0),
        ("read_noise_e", -1.0),
        ("dark_current_e_per_s", -0.1),
        ("gain_e_per_dn", 0.0),
        ("black_level_dn", 4095.0),
        ("quantum_efficiency", 1.1),
    ],
)
def test_a_sensor_says_which_of_its_numbers_is_illegal(name, wrong):
    with pytest.raises(ValueError, match=rf"^{name} {wrong}; legal: "):
        Sensor(**{name: wrong})


def test_what_is_asked_of_a_sensor_is_refused_by_name():
    with pytest.raises(ValueError, match=r"^iso 0; legal: above 0$"):
        with_iso(Sensor(), 0)
    with pytest.raises(ValueError, match=r"^exposure_s inf; legal: "):
        expose(1.0, np.inf, Sensor())
    with pytest.raises(ValueError, match=r"^samples 1; legal: 2 or more$"):
        photon_transfer([1.0], Sensor(), rng(), samples=1)


def test_an_iso_below_one_is_a_slow_film_and_legal():
    assert with_iso(Sensor(gain_e_per_dn=2.0), 0.5).gain_e_per_dn == 400.0


def test_read_noise_below_one_electron_is_noise_as_well():
    quiet = Sensor(read_noise_e=0.5, gain_e_per_dn=1.0, black_level_dn=0.0)
    assert read_out(np.zeros(20_000), quiet, rng()).std() == pytest.approx(0.5, rel=0.02)


def test_the_models_of_shot_noise_are_listed_from_cheap_to_exact():
    assert SHOT_MODELS == ("gaussian", "skewed", "poisson")


def test_a_transfer_curve_has_twenty_thousand_samples_a_level_unless_told_otherwise():
    levels = [50.0, 400.0]
    usual, stated = (
        photon_transfer(levels, Sensor(), rng()),
        photon_transfer(levels, Sensor(), rng(), 20_000),
    )
    np.testing.assert_array_equal(usual, stated)


@pytest.mark.parametrize("kind", [np.float32, np.float64])
def test_light_beyond_all_numbers_is_infinite_and_fills_the_well(kind):
    mean = expose(np.full(3, 1e30, kind), 1e300, Sensor())
    assert mean.dtype == kind
    assert np.isinf(mean).all()
    assert (shot_noise(mean, rng(), 20_000.0) == 20_000).all()


@pytest.mark.parametrize("gain", [1e-30, 1e30])
def test_any_gain_amplifies_single_precision_as_well(gain):
    sensor = Sensor(gain_e_per_dn=gain, read_noise_e=0.0)
    signal = read_out(np.array([0.0, 100.0], np.float32), sensor, rng())
    assert signal == pytest.approx([64.0, 64.0 + 100.0 / gain])


def test_noise_beyond_all_light_leaves_no_signal():
    assert signal_to_noise(1.0, Sensor(read_noise_e=1e15)) == pytest.approx(1e-15)
    assert signal_to_noise(9.0, Sensor(read_noise_e=4.0, gain_e_per_dn=0.1)) == pytest.approx(
        1.8, rel=1e-4
    )


@pytest.mark.parametrize(
    ("mean", "variance", "message"),
    [
        ([1.0, 2.0], [3.0, 3.0], "does not rise with the mean"),
        ([1.0, 2.0], [3.0, 2.0], "does not rise with the mean"),
        ([1.0, np.nan], [1.0, 2.0], "not finite"),
        ([1.0, 2.0], [1.0, np.inf], "not finite"),
        ([1.0, 2.0, 3.0], [1.0, 2.0], r"both \(N,\)"),
        ([[1.0, 2.0]], [[1.0, 2.0]], r"both \(N,\)"),
    ],
)
def test_a_curve_without_shot_noise_has_no_gain(mean, variance, message):
    with pytest.raises(ValueError, match=message):
        estimate_gain(mean, variance)
