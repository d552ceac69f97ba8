"""Light from the codes of a file."""

import numpy as np
import pytest
from support.edges import gaussian_edge, gaussian_half, grain

from simulations.models.arrays import Floats
from simulations.models.color.srgb import encode_srgb
from simulations.models.sampling.slanted_edge import read_edge
from simulations.models.sampling.slanted_edge_file import TOO_DARK, TOO_LIGHT, light_of_codes
from simulations.models.sampling.slanted_edge_line import UnfitEdgeError


def file_of(light: Floats) -> np.ndarray[tuple[int, ...], np.dtype[np.uint8]]:
    """(H, W, 3) codes of grey."""
    codes = np.rint(255 * encode_srgb(np.clip(light, 0, 1))).astype(np.uint8)
    return np.repeat(codes[..., None], 3, axis=2)


LIGHT = 0.05 + 0.8 * gaussian_edge(80, 80, 5.0) + grain((80, 80), 0.005, 1)


def test_srgb_is_taken_out_before_the_edge_is_measured() -> None:
    right, wrong = (
        read_edge(light_of_codes(file_of(LIGHT), srgb=srgb)).half_contrast().frequency
        for srgb in (True, False)
    )
    assert right == pytest.approx(gaussian_half(1.0), rel=0.01)
    assert wrong < 0.97 * right


def test_codes_at_either_end_are_refused() -> None:
    for light, message in ((2.0 * LIGHT, TOO_LIGHT), (LIGHT - 0.06, TOO_DARK)):
        with pytest.raises(UnfitEdgeError, match=message[:20]):
            light_of_codes(file_of(light), srgb=True)


@pytest.mark.parametrize(
    "codes",
    [
        np.zeros((4, 4), np.uint8),
        np.zeros((4, 4, 3)),
    ],
)
def test_only_codes_of_three_colours_are_legal(
    codes: np.ndarray[tuple[int, ...], np.dtype[np.uint8]],
) -> None:
    with pytest.raises(ValueError, match="legal"):
        light_of_codes(codes, srgb=True)
