"""The stand-ins for the sRGB curve err as the curve says they must."""

import numpy as np
import pytest

from simulations.ladders.srgb import LADDER, prepare, reference, rms_codes, worst_codes

LINEAR = prepare()
TRUTH = reference(LINEAR)
WORST = {tier.id: worst_codes(tier.run(LINEAR), TRUTH, LINEAR) for tier in LADDER.tiers}


def test_the_workload_spreads_over_all_codes() -> None:
    counts, _ = np.histogram(TRUTH, bins=16, range=(0.0, 1.0))
    assert counts.min() > 0.5 * TRUTH.size / 16


def test_the_reference_is_undone_by_the_decoding_curve_of_the_standard() -> None:
    decoded = np.where(TRUTH <= 0.04045, TRUTH / 12.92, ((TRUTH + 0.055) / 1.055) ** 2.4)
    np.testing.assert_allclose(decoded, LINEAR, rtol=1e-6)


def test_the_plain_power_errs_most_near_black_by_eight_and_a_half_codes() -> None:
    light = np.linspace(0.0, 1.0, 2_000_001)
    curve = np.where(light <= 0.0031308, 12.92 * light, 1.055 * light ** (1 / 2.4) - 0.055)
    theory = 255.0 * np.abs(light ** (1 / 2.2) - curve).max()
    assert theory == pytest.approx(8.55, abs=0.01)
    assert WORST["power-1/2.2"] == pytest.approx(theory, rel=1e-3)


def test_the_table_stays_within_half_an_entry_where_the_curve_is_steepest() -> None:
    assert 0.02 < WORST["table"] < 255 * 12.92 * 0.5 / 65535 + 1e-4


def test_the_exact_curve_errs_only_by_the_rounding_of_float32() -> None:
    assert WORST["exact"] < 255 * 4 * np.finfo(np.float32).eps


def test_the_metrics_measure_a_known_offset_in_codes() -> None:
    shifted = TRUTH + 3.0 / 255.0
    assert worst_codes(shifted, TRUTH, LINEAR) == pytest.approx(3.0)
    assert rms_codes(shifted, TRUTH, LINEAR) == pytest.approx(3.0)
