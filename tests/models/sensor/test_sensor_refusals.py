"""What models of the sensor refuse, by the name of the parameter."""

from typing import Any

import numpy as np
from support.refusals import Call, assert_refused, each_of

from simulations.models.sampling.first_fall import first_fall
from simulations.models.sensor import exposure, photon_counting, poisson, resolution
from simulations.models.sensor.bayer import filter_colours
from simulations.models.sensor.camera_colour import camera_curves, exposed, fit_colour_matrix
from simulations.models.sensor.demosaicing import demosaic, mosaic
from simulations.models.sensor.photon_counting import Sensor, shot_noise
from simulations.models.sensor.photon_transfer import estimate_gain, photon_transfer
from simulations.models.sensor.shared_detail import shared_detail

NAN, INF = np.nan, np.inf
SENSOR = Sensor()
DARK = np.zeros(81)
CURVES = camera_curves(np.linspace(380.0, 780.0, 81))
GREYS = np.outer([0.2, 0.5, 0.9], np.ones(3))
NO_PICTURE = [np.zeros(s) for s in ((4, 4), (4, 4, 4), (3, 4), (0, 4, 3), (4, 0, 3), (2, 2, 2, 3))]
NO_MOSAIC = [np.zeros(shape) for shape in ((4,), (4, 4, 3), (4, 0), (0, 3))]
NO_DETAIL = [np.zeros(shape) for shape in ((2, 9, 3), (9, 2, 3), (9, 9, 4), (9, 3))]
NO_WELL = [0.0, -1.0, NAN, 2e13]
NO_COUNT = [0, -3]
LEVELS = np.array([20.0, 40.0, 100.0])
FLAT = [([1.0, 2.0, 9.0], [3.0, 3.0, 3.5]), ([1.0, 2.0, 9.0], [3.0, 2.0, 3.5])]
TOO_FEW = [([10.0, 20.0], [10.0, 20.0]), ([5.0], [5.0]), ([5.0, 5.0], [5.0, 5.0]), ([], [])]
UNSURE = [([100.0, 100.1, 900.0], [3.0, 3.001, 30.0])]
NOT_FINITE = [([1.0, NAN], [1.0, 2.0]), ([1.0, 2.0], [1.0, INF])]
UNEQUAL = [([1.0, 2.0, 3.0], [1.0, 2.0]), ([[1.0, 2.0]], [[1.0, 2.0]])]


def rng() -> np.random.Generator:
    return np.random.default_rng(7)


def still(_time: Any) -> Any:
    return np.ones(3)


def gain(curve: Any) -> Any:
    return estimate_gain(*curve)


@each_of(
    ("green sees 0", lambda light: exposed(light, CURVES, light), [DARK]),
    ("too few colours", lambda c: fit_colour_matrix(c, c, np.ones(3)), [GREYS]),
    (r"legal: \(H, W, 3\), not empty", mosaic, NO_PICTURE),
    (r"legal: \(H, W\), not empty", demosaic, NO_MOSAIC),
    ("RGBG", lambda pattern: demosaic(np.zeros((4, 4)), pattern), ["RGBG"]),
    ("magic", lambda method: demosaic(np.zeros((4, 4)), "RGGB", method), ["magic"]),
    ("height .*; legal: whole numbers, 1", lambda h: filter_colours(h, 4), [0, 2.5]),
    ("width .*; legal: whole numbers, 1", lambda w: filter_colours(4, w), [0, NAN]),
    ("count .*whole", lambda n: exposure.mean_of_instants(still, n), NO_COUNT),
    ("whole", lambda n: exposure.mean_of_random_instants(still, n, (2,), rng()), NO_COUNT),
    ("whole", lambda n: exposure.mean_of_jittered_instants(still, n, (2,), rng()), NO_COUNT),
    ("^iso .*; legal: above 0$", lambda iso: photon_counting.with_iso(SENSOR, iso), [0.0, -100.0]),
    ("^exposure_s", lambda s: photon_counting.expose(1.0, s, SENSOR), [INF, NAN, -1.0]),
    ("photons_per_s", lambda p: photon_counting.expose([1.0, p], 1.0, SENSOR), [-1.0]),
    ("bits", lambda bits: photon_counting.quantise(1.0, bits), [0, 17, 8.0]),
    ("black_level_dn", lambda bits: Sensor(bits=bits), [4]),
    ("mean_e", lambda mean: shot_noise([mean], rng()), [-1.0, NAN]),
    ("fast", lambda model: shot_noise([1.0], rng(), model=model), ["fast"]),
    (r"^full_well_e .*legal: above 0, to 1e", lambda w: shot_noise([1.0], rng(), w), NO_WELL),
    (r"^full_well_e", lambda w: photon_counting.shot_noise_from_normal([1.0], [0.0], w), NO_WELL),
    ("^samples 1", lambda n: photon_transfer(LEVELS, SENSOR, rng(), samples=n), [1]),
    ("samples 1; legal: whole", lambda n: estimate_gain(LEVELS, LEVELS, samples=n), [1]),
    (r"determine the gain to \d+ % only", lambda n: estimate_gain(LEVELS, LEVELS, samples=n), [2]),
    (r"determine the gain to \d+ % only; legal: 10 % or", gain, UNSURE),
    ("variance does not rise with the mean", gain, FLAT),
    ("levels", gain, TOO_FEW),
    ("0 of 3 levels on the straight part", gain, [([1.0, 2.0, 9.0], [0.1, 0.2, 0.4])]),
    ("not finite", gain, NOT_FINITE),
    (r"both \(N,\)", gain, UNEQUAL),
    ("legal: 0 to 1e10", poisson.poisson_cumulative, [-1.0, NAN, INF, 1.1e10]),
    ("legal: 1 or more", lambda n: poisson.largest_chance_gap(n, 10), [0]),
    ("legal: 1 or more", lambda n: poisson.largest_chance_gap(10, n), [0]),
    ("legal: one number or more", lambda c: poisson.gap_from_poisson(c, 3.0), [[], [1.0, NAN]]),
    (
        "^contrast at the start 0.4; ",
        lambda curve: first_fall([0, 1, 2], curve, 0.5),
        [[0.4, 0.3, 0.1], [0.4, 0.9, 0.1]],
    ),
    ("^width_um -1; ", lambda um: resolution.pixel_transfer(1, um), [-1]),
    ("pitch_um", resolution.nyquist_per_mm, [0]),
    ("^frequency_per_mm", lambda f: resolution.plate_transfer([f, 1.0], 1), [INF, NAN, -1e13]),
    ("legal: finite", lambda v: shared_detail(np.full((5, 5, 3), v)), [NAN, INF]),
    ("legal: ", shared_detail, NO_DETAIL),
)
def test_models_of_the_sensor_refuse(message: str, call: Call, values: Any) -> None:
    assert_refused(message, call, values)
