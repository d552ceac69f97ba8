"""Chromatic adaptation and chromaticities against colour-science, littleCMS and real spectra."""

import warnings
from collections.abc import Sequence

import numpy as np
import pytest
import skimage.color
from PIL import ImageCms

from simulations.models.arrays import Floats
from simulations.models.color import cie, white_balance
from simulations.models.color.chromatic_adaptation import adapt, adaptation_matrix
from simulations.models.color.chromaticity import (
    D50_XY,
    ILLUMINANT_A_XY,
    lab_distance,
    white_xyz,
    xyy_to_xyz,
    xyz_to_xyy,
)
from simulations.models.color.cie import D65_XY

with warnings.catch_warnings():
    warnings.simplefilter("ignore")  # it misses packages for plotting
    import colour as oracle

METHODS = ("bradford", "von-kries", "rgb")
NAMES = {"bradford": "Bradford", "von-kries": "Von Kries"}
RNG = np.random.default_rng(0)
COLOURS = RNG.uniform(0.0, 1.0, (50, 3))


@pytest.fixture(scope="module")
def chart() -> dict[str, Floats]:
    """The 24 patches of a colour chart, from their measured spectra: XYZ under A and under D65."""
    observer = oracle.MSDS_CMFS["CIE 1931 2 Degree Standard Observer"]
    patches = oracle.SDS_COLOURCHECKERS["ColorChecker N Ohta"].values()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # it tells that it interpolates spectra
        return {
            name: np.array(
                [oracle.sd_to_XYZ(p, observer, oracle.SDS_ILLUMINANTS[name]) for p in patches]
            )
            / 100
            for name in ("A", "D65")
        }


@pytest.mark.parametrize("method", NAMES)
@pytest.mark.parametrize("lights", [(ILLUMINANT_A_XY, D65_XY), (D65_XY, D50_XY)])
def test_matrices_are_those_of_colour_science(
    method: str, lights: tuple[tuple[float, float], tuple[float, float]]
) -> None:
    """It rounds the inverse of the responses in no way that matters here."""
    whites = [oracle.xy_to_XYZ(xy) for xy in lights]
    theirs = oracle.adaptation.matrix_chromatic_adaptation_VonKries(
        *whites, transform=NAMES[method]
    )
    np.testing.assert_allclose(adaptation_matrix(*lights, method), theirs, atol=1e-12)


def test_a_colour_profile_holds_the_same_bradford_matrix() -> None:
    """littleCMS writes it, rounded to 1/65536, into the profiles that it makes."""
    profile = ImageCms.ImageCmsProfile(ImageCms.createProfile("sRGB")).profile
    primaries = [profile.red_colorant, profile.green_colorant, profile.blue_colorant]
    theirs = np.array([colorant[0] for colorant in primaries if colorant])
    ours = adapt(cie.linear_rgb_to_xyz(np.eye(3)), D65_XY, D50_XY)
    np.testing.assert_allclose(ours, theirs, atol=3e-4)  # its D50 has four digits


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("lights", [(ILLUMINANT_A_XY, D65_XY), (D65_XY, D50_XY)])
def test_the_white_of_one_light_becomes_that_of_the_other(
    method: str, lights: tuple[tuple[float, float], tuple[float, float]]
) -> None:
    before, after = map(white_xyz, lights)
    np.testing.assert_allclose(adapt(before, *lights, method), after, rtol=1e-14)
    np.testing.assert_allclose(adapt(0.3 * before, *lights, method), 0.3 * after, rtol=1e-14)


@pytest.mark.parametrize("method", METHODS)
def test_the_way_back_is_the_inverse(method: str) -> None:
    there = adapt(COLOURS, ILLUMINANT_A_XY, D65_XY, method)
    back = adapt(there, D65_XY, ILLUMINANT_A_XY, method)
    np.testing.assert_allclose(back, COLOURS, atol=1e-14)


@pytest.mark.parametrize("method", METHODS)
def test_the_same_light_changes_nothing(method: str) -> None:
    np.testing.assert_allclose(adaptation_matrix(D65_XY, D65_XY, method), np.eye(3), atol=1e-15)


