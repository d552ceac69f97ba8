"""The sRGB curve against the numbers of the standard."""

import numpy as np
import pytest

from simulations.models.color import srgb


def test_the_table_is_within_half_an_entry_of_the_steepest_part() -> None:
    light = np.linspace(0, 1, 200_001)
    off = 255 * np.abs(srgb.encode_srgb_table(light) - srgb.encode_srgb(light))
    assert off.max() < 255 * 12.92 * 0.5 / 65535 + 1e-4


def test_the_table_takes_nan_as_black_and_clips() -> None:
    wild = np.array([np.nan, -1, np.inf])
    np.testing.assert_array_equal(srgb.encode_srgb_table(wild), [0, 0, 1])
    np.testing.assert_array_equal(wild, [np.nan, -1, np.inf], "what was given stays as it was")
    assert srgb.encode_srgb_table(np.nan) == 0
    assert srgb.encode_srgb_table(np.empty((0, 3))).shape == (0, 3)


@pytest.mark.parametrize(
    ("linear", "encoded"),
    [(0.001, 0.01292), (0.0031, 0.040052), (0.18, 0.461356), (0.5, 0.735357), (1.0, 1.0)],
)
def test_the_curve_has_the_values_of_the_standard(linear: float, encoded: float) -> None:
    assert srgb.encode_srgb([linear, -linear]) == pytest.approx([encoded, -encoded], abs=1e-6)
    assert srgb.decode_srgb([encoded, -encoded]) == pytest.approx([linear, -linear], abs=1e-6)


def test_the_ends_of_the_straight_piece_belong_to_it_and_what_is_beyond_to_the_curve() -> None:
    assert srgb.encode_srgb(0.0031308) == 12.92 * 0.0031308
    assert srgb.decode_srgb(0.04045) == 0.04045 / 12.92
    assert srgb.decode_srgb(0.042) == pytest.approx(((0.042 + 0.055) / 1.055) ** 2.4, rel=1e-14)


def test_the_table_takes_the_nearest_of_its_entries() -> None:
    """Entry k stands for light k/65535; halfway to the next, that one begins."""
    for k in (0, 1, 700, 65534):
        entry = np.float32(srgb.encode_srgb(k / 65535))
        assert srgb.encode_srgb_table((k + 0.49) / 65535) == entry
        assert srgb.encode_srgb_table((k + 0.51) / 65535) > entry
