"""A magnified picture against one that was drawn larger, and against a ramp."""

import numpy as np
import pytest

from simulations.models.sampling.magnification import magnify


def test_magnifying_keeps_a_straight_ramp_to_the_last_digit() -> None:
    ramp = np.add.outer(np.arange(40.0), 3 * np.arange(60.0)).astype(np.float32)
    expected = ramp.mean() + (ramp - ramp.mean()) / 1.02
    assert magnify(ramp, 1.02)[4:-4, 4:-4] == pytest.approx(expected[4:-4, 4:-4], abs=1e-3)


def test_a_picture_of_the_same_size_is_returned_as_it_is() -> None:
    picture = np.ones((4, 5), np.float32)
    assert magnify(picture, 1.0) is picture
