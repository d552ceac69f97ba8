"""The filmed wheel: exact coverage and blur, against brute force."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from simulations.pictures import spoked_wheel

CANVAS = spoked_wheel.build_canvas()


def brute_force(place, duty, pixel, swept, steps=400):
    """Share of bars about whole numbers, by sampling pixel and exposure."""
    offsets = (np.arange(steps) + 0.5) / steps - 0.5
    u = place + pixel * offsets[:, None] + swept * offsets
    return np.mean(np.abs(u - np.rint(u)) < duty / 2)


@given(
    st.floats(-9, 9),
    st.floats(0.02, 0.95),
    st.floats(0.005, 0.4),
    st.sampled_from([0.0, 0.03, 0.5, 1.0, 2.6]),
)
def test_the_mean_over_pixel_and_exposure_is_exact(place, duty, pixel, swept):
    found = spoked_wheel.mean_coverage(np.array([place]), duty, pixel, swept)
    assert found[0] == pytest.approx(brute_force(place, duty, pixel, swept), abs=6e-3)


def test_a_blur_over_whole_spacings_is_even():
    places = np.linspace(-1, 1, 50)
    found = spoked_wheel.mean_coverage(places, 0.2, 0.01, 3.0)
    np.testing.assert_allclose(found, 0.2, atol=1e-9)


def test_a_wheel_looks_the_same_after_one_spacing():
    now = spoked_wheel.render(CANVAS, 8, 0.3, 0.1).astype(int)
    later = spoked_wheel.render(CANVAS, 8, 0.3 + 2 * np.pi / 8, 0.1).astype(int)
    assert np.abs(now - later).max() <= 1


def test_the_blur_starts_at_the_frame_and_follows_the_turn():
    """Where the spokes will be while the shutter is open, not where they were."""
    sharp_later = spoked_wheel.render(CANVAS, 4, 0.2, 0.0)[..., 0].astype(float)
    dark = sharp_later.min()
    forwards = spoked_wheel.render(CANVAS, 4, 0.0, 0.4)[..., 0].astype(float)
    backwards = spoked_wheel.render(CANVAS, 4, 0.0, -0.4)[..., 0].astype(float)
    spoke = sharp_later > 0.9 * sharp_later.max()
    assert forwards[spoke].min() > dark + 5
    assert backwards[spoke].min() == dark


def test_no_spoke_is_refused():
    with pytest.raises(ValueError, match="spokes 0; legal: 1 or more"):
        spoked_wheel.render(CANVAS, 0, 0.0, 0.0)
