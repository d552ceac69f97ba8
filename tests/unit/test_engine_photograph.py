"""The reader's own picture on its way into the stages of a scene."""

import numpy as np
import pytest

from simulations.engine.photograph import Photograph


def test_what_is_transparent_shows_a_white_ground() -> None:
    rgba = bytes((10, 20, 30, 255, 200, 100, 0, 0, 0, 0, 0, 128))
    picture = Photograph.from_canvas(1, rgba, 3, 1)
    np.testing.assert_array_equal(picture.codes, [[[10, 20, 30], [255] * 3, [127] * 3]])


@pytest.mark.parametrize("size", [(2, 2), (0, 0), (1, 3)])
def test_each_pixel_has_four_bytes(size: tuple[int, int]) -> None:
    with pytest.raises(ValueError, match="legal: four a pixel"):
        Photograph.from_canvas(1, bytes(8), *size)


def test_pictures_are_told_apart_by_their_number() -> None:
    black, white = (Photograph.from_canvas(1, bytes([level]) * 4, 1, 1) for level in (0, 255))
    assert black == white
    assert black != Photograph.from_canvas(2, bytes(4), 1, 1)
