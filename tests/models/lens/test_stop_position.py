"""The stop's place and the distortion it makes: against rays traced the other way, and in sign."""

import numpy as np
import pytest

from simulations.models.arrays import Floats
from simulations.models.lens.singlet import Singlet, refract, through_exact
from simulations.models.lens.stop_position import ChiefRays, chief_rays, chief_rays_of_pair

LENS = Singlet(1 / 50, -1 / 50, 6.0, 1.5)
SLOPES = np.linspace(0.02, 0.3, 15)


def distortion(rays: ChiefRays) -> Floats:
    return rays.image / rays.tan_field - 1.0


def test_before_the_lens_they_are_rays_from_a_point_of_the_axis() -> None:
    rays = chief_rays(LENS, -12.0, SLOPES)
    traced = through_exact(LENS, 12.0, 12.0 * SLOPES, 40.0)
    np.testing.assert_allclose(rays.places[:, 0], traced.front, rtol=1e-12)
    np.testing.assert_allclose(rays.places[:, 1], traced.back, rtol=1e-12)
    height = traced.back[:, 1] + (rays.image_mm - traced.back[:, 0]) * traced.slope
    np.testing.assert_allclose(rays.image * rays.focal_mm, height, rtol=1e-12)
    np.testing.assert_array_equal(rays.tan_field, SLOPES)


def test_traced_forwards_the_rays_with_the_stop_behind_come_to_its_centre() -> None:
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


@pytest.mark.parametrize(("stop_mm", "sign"), [(-20.0, -1), (-8.0, -1), (8.0, 1), (15.0, 1)])
def test_a_stop_in_front_makes_a_barrel_and_one_behind_a_pincushion(
    stop_mm: float, sign: int
) -> None:
    bent = sign * distortion(chief_rays(LENS, stop_mm, SLOPES))
    assert (bent > 0).all()
    assert (np.diff(bent) > 0).all()


@pytest.mark.parametrize(
    "lens", [Singlet(1 / 100, -1 / 100, 6.0, 1.5), Singlet(0, -1 / 50, 4, 1.6)]
)
def test_two_lenses_about_a_stop_cancel_most_of_it(lens: Singlet) -> None:
    pair = chief_rays_of_pair(lens, 10.0, SLOPES)
    alone = chief_rays(LENS, -10.0, pair.tan_field)
    assert (np.abs(distortion(pair)) < np.abs(distortion(alone)) / 4).all()


def test_a_pair_images_small_angles_as_its_focal_length_says() -> None:
    lens = Singlet(1 / 100, -1 / 120, 6.0, 1.5)
    assert distortion(chief_rays_of_pair(lens, 10.0, [1e-4]))[0] == pytest.approx(0, abs=1e-7)
    before, behind = np.split(chief_rays_of_pair(lens, 10.0, [0.1]).places[0], 2)
    np.testing.assert_array_equal(before, -behind[::-1])


def test_a_lost_ray_is_nan() -> None:
    assert np.isnan(chief_rays(LENS, -30.0, [5.0]).image).all()
