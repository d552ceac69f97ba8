"""Ways to blur by depth, against rays through the whole lens."""

from functools import cache

import numpy as np
import pytest

from simulations.ladders import wide_discs
from simulations.ladders.depth_of_field import truth as depth_of_field_truth
from simulations.ladders.depth_of_field.ladder import (
    LADDER,
    fidelity_db,
    layered,
    prepare,
    radius_px,
    reference,
)
from simulations.models.arrays import Floats
from simulations.models.lens.aperture import fibonacci_disc, random_disc
from simulations.models.lens.vignetting import disc_overlap_area
from simulations.pictures import cards

WORK = prepare()
FILTERS = ("discs", "binned", "gather")


@cache
def truth() -> Floats:
    return reference(WORK)


@cache
def through_a_pinhole() -> Floats:
    return depth_of_field_truth.picture(80, 0.0, 4096)


@cache
def psnr() -> dict[str, float]:
    return {tier.id: fidelity_db(tier.run(WORK), truth(), WORK) for tier in LADDER.tiers}


@cache
def wide() -> dict[str, float]:
    """PSNR of the tiers with wide discs, without those that take seconds."""
    work = wide_discs.prepare()
    exact = wide_discs.LADDER.reference(work)
    slow = ("gather",)
    return {
        tier.id: fidelity_db(tier.run(work), exact, work)
        for tier in wide_discs.LADDER.tiers
        if tier.id not in slow
    }


def test_the_discs_are_as_wide_as_each_ladder_says() -> None:
    near, wall = cards.CARDS[-1].z, cards.WALL_Z
    assert float(radius_px(WORK, near)) == pytest.approx(3.9, abs=0.05)
    assert float(radius_px(WORK, wall)) == pytest.approx(2.8, abs=0.05)
    assert float(radius_px(wide_discs.prepare(), near)) == pytest.approx(24, abs=0.1)
    assert float(radius_px(wide_discs.prepare(), wall)) == pytest.approx(17, abs=0.2)


def test_filters_improve_on_a_pinhole_and_layers_on_filters() -> None:
    assert all(psnr()["pinhole"] + 8 < psnr()[name] < psnr()["layered"] - 2 for name in FILTERS)


def test_sixteen_rays_on_a_spiral_beat_every_filter_and_layer() -> None:
    assert psnr()["fibonacci-16"] > psnr()["layered"] + 5


def test_each_step_towards_even_spreading_is_worth_five_decibels() -> None:
    """Independent, one in each cell, a spiral; as many rays each."""
    assert psnr()["jittered-16"] > psnr()["random-16"] + 5
    assert psnr()["fibonacci-16"] > psnr()["jittered-16"] + 4


def test_a_spiral_of_each_pixel_s_own_is_as_good_as_one_for_all() -> None:
    assert psnr()["turned-16"] == pytest.approx(psnr()["fibonacci-16"], abs=0.5)


def test_turning_the_spiral_makes_grain_of_ghosts() -> None:
    """Grain is an error that does not go on in the next pixel; a ghost's edge does."""

    def continued(tier: str) -> float:
        error = (LADDER.tier(tier).run(WORK) - truth())[:, 8:-8, 8:-8]
        return float((error[..., 1:] * error[..., :-1]).mean() / (error**2).mean())

    assert continued("fibonacci-16") > continued("turned-16") + 0.15
    assert abs(continued("random-16")) < 0.05


def test_four_times_the_independent_rays_are_worth_six_decibels() -> None:
    rays = random_disc(64, WORK.seen.shape, np.random.default_rng(7)) * np.float32(WORK.lens_radius)
    total = sum((cards.radiance(WORK.seen, x, y) for x, y in rays), start=np.zeros_like(truth()))
    many = fidelity_db((total / 64).astype(np.float32), truth(), WORK)
    assert many - psnr()["random-16"] == pytest.approx(10 * np.log10(4), abs=0.5)


