"""The reader's own picture on its way into the stages of a scene."""

from typing import Any

import numpy as np
import pytest

from simulations.engine.photograph import Photograph


@pytest.mark.parametrize(
    "codes", [np.zeros((2, 2), np.uint8), np.zeros((2, 2, 3)), np.zeros((0, 2, 3), np.uint8)]
)
def test_a_picture_has_three_codes_a_pixel(codes: Any) -> None:
    with pytest.raises(ValueError, match=r"legal: \(H, W, 3\) uint8"):
        Photograph(1, codes)


def test_pictures_are_told_apart_by_their_number() -> None:
    black, white = (np.full((1, 1, 3), level, np.uint8) for level in (0, 255))
    assert Photograph(1, black, "a", {"iso": 100}) == Photograph(1, white)
    assert Photograph(1, black) != Photograph(2, black)
    assert len({Photograph(1, black, facts={"iso": 100}), Photograph(1, white)}) == 1
