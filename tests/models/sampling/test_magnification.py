"""A magnified picture against one that was drawn larger, and against a ramp."""

import numpy as np
import pytest

from simulations.models.sampling.magnification import magnify
from simulations.pictures.resolution_chart import resolution_chart

FOCAL_PX = 200.0


def test_magnifying_agrees_with_a_chart_drawn_at_that_size() -> None:
    """Differential: interpolation against the analytic chart, whose scale is its focal length."""
    chart = resolution_chart(336, 256, FOCAL_PX)[..., 0]
    truth = resolution_chart(336, 256, FOCAL_PX * 1.02)[..., 0]
    before = np.abs(chart - truth)[8:-8, 8:-8]
    after = np.abs(magnify(chart, 1.02) - truth)[8:-8, 8:-8]
    assert after.mean() < 0.25 * before.mean()
    assert magnify(chart, 1.0) is chart


def test_magnifying_keeps_a_straight_ramp_to_the_last_digit() -> None:
    ramp = np.add.outer(np.arange(40.0), 3 * np.arange(60.0)).astype(np.float32)
    expected = ramp.mean() + (ramp - ramp.mean()) / 1.02
    assert magnify(ramp, 1.02)[4:-4, 4:-4] == pytest.approx(expected[4:-4, 4:-4], abs=1e-3)


@pytest.mark.parametrize("scale", [0.0, -1.0, float("nan"), float("inf")])
def test_a_scale_that_makes_no_picture_is_refused(scale: float) -> None:
    with pytest.raises(ValueError, match=r"scale .*; legal: above 0, finite"):
        magnify(np.zeros((4, 4), np.float32), scale)