def test_a_spiral_of_many_rays_leads_to_the_reference() -> None:
    """But for the pixel's own mean, which the tiers take by formulas that are right to 50 dB."""
    rays = (cards.radiance(WORK.seen, *(WORK.lens_radius * point)) for point in fibonacci_disc(400))
    total = sum(rays, start=np.zeros_like(truth()))
    assert fidelity_db((total / 400).astype(np.float32), truth(), WORK) > psnr()["fibonacci-64"] + 1


def test_a_pinhole_sees_the_mean_over_each_pixel() -> None:
    """Rays of no width against formulas for areas: neither has a line of the other."""
    areas = cards.radiance(WORK.seen, 0.0, 0.0)
    rays = through_a_pinhole()
    assert fidelity_db(areas, rays, WORK) > 43


def test_more_rays_change_the_reference_less_than_any_tier_is_off() -> None:
    assert fidelity_db(reference(WORK, rays=9000), truth(), WORK) > psnr()["fibonacci-64"] + 6


def test_places_in_pixel_and_lens_are_spread_as_evenly_as_they_are_many() -> None:
    """Each 64th of each axis gets its share, and all pairs of axes are uncorrelated."""
    places = depth_of_field_truth.spread_evenly(2048)
    for along in places.T:
        assert np.abs(np.histogram(along, 64, (0, 1))[0] - 32).max() <= 8
    assert np.abs(np.corrcoef(places.T) - np.eye(4)).max() < 0.02


def test_wide_discs_cost_layers_their_lead() -> None:
    """Sixteen rays are now no better than layers, and 64 are needed."""
    assert wide()["layered"] < psnr()["layered"] - 4
    assert abs(wide()["layered"] - wide()["fibonacci-16"]) < 1
    assert wide()["fibonacci-64"] > wide()["layered"] + 8
    assert wide()["layered"] > max(wide()[name] for name in ("discs", "binned")) + 4


def test_how_a_wide_disc_is_drawn_hardly_shows() -> None:
    assert wide()["layered-taps"] == pytest.approx(wide()["layered"], abs=1e-3)
    assert wide()["layered"] - 0.2 < wide()["layered-pyramid"] < wide()["layered"] + 0.05


def test_layers_of_narrow_discs_are_the_same_however_they_are_drawn() -> None:
    taps = wide_discs.LADDER.tier("layered-taps").run(WORK)
    np.testing.assert_allclose(taps, layered(WORK), atol=1e-6)


def test_what_lies_in_focus_is_as_sharp_as_through_a_pinhole() -> None:
    sharp = through_a_pinhole()
    on_the_middle_card = (slice(None), slice(17, 24), slice(44, 49))
    np.testing.assert_allclose(truth()[on_the_middle_card], sharp[on_the_middle_card], atol=0.01)


def test_a_card_out_of_focus_covers_the_share_of_the_lens_that_its_shadow_does() -> None:
    """Seen from a pixel, the card's edge cuts the lens as one disc cuts another."""
    near = cards.CARDS[-1]
    seen, lens_radius = cards.pixels(80, np.float64), WORK.lens_radius
    nodes = fibonacci_disc(2000) * lens_radius
    cover = sum(cards.card_light(near, seen, *point)[1] for point in nodes) / len(nodes)
    shrink = abs(1 - near.z / cards.FOCUS_Z)
    away = np.hypot(seen.x * near.z - near.x, seen.y * near.z - near.y) / shrink
    share = disc_overlap_area(away, near.radius / shrink, lens_radius) / (np.pi * lens_radius**2)
    np.testing.assert_allclose(cover, share, atol=0.01)


def test_the_metric_notices_a_picture_that_has_moved_by_a_pixel() -> None:
    assert fidelity_db(np.roll(truth(), 1, axis=2), truth(), WORK) < 30
    assert fidelity_db(truth() + 1e-3, truth(), WORK) == pytest.approx(60)
