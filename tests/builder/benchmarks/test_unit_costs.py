"""What a tier costs for each point, of a frame, and for the noise that it leaves."""

from dataclasses import replace

import pytest
from support.toy_ladder import toy_data, toy_ladder, toy_measurements

from site_builder.benchmarks.judgements import efficiency, frame_percent, nanoseconds_each
from site_builder.benchmarks.measurements import MeasurementError
from site_builder.markdown.roles.measured import measured_text


def test_a_time_is_divided_among_the_points_and_compared_with_a_frame() -> None:
    ladder = replace(toy_ladder(), items=1000, item="point")
    measured = replace(toy_measurements().find("toy"), ladder=ladder)
    fine = measured["fine"]  # 6 ms in the browser
    assert nanoseconds_each(measured, fine) == pytest.approx(6000)
    assert frame_percent(fine) == pytest.approx(18)


def test_half_the_noise_in_the_same_time_is_four_times_as_efficient() -> None:
    tiers = toy_data()["ladders"]["toy"]["tiers"]
    tiers["fine"]["errors"]["rms"] = tiers["rough"]["errors"]["rms"] / 2
    tiers["fine"]["browser"] = tiers["rough"]["browser"]
    measured = toy_measurements(tiers=tiers).find("toy")
    sampled = replace(measured, ladder=replace(measured.ladder, sampled=("rough", "fine")))
    assert efficiency(sampled, sampled["fine"]) == pytest.approx(4)
    assert efficiency(sampled, sampled["exact"]) is None


def test_the_role_refuses_a_cost_that_the_ladder_does_not_state() -> None:
    with pytest.raises(MeasurementError, match="states no 'each'"):
        measured_text("toy fine each", toy_measurements())
