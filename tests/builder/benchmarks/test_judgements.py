"""What measurements say of a tier: beaten, on the front, or chosen, and over what."""

from typing import Any

import pytest
from support.toy_ladder import timing, toy_data, toy_measurements

from site_builder.benchmarks.judgements import Neighbour, default_choice, off_the_front, verdict
from site_builder.benchmarks.measurements import MeasuredLadder


def tiers() -> Any:
    return toy_data()["ladders"]["toy"]["tiers"]


def measured_as(data: object, *metric: str) -> MeasuredLadder:
    return toy_measurements(tiers=data).find("toy", *metric)


def test_a_tier_is_beaten_by_the_quickest_that_is_no_worse() -> None:
    measured = measured_as(tiers())
    winners = {i.tier.id: measured.beaten_by(i, "native") for i in measured.tiers}
    assert {name: winner and winner.tier.id for name, winner in winners.items()} == {
        "rough": None, "fine": None, "waste": "fine", "exact": None,
    }  # fmt: skip


def test_a_tier_is_not_called_beaten_while_the_quartiles_overlap() -> None:
    data = tiers()
    data["waste"]["native"] = timing(2.2)
    measured = measured_as(data)
    assert measured.beaten_by(measured["waste"], "native") is None
    assert verdict(measured, measured["waste"]) == "beaten by Fine in the browser only"


def test_the_verdict_names_the_winner_even_where_the_loser_is_ours() -> None:
    measured = measured_as(tiers())
    assert verdict(measured, measured["waste"]) == "beaten by Fine"
    assert verdict(measured, measured["exact"]) == "on the front"


def test_errors_below_rounding_are_equally_good() -> None:
    data = tiers()
    data["fine"]["errors"]["rms"], data["exact"]["errors"]["rms"] = 2e-16, 1e-16
    measured = measured_as(data)
    winner = measured.beaten_by(measured["exact"], "native")
    assert winner is not None
    assert winner.tier.id == "fine"


@pytest.mark.parametrize(
    ("waste", "words"),
    [
        ({"native": 9.0, "browser": 1.0}, "beaten by Fine in CPython only"),
        ({"native": 0.5, "browser": 27.0}, "beaten by Fine in the browser only"),
        ({"native": 1.95, "browser": 6.1}, "on the front in CPython only"),
        ({"native": 2.1, "browser": 5.9}, "on the front in the browser only"),
        ({"native": 2.1, "browser": 6.1}, "close behind the front"),
    ],
)
def test_the_verdict_tells_the_sides_apart(waste: dict[str, float], words: str) -> None:
    """Fine takes 2 ms natively and 6 ms in the browser, and errs as much."""
    data = tiers()
    data["waste"] |= {side: timing(ms) for side, ms in waste.items()}
    data["waste"]["errors"] = data["fine"]["errors"]
    measured = measured_as(data)
    assert verdict(measured, measured["waste"]) == words


def test_another_metric_turns_what_is_better() -> None:
    data = tiers()
    data["waste"]["errors"]["psnr"] = 55.0
    measured = measured_as(data, "psnr")
    assert measured.beaten_by(measured["waste"], "native") is None
    front = [item.tier.id for item in measured.front("native")]
    assert front == ["rough", "fine", "waste", "exact"]


def test_a_default_stands_between_its_neighbours_on_the_browser_s_front() -> None:
    choice = default_choice(measured_as(tiers()))
    assert (choice.label, choice.ms, choice.error) == ("Fine", "6.0", "0.020\u00a0px")
    assert choice.cheaper == Neighbour("Rough", "0.25", "3.0\u00a0px")
    assert choice.dearer == Neighbour("Exact", "4.5", "no error")


def test_a_default_at_an_end_of_the_front_has_no_neighbour_there() -> None:
    data = tiers()
    data["fine"]["errors"]["rms"] = 0.0
    data["rough"]["browser"] = timing(7.0)
    choice = default_choice(measured_as(data))
    assert (choice.cheaper, choice.dearer) == (None, None)


def test_a_neighbour_that_only_rounding_puts_on_the_front_is_passed_over() -> None:
    data = tiers()
    data["fine"]["errors"]["rms"], data["exact"]["errors"]["rms"] = 2e-16, 1e-16
    measured = measured_as(data)
    assert [item.tier.id for item in measured.front("browser")] == ["rough", "fine", "exact"]
    assert default_choice(measured).dearer is None


def test_a_default_off_the_front_is_named_with_all_that_beat_it() -> None:
    data = tiers()
    data["exact"]["browser"] = timing(5.0)
    assert off_the_front(measured_as(data)) == (
        "toy: the default 'fine' (6.0 ms, 0.020\u00a0px) is off the browser's front, "
        "which has 'exact' (5.0 ms, no error)"
    )


def test_a_default_that_another_only_equals_in_time_and_error_is_on_the_front() -> None:
    data = tiers()
    data["waste"] = data["fine"]
    assert off_the_front(measured_as(data)) == ""
