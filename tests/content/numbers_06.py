"""Chapter 6: the sensor."""

import re
import warnings
from math import erf, log2, log10, sqrt

import numpy as np
from support.worked_numbers import Says

from simulations.engine.controls import check_values
from simulations.engine.pipeline import StageCache
from simulations.models.chromatic_adaptation import adapt
from simulations.models.chromaticity import ILLUMINANT_A_XY, lab_distance, white_xyz
from simulations.models.color import (
    D65_XY,
    rgb_to_xyz_matrix,
    white_balance,
    xyz_to_lab,
    xyz_to_linear_rgb,
)
from simulations.models.compression import round_outwards
from simulations.models.demosaicing import psnr_db
from simulations.models.sensor import Sensor, signal_to_noise, with_iso
from simulations.scenes import jpeg
from simulations.scenes.sensor_noise_stages import patch_means_e, saturation_e, sensor_of

CHAPTER = "06-digital-sensor"
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


def a_gaussian_of_hardly_an_electron() -> Says:
    mean = float(patch_means_e(-6.0)[-1])
    yield f"Light frees {mean:.2f} electrons in a cell there"
    below_zero = (1 - erf(sqrt(mean / 2))) / 2
    assert 0.3 < below_zero < 0.36
    yield "has a third of its area below zero"


def transforms_that_round_otherwise() -> Says:
    def changed(tier: str, **given: object) -> tuple[float, int]:
        values = check_values(jpeg.CONTROLS, given)
        *_, last = jpeg.error(values, tier, StageCache())
        found = re.search(r"\((\d+) round otherwise\)", last.label)
        assert found is not None
        return float(last.text) if tier == "fixed-point" else 0.0, int(found[1])

    best = {"quality": 100, "subsampling": "4:4:4"}
    error, at_low = changed("fixed-point", quality=30)
    assert 1 / 3 < error < 0.5
    yield "may be more than a third of a code off"
    assert 12 <= at_low <= 28
    yield "At quality 30 that moves some twenty of the numbers kept."
    assert changed("fixed-point", **best)[1] > 2000
    yield "it moves thousands of them"
    for tier in ("separable-32", "direct-32"):
        assert 25 <= changed(tier, **best)[1] <= 35
    yield "moves some thirty"


def coefficients_kept_and_lost() -> Says:
    step = 16
    kept, lost = round_outwards(np.array([37.0, 7.0]) / step)
    yield rf"$\mathrm{{round}}({37 / step:.2f}) = {kept:.0f}$ and comes back as {kept * step:.0f}"
    assert lost == 0
    yield "One of 7 becomes 0 and is gone."


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


def paper_under_a_lamp() -> Says:
    paper = 0.5 * xyz_to_linear_rgb(white_xyz(ILLUMINANT_A_XY))
    red, green, blue = paper
    yield f"$({red:.3f}, {green:.3f}, {blue:.3f})$"
    yield f"$0.413/0.923 = {green / red:.2f}$ for red"
    yield f"$0.413/0.117 = {green / blue:.1f}$ for blue"
    balanced = white_balance(paper, paper)
    yield f"the sheet is $({balanced[0]:.3f}, {balanced[1]:.3f}, {balanced[2]:.3f})$"
    yield f"is multiplied by {green / blue:.1f} as well"


def patches_by_lamplight_and_by_daylight() -> Says:
    """From the measured spectra of the chart, by another library."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # it interpolates, and misses packages for plotting
        import colour

        observer = colour.MSDS_CMFS["CIE 1931 2 Degree Standard Observer"]
        patches = colour.SDS_COLOURCHECKERS["ColorChecker N Ohta"].values()
        lamp, day = (
            np.array(
                [colour.sd_to_XYZ(p, observer, colour.SDS_ILLUMINANTS[light]) for p in patches]
            )
            / 100
            for light in ("A", "D65")
        )
    assert len(lamp) == 24
    rows = {"nothing": lamp}
    for words, method in (
        ("red, green and blue of linear sRGB", "rgb"),
        ("the cones, after von Kries", "von-kries"),
        ("Bradford's responses", "bradford"),
    ):
        rows[words] = adapt(lamp, ILLUMINANT_A_XY, D65_XY, method)
    for words, xyz in rows.items():
        yield f"| {words} | {lab_distance(xyz_to_lab(xyz), xyz_to_lab(day)).mean():.1f} |"


def gains_for_a_grey_card() -> Says:
    red, green, blue = white_balance([1, 1, 1], [0.3, 0.4, 0.6])
    assert green == 1
    yield f"- [ ] Red {0.3 / 0.4:.2f} and blue {0.6 / 0.4:.1f}"
    yield f"Differences of {0.4 - 0.3:.2f} and {0.6 - 0.4:.2f}"
    yield f"- [x] Red {red:.2f} and blue {blue:.2f}"
    yield f"$0.40/0.30 = {0.4 / 0.3:.2f}$ and $0.40/0.60 = {0.4 / 0.6:.2f}$"


WORKED = (
    choosing_a_gain,
    adding_noise_up,
    the_thirteenth_patch,
    patches_burnt_out_at_iso_800,
    a_gaussian_of_hardly_an_electron,
    transforms_that_round_otherwise,
    coefficients_kept_and_lost,
    what_green_is_worth,
    an_error_of_one_code,
    sixteen_bits,
    iso_and_snr,
    paper_under_a_lamp,
    patches_by_lamplight_and_by_daylight,
    gains_for_a_grey_card,
)
