"""CIE's colour spaces against scikit-image and the numbers of the standards."""

import numpy as np
import pytest
import skimage.color
from numpy.typing import ArrayLike

from simulations.models.color import cie, srgb

RGB = np.random.default_rng(4).random((500, 3))


@pytest.mark.parametrize("scale", [1.0, 0.08])
def test_lab_agrees_with_scikit_image(scale: float) -> None:
    theirs = skimage.color.rgb2lab(scale * RGB[None])[0]
    ours = cie.xyz_to_lab(cie.linear_rgb_to_xyz(srgb.decode_srgb(scale * RGB)))
    np.testing.assert_allclose(ours, theirs, atol=0.02)


def test_lightness_starts_as_a_line_of_slope_903() -> None:
    """CIE 15: L* = (29/3)³ Y up to Y = (6/29)³, and 116 Y^⅓ − 16 from there on."""
    white = cie.linear_rgb_to_xyz([1.0, 1, 1])
    end = (6 / 29) ** 3
    for y in (-0.01, 0.0, 0.5 * end, 0.9 * end, end):
        assert cie.xyz_to_lab(y * white)[0] == pytest.approx((29 / 3) ** 3 * y, abs=1e-9)
    assert cie.xyz_to_lab(1.1 * end * white)[0] == pytest.approx(116 * (1.1 * end) ** (1 / 3) - 16)


def test_luminance_is_the_y_of_xyz() -> None:
    np.testing.assert_allclose(cie.luminance(RGB), cie.linear_rgb_to_xyz(RGB)[..., 1])


SRGB = [[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]]
ADOBE = [[0.57667, 0.18556, 0.18823], [0.29734, 0.62736, 0.07529], [0.02703, 0.07069, 0.99134]]
ACES_AP0 = [
    [0.9525523959, 0.0, 0.0000936786],
    [0.3439664498, 0.7281660966, -0.0721325464],
    [0.0, 0.0, 1.0088251844],
]
ROMM = [[0.7977, 0.1352, 0.0314], [0.2880, 0.7119, 0.0001], [0.0, 0.0, 0.8252]]


@pytest.mark.parametrize(
    ("primaries", "white", "published", "digits"),
    [
        pytest.param(cie.SRGB_PRIMARIES_XY, cie.D65_XY, SRGB, 1e-4, id="sRGB"),
        pytest.param(
            ((0.64, 0.33), (0.21, 0.71), (0.15, 0.06)), cie.D65_XY, ADOBE, 1e-4, id="Adobe RGB"
        ),
        pytest.param(  # its blue has a negative y (SMPTE ST 2065-1)
            ((0.7347, 0.2653), (0.0, 1.0), (0.0001, -0.077)),
            (0.32168, 0.33767),
            ACES_AP0,
            1e-9,
            id="ACES AP0",
        ),
        pytest.param(  # its blue has y = 0.0001 (ISO 22028-2, as B. Lindbloom tabulates it)
            ((0.7347, 0.2653), (0.1596, 0.8404), (0.0366, 0.0001)),
            (0.3457, 0.3585),
            ROMM,
            3e-4,
            id="ROMM RGB",
        ),
    ],
)
def test_matrices_of_displays_are_the_published_ones(
    primaries: ArrayLike, white: ArrayLike, published: list[list[float]], digits: float
) -> None:
    np.testing.assert_allclose(cie.rgb_to_xyz_matrix(primaries, white), published, atol=digits)


def test_primaries_may_be_given_in_any_order_and_lie_close_together() -> None:
    red, green, blue = cie.SRGB_PRIMARIES_XY
    swapped = cie.rgb_to_xyz_matrix((green, red, blue))
    np.testing.assert_allclose(swapped[:, [1, 0, 2]], cie.rgb_to_xyz_matrix(), rtol=1e-12)
    close = cie.rgb_to_xyz_matrix(((0.3, 0.3), (0.3001, 0.3), (0.3, 0.3001)), (0.30003, 0.30003))
    assert close.sum(axis=1)[1] == pytest.approx(1)
