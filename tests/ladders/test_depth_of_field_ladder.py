"""Ways to blur by depth, against rays through the whole lens."""

import numpy as np
import pytest

from simulations.engine.ladder import pareto_front
from simulations.ladders.depth_of_field import LADDER, LENS_RADIUS, prepare, psnr_db, reference
from simulations.models.aperture import fibonacci_disc, random_disc
from simulations.models.vignetting import disc_overlap_area
from simulations.pictures import cards

WORK = prepare()
TRUTH = reference(WORK)
PSNR = {tier.id: psnr_db(tier.run(WORK), TRUTH, WORK) for tier in LADDER.tiers}
FILTERS = ("discs", "binned", "gather")


def test_filters_improve_on_a_pinhole_and_layers_on_filters() -> None:
    assert all(PSNR["pinhole"] + 8 < PSNR[name] < PSNR["layered"] - 2 for name in FILTERS)


def test_sixteen_rays_on_a_spiral_beat_every_filter_and_layer() -> None:
    assert PSNR["fibonacci-16"] > PSNR["layered"] + 5


def test_a_spiral_is_worth_many_times_as_many_random_rays() -> None:
    assert PSNR["fibonacci-16"] > PSNR["random-64"] + 5


def test_four_times_the_random_rays_are_worth_six_decibels() -> None:
    assert PSNR["random-64"] - PSNR["random-16"] == pytest.approx(10 * np.log10(4), abs=0.5)


def test_a_spiral_of_many_rays_leads_to_the_reference() -> None:
    total = sum(
        cards.radiance(WORK.x, WORK.y, *(LENS_RADIUS * point)) for point in fibonacci_disc(400)
    )
    assert psnr_db(total / 400, TRUTH, WORK) > PSNR["fibonacci-64"] + 8


def test_what_lies_in_focus_is_as_sharp_as_through_a_pinhole() -> None:
    pinhole = LADDER.tier("pinhole").run(WORK)
    on_the_middle_card = (slice(None), slice(17, 24), slice(44, 49))
    np.testing.assert_allclose(TRUTH[on_the_middle_card], pinhole[on_the_middle_card], atol=1e-4)


def test_a_card_out_of_focus_covers_the_share_of_the_lens_that_its_shadow_does() -> None:
    """Seen from a pixel, the card's edge cuts the lens as one disc cuts another."""
    near = cards.CARDS[-1]
    x, y = cards.normalised_pixels(np.float64)
    nodes = fibonacci_disc(2000) * LENS_RADIUS
    cover = sum(cards.card_light(near, x, y, *point)[1] for point in nodes) / len(nodes)
    shrink = abs(1 - near.z / cards.FOCUS_Z)
    away = np.hypot(x * near.z - near.x, y * near.z - near.y) / shrink
    share = disc_overlap_area(away, near.radius / shrink, LENS_RADIUS) / (np.pi * LENS_RADIUS**2)
    np.testing.assert_allclose(cover, share, atol=0.01)


def test_the_metric_notices_a_picture_that_has_moved_by_a_pixel() -> None:
    assert psnr_db(np.roll(TRUTH, 1, axis=2), TRUTH, WORK) < 30
    assert psnr_db(TRUTH + 1e-3, TRUTH, WORK) == pytest.approx(60)


def test_the_default_is_not_beaten_in_both_work_and_error() -> None:
    """Work in pictures' worth of values computed: a blur of a few taps counts as a picture."""
    work = {"pinhole": 1, "discs": 5, "layered": 8, "binned": 7, "gather": 50}
    work |= {"random-16": 16, "fibonacci-16": 16, "random-64": 64, "fibonacci-64": 64}
    front = pareto_front([(cost, -PSNR[tier]) for tier, cost in work.items()])
    assert front[list(work).index(LADDER.default_tier)]


@pytest.mark.parametrize("count", [1, 16, 500])
def test_points_of_a_spiral_share_the_disc_evenly(count: int) -> None:
    points = fibonacci_disc(count)
    square = np.sum(points**2, axis=1)
    assert square.max() < 1
    assert square.mean() == pytest.approx(0.5)
    assert np.abs(points.mean(axis=0)).max() < 1 / np.sqrt(count)


def test_random_points_have_the_moments_of_a_disc() -> None:
    points = random_disc(200, (20, 20), np.random.default_rng(3))
    assert points.shape == (200, 2, 20, 20)
    assert np.sum(points**2, axis=1).max() <= 1
    assert np.mean(points**2) == pytest.approx(0.25, abs=0.003)
    assert np.mean(points) == pytest.approx(0, abs=0.005)


def test_no_points_at_all_are_refused() -> None:
    with pytest.raises(ValueError, match=r"count 0; legal: 1 or more"):
        fibonacci_disc(0)
    with pytest.raises(ValueError, match=r"count 0; legal: 1 or more"):
        random_disc(0, (), np.random.default_rng(0))