def test_gains_in_rgb_are_white_balance() -> None:
    linear = cie.xyz_to_linear_rgb(COLOURS)
    lamp = cie.xyz_to_linear_rgb(white_xyz(ILLUMINANT_A_XY))
    balanced = white_balance.white_balance(linear, lamp) / lamp[1]
    ours = cie.xyz_to_linear_rgb(adapt(COLOURS, ILLUMINANT_A_XY, D65_XY, "rgb"))
    np.testing.assert_allclose(ours, balanced, atol=1e-13)


def test_white_paper_is_white_whatever_the_responses_and_bradford_is_nearest_for_colours(
    chart: dict[str, Floats],
) -> None:
    """Against what the spectra of the chart's patches really give under the other light."""
    true = cie.xyz_to_lab(chart["D65"])

    def mean_distance(xyz: Floats) -> float:
        return lab_distance(cie.xyz_to_lab(xyz), true).mean()

    found = {m: mean_distance(adapt(chart["A"], ILLUMINANT_A_XY, D65_XY, m)) for m in METHODS}
    assert found["bradford"] < 4 < found["von-kries"] < 8 < found["rgb"]
    assert found["rgb"] < mean_distance(chart["A"])


def test_chromaticities_are_those_of_colour_science() -> None:
    np.testing.assert_allclose(xyz_to_xyy(COLOURS), oracle.XYZ_to_xyY(COLOURS), rtol=1e-14)
    pairs = RNG.uniform(0.1, 0.5, (50, 3))
    np.testing.assert_allclose(xyy_to_xyz(pairs), oracle.xyY_to_XYZ(pairs), rtol=1e-13)


def test_whites_are_those_of_colour_science() -> None:
    whites = oracle.CCS_ILLUMINANTS["CIE 1931 2 Degree Standard Observer"]
    for name, xy in (("A", ILLUMINANT_A_XY), ("D50", D50_XY), ("D65", D65_XY)):
        np.testing.assert_allclose(xy, whites[name], atol=5e-5)
        np.testing.assert_allclose(white_xyz(xy), oracle.xy_to_XYZ(xy), rtol=1e-14)


def test_black_has_the_chromaticity_of_white() -> None:
    colours = xyz_to_xyy([[0.0, 0.0, 0.0], [0.2, 0.3, 0.5]])
    np.testing.assert_allclose(colours, [[*D65_XY, 0.0], [0.2, 0.3, 0.3]])
    np.testing.assert_allclose(xyy_to_xyz(colours[0]), 0.0)


@pytest.mark.parametrize("size", [5e-324, 1e-310, 1.7e308])
def test_neither_tiny_nor_huge_colours_lose_their_chromaticity(size: float) -> None:
    np.testing.assert_allclose(xyz_to_xyy([size, size, size])[:2], [1 / 3, 1 / 3], rtol=1e-15)


@pytest.mark.parametrize(
    "xyz", [[np.nan, 1, 1], [np.inf, 1, 1], [1, -1, -1], [-1.0, 1.0, 0.0], [-1, -1, -1]]
)
def test_what_has_no_chromaticity_is_given_that_of_daylight(xyz: Sequence[float]) -> None:
    assert xyz_to_xyy(xyz)[:2].tolist() == [*D65_XY]


def test_colours_of_one_part_and_imaginary_ones_have_a_chromaticity() -> None:
    assert xyz_to_xyy([0.0, 0.5, 0.5]).tolist() == [0.0, 0.5, 0.5]
    assert xyz_to_xyy([1.0, -0.25, -0.25]).tolist() == [2.0, -0.5, -0.25]


