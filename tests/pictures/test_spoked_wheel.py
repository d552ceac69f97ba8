"""The filmed wheel: exact coverage and blur, against brute force."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from simulations.pictures import spoked_wheel

CANVAS = spoked_wheel.build_canvas()


def brute_force(place: float, duty: float, pixel: float, swept: float, steps: int = 400) -> float:
    """Share of bars about whole numbers, by sampling pixel and exposure."""
    offsets = (np.arange(steps) + 0.5) / steps - 0.5
    u = place + pixel * offsets[:, None] + swept * offsets
    return float(np.mean(np.abs(u - np.rint(u)) < duty / 2))


@given(
    st.floats(-9, 9),
    st.floats(0.02, 0.95),
    st.floats(0.005, 0.4),
    st.sampled_from([0.0, 0.03, 0.5, 1.0, 2.6]),
)
def test_the_mean_over_pixel_and_exposure_is_exact(
    place: float, duty: float, pixel: float, swept: float
) -> None:
    found = spoked_wheel.mean_coverage(np.array([place]), duty, pixel, swept)
    assert found[0] == pytest.approx(brute_force(place, duty, pixel, swept), abs=6e-3)


def test_a_blur_over_whole_spacings_is_even() -> None:
    places = np.linspace(-1, 1, 50)
    found = spoked_wheel.mean_coverage(places, 0.2, 0.01, 3.0)
    np.testing.assert_allclose(found, 0.2, atol=1e-9)


def test_a_wheel_looks_the_same_after_one_spacing() -> None:
    now = spoked_wheel.render(CANVAS, 8, 0.3, 0.1).astype(int)
    later = spoked_wheel.render(CANVAS, 8, 0.3 + 2 * np.pi / 8, 0.1).astype(int)
    assert np.abs(now - later).max() <= 1


def test_the_blur_starts_at_the_frame_and_follows_the_turn() -> None:
    """Where the spokes will be while the shutter is open, not where they were."""
    sharp_later = spoked_wheel.render(CANVAS, 4, 0.2, 0.0)[..., 0].astype(float)
    dark = sharp_later.min()
    forwards = spoked_wheel.render(CANVAS, 4, 0.0, 0.4)[..., 0].astype(float)
    backwards = spoked_wheel.render(CANVAS, 4, 0.0, -0.4)[..., 0].astype(float)
    spoke = sharp_later > 0.9 * sharp_later.max()
    assert forwards[spoke].min() > dark + 5
    assert backwards[spoke].min() == dark


def test_no_spoke_is_refused() -> None:
    with pytest.raises(ValueError, match="spokes 0; legal: whole numbers, 1 or more"):
        spoked_wheel.render(CANVAS, 0, 0.0, 0.0)


@given(
    st.floats(-9, 9),
    st.floats(0.02, 1.4),
    st.floats(0.005, 0.4),
    st.sampled_from([0.0, 0.4, -2.6]),
    st.sampled_from([0.0, 0.25, 1.0]),
)
def test_the_mean_over_a_pixel_at_one_moment_is_exact(
    place: float, duty: float, pixel: float, swept: float, time: float
) -> None:
    row = spoked_wheel.Bars(np.array([place]), np.array([duty]), np.array([pixel]), swept)
    found = spoked_wheel.at_moment(row, time)
    assert found[0] == pytest.approx(brute_force(place - swept * time, duty, pixel, 0.0), abs=6e-3)


@pytest.mark.parametrize("swept", [-2.6, -0.03, 0.0, 0.5])
def test_the_exposure_is_the_mean_of_its_moments(swept: float) -> None:
    rng = np.random.default_rng(8)
    place, duty, pixel = rng.uniform(-2, 2, 200), rng.uniform(0.05, 0.9, 200), np.full(200, 0.1)
    row = spoked_wheel.Bars(place, duty, pixel, swept)
    times = (np.arange(2000) + 0.5) / 2000
    mean = np.mean([spoked_wheel.at_moment(row, time) for time in times], axis=0)
    np.testing.assert_allclose(spoked_wheel.throughout(row), mean, atol=2e-5)


def test_places_are_counted_clockwise_from_the_first_spoke_in_spacings() -> None:
    row = spoked_wheel.bars(CANVAS, 8, 0.3, -0.1)
    np.testing.assert_allclose(row.place, (CANVAS.angle_rad - 0.3) * 8 / (2 * np.pi))
    np.testing.assert_allclose(row.duty, spoked_wheel.SPOKE * row.pixel)
    np.testing.assert_allclose(row.pixel * CANVAS.radius, 8 / (2 * np.pi))
    assert row.swept == pytest.approx(-0.1 * 8 / (2 * np.pi))
