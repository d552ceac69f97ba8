"""A singlet lens and its stop: textbook formulas, Fermat’s principle, and lost rays."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import minimize

from simulations.models.arrays import Floats
from simulations.models.lens.singlet import (
    MISSES,
    PASSES,
    REFLECTED,
    Singlet,
    focal_mm,
    paraxial_image_mm,
    power_per_mm,
    refract,
    rim_mm,
    sag_mm,
    thin_power_per_mm,
    through_exact,
    through_paraxial,
    through_thin,
)
from simulations.models.lens.stop_position import ChiefRays, chief_rays, chief_rays_of_pair

EXAMPLE = Singlet(1 / 40, -1 / 40, 10.0, 1.5)


def optical_path(lens: Singlet, start: tuple[float, float], end: tuple[float, float]) -> float:
    """Heights (2,) on the two spheres of the path with the least optical length, in mm."""

    def length(heights: np.ndarray) -> float:
        low, high = heights
        front = (float(sag_mm(lens.front_per_mm, low)) - lens.thickness_mm / 2, low)
        back = (float(sag_mm(lens.back_per_mm, high)) + lens.thickness_mm / 2, high)
        inside = lens.index * math.dist(front, back)
        return math.dist(start, front) + inside + math.dist(back, end)

    return minimize(length, [0.0, 0.0], method="Nelder-Mead", options={"xatol": 1e-9}).x


@settings(deadline=None, max_examples=25)
@given(
    st.floats(-0.015, 0.03),
    st.floats(-0.03, 0.015),
    st.floats(4.0, 15.0),
    st.floats(1.3, 1.9),
    st.floats(60.0, 400.0),
    st.floats(1.0, 9.0),
)
def test_light_takes_the_path_of_least_time(
    front: float, back: float, thickness: float, index: float, distance: float, height: float
) -> None:
    lens = Singlet(front, back, thickness, index)
    rays = through_exact(lens, distance, [height], 22.0)
    if rays.fate[0] != PASSES:
        return
    # Close behind the glass, where no other path is as short.
    x, y = rays.back[0]
    end = (float(x) + 5.0, float(y + 5.0 * rays.slope[0]))
    found = optical_path(lens, (-distance, 0.0), end)
    np.testing.assert_allclose(found, [rays.front[0, 1], rays.back[0, 1]], atol=2e-4)


def test_focal_lengths_obey_the_lensmakers_equation() -> None:
    assert focal_mm(thin_power_per_mm(EXAMPLE)) == pytest.approx(40)
    ball = Singlet(1 / 10, -1 / 10, 20.0, 1.5)
    assert focal_mm(power_per_mm(ball)) == pytest.approx(1.5 * 20 / (4 * 0.5))
    assert paraxial_image_mm(ball, np.inf) == pytest.approx(15)  # counted from its centre
    assert focal_mm(power_per_mm(Singlet(0.0, 0.0, 5.0, 1.5))) == np.inf


@pytest.mark.parametrize("distance", [30.0, 80.0, np.inf])
def test_exact_paraxial_and_thin_lens_agree_near_the_axis(distance: float) -> None:
    exact = through_exact(EXAMPLE, distance, [1e-4], 22.0).crossing_mm
    assert exact == pytest.approx(paraxial_image_mm(EXAMPLE, distance), rel=1e-8)
    slim = Singlet(1 / 40, -1 / 40, 1e-6, 1.5)
    thin = through_thin(slim, distance, [1.0]).crossing_mm
    assert through_paraxial(slim, distance, [1.0]).crossing_mm == pytest.approx(thin, rel=1e-6)


def test_light_is_reflected_beyond_the_critical_angle() -> None:
    """Behind a flat front sin θ = h/R at the back, so that reflection is total where n h > R."""
    lens = Singlet(0.0, -1 / 25, 12.0, 1.5)
    heights = [25 / 1.5 - 1e-9, 25 / 1.5 + 1e-9]
    rays = through_exact(lens, np.inf, heights, 22.0)
    assert rays.fate.tolist() == [PASSES, REFLECTED]
    assert np.isfinite(rays.back[1]).all()
    assert np.isnan(rays.slope[1])


def test_rays_beyond_the_rim_miss_the_lens() -> None:
    assert rim_mm(EXAMPLE, 22.0) == pytest.approx(math.sqrt(40**2 - 35**2))
    assert rim_mm(EXAMPLE, 5.0) == 5.0
    assert rim_mm(Singlet(1 / 10, -1 / 20, 40.0, 1.5), 22.0) == pytest.approx(10)
    rays = through_exact(EXAMPLE, np.inf, [19.3, 19.4, 100.0], 22.0)
    assert rays.fate.tolist() == [PASSES, MISSES, MISSES]
    assert np.isnan(rays.front[1:]).all()
    assert np.isnan(rays.crossing_mm[1:]).all()


LENS = Singlet(1 / 50, -1 / 50, 6.0, 1.5)
SLOPES = np.linspace(0.02, 0.3, 15)


def distortion(rays: ChiefRays) -> Floats:
    return rays.image / rays.tan_field - 1.0


def test_chief_rays_with_the_stop_in_front_start_at_a_point_on_the_axis() -> None:
    rays = chief_rays(LENS, -12.0, SLOPES)
    traced = through_exact(LENS, 12.0, 12.0 * SLOPES, 40.0)
    np.testing.assert_allclose(rays.places[:, 0], traced.front, rtol=1e-12)
    np.testing.assert_allclose(rays.places[:, 1], traced.back, rtol=1e-12)
    height = traced.back[:, 1] + (rays.image_mm - traced.back[:, 0]) * traced.slope
    np.testing.assert_allclose(rays.image * rays.focal_mm, height, rtol=1e-12)
    np.testing.assert_array_equal(rays.tan_field, SLOPES)


def test_chief_rays_with_the_stop_behind_reach_its_centre() -> None:
    lens = Singlet(1 / 40, -1 / 90, 6.0, 1.5)
    rays = chief_rays(lens, 12.0, SLOPES)
    front, back = rays.places[:, 0], rays.places[:, 1]
    along = np.stack([np.ones_like(SLOPES), rays.tan_field], -1)
    along /= np.linalg.norm(along, axis=-1, keepdims=True)
    for place, vertex, curvature, ratio in (
        (front, -3.0, lens.front_per_mm, 1 / 1.5),
        (back, 3.0, lens.back_per_mm, 1.5),
    ):
        normal = np.array([1.0, 0.0]) - curvature * (place - np.array([vertex, 0.0]))
        along, _ = refract(along, normal, ratio)
    reached = back[:, 1] + (12.0 - back[:, 0]) * along[:, 1] / along[:, 0]
    np.testing.assert_allclose(reached, 0.0, atol=1e-12)
    np.testing.assert_allclose(along[:, 1] / along[:, 0], SLOPES, rtol=1e-12)


def test_lens_pair_images_small_angles_by_its_focal_length() -> None:
    lens = Singlet(1 / 100, -1 / 120, 6.0, 1.5)
    assert distortion(chief_rays_of_pair(lens, 10.0, [1e-4]))[0] == pytest.approx(0, abs=1e-7)
    before, behind = np.split(chief_rays_of_pair(lens, 10.0, [0.1]).places[0], 2)
    np.testing.assert_array_equal(before, -behind[::-1])