def test_whole_pictures_keep_their_shape() -> None:
    picture = COLOURS[:24].reshape(4, 6, 3)
    np.testing.assert_array_equal(xyz_to_xyy(picture)[2, 3], xyz_to_xyy(picture[2, 3]))
    np.testing.assert_array_equal(xyy_to_xyz(picture)[2, 3], xyy_to_xyz(picture[2, 3]))
    np.testing.assert_allclose(
        adapt(picture, D65_XY, D50_XY)[2, 3], adapt(picture[2, 3], D65_XY, D50_XY), rtol=1e-14
    )
    assert lab_distance(picture, picture[0, 0]).shape == (4, 6)


def test_lights_at_the_edge_of_all_chromaticities_have_a_white() -> None:
    np.testing.assert_allclose(white_xyz((0.0, 0.5)), [0.0, 1.0, 1.0])
    np.testing.assert_allclose(white_xyz((0.5, 0.5)), [1.0, 1.0, 0.0])
    np.testing.assert_allclose(white_xyz((0.1, 1e-5)), [1e4, 1.0, 89999.0], rtol=1e-10)


def test_a_light_with_hardly_a_response_is_still_a_light() -> None:
    """On the way from daylight to pure green, just before the short response is gone."""
    faint = 0.116308 * np.array(D65_XY) + (1 - 0.116308) * np.array([0.2, 0.8])
    matrix = adaptation_matrix(faint, D65_XY)
    np.testing.assert_allclose(matrix @ white_xyz(faint), white_xyz(D65_XY), rtol=1e-9)


def test_a_chromaticity_without_luminance_stands_for_no_colour() -> None:
    assert np.isnan(xyy_to_xyz([0.5, 0.0, 0.0])[0])
    assert xyy_to_xyz([0.5, 0.0, 1.0])[0] == np.inf


def test_distances_are_those_of_scikit_image() -> None:
    labs = RNG.uniform(-50, 50, (2, 20, 3))
    np.testing.assert_allclose(lab_distance(*labs), skimage.color.deltaE_cie76(*labs))
    assert np.isnan(lab_distance([np.inf, 0, 0], [np.inf, 0, 0]))


def test_what_is_beyond_all_numbers_is_infinite() -> None:
    assert adapt([1e308, 1e308, 1e308], ILLUMINANT_A_XY, D65_XY)[2] == np.inf


def test_float32_stays_float32() -> None:
    pixels = COLOURS.astype(np.float32)
    assert adapt(pixels, D65_XY, D50_XY).dtype == np.float32
    assert xyz_to_xyy(pixels).dtype == np.float32


@pytest.mark.parametrize(
    "xy",
    [
        (0.3, 0.0),
        (0.3, 1e-7),
        (0.3, 1e-6),
        (-0.1, 0.3),
        (0.6, 0.5),
        (np.nan, 0.3),
        (0.3, np.nan),
        (np.inf, 0.3),
        (0.3, 0.3, 0.4),
        0.3,
    ],
)
def test_what_is_no_chromaticity_is_refused(xy: Sequence[float] | float) -> None:
    with pytest.raises(ValueError, match=r"chromaticity .*; legal: x ≥ 0"):
        white_xyz(xy)
    with pytest.raises(ValueError, match="chromaticity"):
        adaptation_matrix(D65_XY, xy)


@pytest.mark.parametrize("method", METHODS)
def test_a_light_without_one_of_the_responses_is_refused(method: str) -> None:
    """Pure green light: nothing is left for the receptors of blue."""
    with pytest.raises(ValueError, match=rf"light .*{method} responses"):
        adaptation_matrix((0.2, 0.8), D65_XY, method)
    with pytest.raises(ValueError, match=rf"light .*{method} responses"):
        adaptation_matrix(D65_XY, (0.2, 0.8), method)


def test_unknown_methods_and_what_is_no_colour_are_refused() -> None:
    with pytest.raises(ValueError, match="'cat02'; legal: bradford, von-kries, rgb"):
        adaptation_matrix(D65_XY, D50_XY, "cat02")
    for function in (xyz_to_xyy, xyy_to_xyz, lambda v: adapt(v, D65_XY, D50_XY)):
        with pytest.raises(ValueError, match=r"legal: \(\.\.\., 3\)"):
            function([0.1, 0.2])
