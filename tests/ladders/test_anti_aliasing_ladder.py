"""Filters before sampling, against what sampling theory says of a zone plate."""

import numpy as np
import pytest
from scipy.special import fresnel

from simulations.engine.ladder import pareto_front
from simulations.ladders.anti_aliasing import LADDER, SCALE, SIZE, prepare, reference
from simulations.models.sampling.aliasing import zone_plate_area

CENTRES = prepare()
TRUTH = reference(CENTRES)
MEASURED = {
    metric.id: {tier.id: metric.measure(tier.run(CENTRES), TRUTH, CENTRES) for tier in LADDER.tiers}
    for metric in LADDER.metrics
}
SAMPLES = {"point": 1, "area": 1, "box-2": 4, "box-4": 16, "box-8": 64, "sinc-4": 16}


def test_the_reference_agrees_with_fresnels_integrals() -> None:
    edges = np.append(CENTRES - 0.5, CENTRES[-1] + 0.5) * np.sqrt(2 / SCALE)
    sine, cosine = fresnel(edges)
    line = np.diff(cosine + 1j * sine) / np.sqrt(2 / SCALE)
    expected = 0.5 + 0.5 * np.real(line * line[:, None])
    np.testing.assert_allclose(TRUTH.area, expected, atol=1e-13)


def test_point_samples_show_false_rings_at_full_contrast() -> None:
    assert MEASURED["alias"]["point"] == pytest.approx(0.5 / np.sqrt(2), rel=0.01)
    assert MEASURED["loss"]["point"] < 1e-5


def test_no_box_gets_below_the_alias_that_a_pixels_own_area_lets_through() -> None:
    floor = np.sqrt(np.mean(np.square(TRUTH.area[TRUTH.out_of_band] - 0.5)))
    errors = np.array([MEASURED["alias"][f"box-{factor}"] for factor in (2, 4, 8)]) - floor
    assert np.all(errors > 0)
    np.testing.assert_allclose(errors[:-1] / errors[1:], 4, rtol=0.15)


def test_a_box_of_twice_the_samples_each_way_errs_a_quarter_as_much() -> None:
    errors = np.array([MEASURED["area"][f"box-{factor}"] for factor in (2, 4, 8)])
    np.testing.assert_allclose(errors[:-1] / errors[1:], 4, rtol=0.15)


def test_the_formula_for_a_pixels_area_beats_64_samples() -> None:
    assert MEASURED["area"]["area"] < 0.6 * MEASURED["area"]["box-8"]


@pytest.mark.parametrize("scale", [64.0, 128.0, 512.0])
def test_the_formulas_error_is_what_its_docstring_states(scale: float) -> None:
    """Near the centre the wave of frequency 0 misses the curvature pi / scale altogether."""
    nodes, weights = np.polynomial.legendre.leggauss(24)
    line = np.exp(1j * np.pi * (nodes / 2) ** 2 / scale) @ (weights / 2)
    exact = 0.5 + 0.5 * np.real(line * line)
    wrong = abs(zone_plate_area(0.0, 0.0, scale) - exact)
    assert wrong < 0.5 * np.pi / (12 * scale)


def test_a_sinc_leaves_less_alias_and_more_contrast_than_any_box() -> None:
    boxes = ("area", "box-2", "box-4", "box-8")
    assert all(4 * MEASURED["alias"]["sinc-4"] < MEASURED["alias"][box] for box in boxes)
    assert all(4 * MEASURED["loss"]["sinc-4"] < MEASURED["loss"][box] for box in boxes)


def test_the_metrics_notice_rings_that_are_shifted_by_half_a_pixel() -> None:
    shifted = LADDER.tier("area").run(CENTRES + 0.5)
    for metric in LADDER.metrics[1:]:
        assert metric.measure(shifted, TRUTH, CENTRES) > 2 * MEASURED[metric.id]["area"]
    assert TRUTH.area.shape == (SIZE, SIZE)


def test_the_default_is_not_beaten_in_both_work_and_error() -> None:
    ids = list(SAMPLES)
    front = pareto_front([(SAMPLES[tier], MEASURED["alias"][tier]) for tier in ids])
    assert front[ids.index(LADDER.default_tier)]
