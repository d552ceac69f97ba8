"""Which demosaicing method wins depends on whether the colours have edges in common."""

import numpy as np
import pytest
import skimage.data
from support.ladder_run import LadderRun

from simulations.ladders.demosaicing import CROP, LADDER, PICTURES
from simulations.models.color.srgb import decode_srgb, encode_srgb
from simulations.models.error_measures import psnr_db
from simulations.models.sensor.demosaicing import demosaic, mosaic
from simulations.models.sensor.shared_detail import shared_detail

RUN = LadderRun(LADDER)
METHODS = ("nearest", "bilinear", "malvar", "menon-unrefined", "menon", "menon-encoded")
ROOM, SOFT = PICTURES.index("room"), PICTURES.index("soft")


def psnr(metric: str) -> dict[str, float]:
    (chosen,) = (each for each in LADDER.metrics if each.id == metric)
    return {method: chosen.measure(RUN.results[method], RUN.truth, RUN.work) for method in METHODS}


def test_each_step_is_worth_decibels_where_the_colours_share_their_edges() -> None:
    room = psnr("psnr-room")
    assert room["bilinear"] > room["nearest"] + 3
    assert room["malvar"] > room["bilinear"] + 1
    assert room["menon-unrefined"] > room["malvar"] + 6
    assert room["menon-encoded"] > room["menon-unrefined"] + 1.5


def test_the_order_is_reversed_where_the_colours_have_nothing_in_common() -> None:
    soft = psnr("psnr-soft")
    assert soft["bilinear"] > soft["malvar"] + 4 > soft["menon-unrefined"] + 8
    assert soft["menon-unrefined"] > soft["menon"] + 1.5


def test_bilinear_errs_on_a_wave_by_what_its_mean_of_neighbours_leaves() -> None:
    """Midway between two samples of a wave the mean is the wave times cos(its phase step)."""
    rows, columns = 96, 120  # a red pixel; its right neighbour lacks red
    measured = RUN.results["bilinear"][SOFT][rows, columns + 1, 0] - 0.5
    step = 2 * np.pi * np.cos(0.2) / 12.0
    assert measured == pytest.approx(
        (RUN.truth[SOFT][rows, columns + 1, 0] - 0.5) * np.cos(step), abs=1e-6
    )


def test_as_displayed_no_linear_method_gains_on_detail_too_fine_for_a_mosaic() -> None:
    balloon = psnr("psnr-balloon")
    linear = [balloon[m] for m in ("bilinear", "malvar", "menon-unrefined", "menon")]
    assert np.ptp(linear) < 1
    assert balloon["menon-encoded"] > max(linear) + 1


def test_in_light_the_clever_methods_gain_on_the_same_picture() -> None:
    light = psnr("light")
    assert light["malvar"] > light["bilinear"] + 2
    assert light["menon-unrefined"] == max(light.values())
    assert light["menon-encoded"] < light["menon-unrefined"] - 1


def test_the_refinement_gains_next_to_nothing_on_the_room_and_loses_elsewhere() -> None:
    assert psnr("psnr-room")["menon"] < psnr("psnr-room")["menon-unrefined"] + 0.3
    for other in ("psnr-balloon", "psnr-soft", "light"):
        assert psnr(other)["menon-unrefined"] > psnr(other)["menon"] + 0.3


def photograph(name: str) -> np.ndarray:
    """A photograph in linear light, at half size, since its own camera has demosaiced it."""
    linear = decode_srgb(getattr(skimage.data, name)() / 255)
    rows, columns = (2 * (side // 2) for side in linear.shape[:2])
    halves = linear[:rows, :columns].reshape(rows // 2, 2, columns // 2, 2, 3)
    mean: np.ndarray = halves.mean(axis=(1, 3))
    return mean


@pytest.mark.parametrize("name", ["astronaut", "coffee", "chelsea", "rocket"])
def test_on_photographs_the_default_is_the_best_that_stays_in_light(name: str) -> None:
    """In light it wins, as displayed no other linear method is more than a tenth better."""
    truth = photograph(name)
    guessed = {m: np.clip(demosaic(mosaic(truth), method=m), 0, 1) for m in METHODS}
    light = {m: psnr_db(guess, truth, crop=CROP) for m, guess in guessed.items()}
    shown = {
        m: psnr_db(encode_srgb(guess), encode_srgb(truth), crop=CROP)
        for m, guess in guessed.items()
    }
    default = LADDER.default_tier
    assert light["bilinear"] < light["malvar"] - 0.9
    assert light["malvar"] < light[default] - 0.3
    assert shown[default] > max(shown[m] for m in METHODS if m != "menon-encoded") - 0.1
    assert shown["menon-encoded"] > shown[default] + 1.5
    assert min(shared_detail(truth)) > 0.4


def test_the_metric_notices_a_picture_that_has_moved_by_a_pixel() -> None:
    moved = tuple(np.roll(picture, 1, axis=1) for picture in RUN.truth)
    assert all(metric.measure(moved, RUN.truth, RUN.work) < 40 for metric in LADDER.metrics)
    assert LADDER.metrics[0].measure(RUN.truth, RUN.truth, RUN.work) == np.inf
