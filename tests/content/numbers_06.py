"""Chapter 6: the sensor."""

from math import log2, log10, sqrt

import numpy as np
from support.worked_numbers import Says

from simulations.models.color import rgb_to_xyz_matrix
from simulations.models.demosaicing import psnr_db
from simulations.models.sensor import Sensor, signal_to_noise, with_iso
from simulations.scenes.sensor_noise_stages import patch_means_e, saturation_e, sensor_of

CHAPTER = "06-digital-sensor"
GIVEN = "20_000 4095 100 400 625 800 1000 255 0.5 1.2 2004 2007 10_000"
WELL = 20_000.0


def sensor(read_noise_e: float, gain: float = 5.0, dark: float = 0.0, bits: int = 12) -> Sensor:
    return Sensor(WELL, read_noise_e, dark, gain, bits)


def choosing_a_gain() -> Says:
    gain = WELL / (2**12 - 1)
    yield rf"$g = 20\,000/{2**12 - 1} = {gain:.2f}$ electrons per DN"
    deviation = 1 / sqrt(12)
    yield rf"$1/\sqrt{{12}} = {deviation:.3f}$ DN, or {gain * deviation:.2f} electrons"


def adding_noise_up() -> Says:
    variance = 1000 + 0.5 * 2 + 3**2
    sigma = sqrt(variance)
    yield f"$1000 + 1 + 9 = {variance:.0f}$, so"
    yield rf"$\sigma = {sigma:.1f}$ electrons"
    yield f"the SNR is $1000 / {sigma:.1f} = {1000 / sigma:.1f}$"
    yield f"Shot noise alone would give {sqrt(1000):.1f}."
    shadow = 4 + 1 + 9
    yield f"$4 + 1 + 9 = {shadow}$"
    yield rf"$\sigma = {sqrt(shadow):.1f}$, and the SNR is {4 / sqrt(shadow):.1f}"
    yield rf"$20\,000/3 = {WELL / 3:.0f}$ or {log2(WELL / 3):.1f} stops"


def the_thirteenth_patch() -> Says:
    assert np.isclose(patch_means_e(0.0)[12], 625)
    rounding = sensor_of(12, "100", 10).gain_e_per_dn ** 2 / 12
    variance = 625 + 100 + round(rounding)
    yield f"plus {rounding:.0f} for rounding"
    snr = 625 / sqrt(variance)
    yield rf"$625/\sqrt{{{variance}}} = {snr:.1f}$"
    model = float(signal_to_noise(625, sensor_of(12, "100", 10)))
    assert np.isclose(model, snr, rtol=1e-3)


def patches_burnt_out_at_iso_800() -> Says:
    burnt = patch_means_e(0.0) > saturation_e(sensor_of(12, "800", 10))
    assert burnt.sum() == 8
    yield "eight patches are burnt out"


def what_green_is_worth() -> Says:
    red, green, blue = rgb_to_xyz_matrix()[1]
    yield rf"${red:.2f}\,R + {green:.2f}\,G + {blue:.2f}\,B$"
    yield f"about {100 * green:.0f} % of luminance"


def an_error_of_one_code() -> Says:
    picture = np.zeros((32, 32, 3))
    psnr = psnr_db(picture + 1, picture, peak=255)
    assert np.isclose(psnr, 10 * log10(255**2))
    yield f"An error of one code everywhere gives {psnr:.1f} dB."


def sixteen_bits() -> Says:
    rounding = 1.2 / sqrt(12)
    yield rf"$1.2/\sqrt{{12}} = {rounding:.2f}$ electrons"
    yield f"In variance it adds {rounding**2:.2f} to {5**2}, half a per cent"
    assert 0.0045 < rounding**2 / 5**2 < 0.0055
    yield f"the rounding error of {rounding:.2f} electrons"


def iso_and_snr() -> Says:
    snr = 400 / sqrt(400 + 25)
    yield rf"$400/\sqrt{{400 + 25}} = {snr:.1f}$"
    yield f"It stays near {snr:.1f}."
    camera = sensor(5.0, gain=0.01, bits=16)
    for iso in (100, 400):
        assert np.isclose(float(signal_to_noise(400, with_iso(camera, iso))), snr, rtol=1e-3)


WORKED = (
    choosing_a_gain,
    adding_noise_up,
    the_thirteenth_patch,
    patches_burnt_out_at_iso_800,
    what_green_is_worth,
    an_error_of_one_code,
    sixteen_bits,
    iso_and_snr,
)
