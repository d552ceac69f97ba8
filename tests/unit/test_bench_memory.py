"""What ``make bench-latency`` says of memory that piles up."""

from bench.memory import INTERPRETER, grown

LEVEL = {"heap MB": 10.0, "nodes": 5000.0, "listeners": 300.0, INTERPRETER: 80.0}


def test_what_stays_level_is_not_spoken_of() -> None:
    filling, wandering = {**LEVEL, INTERPRETER: 60.0}, {**LEVEL, "heap MB": 10.4, "nodes": 4900.0}
    assert not [*grown([filling, LEVEL, {**LEVEL, "heap MB": 40.0}, wandering])]


def test_what_has_grown_from_half_to_the_end_is_named() -> None:
    (said,) = grown([LEVEL, LEVEL, LEVEL, {**LEVEL, INTERPRETER: 96.0}])
    assert said == "interpreter MB: 80 to 96, 20.0%; at most 2%"


def test_a_single_listener_more_is_one_too_many() -> None:
    assert [*grown([LEVEL, LEVEL, LEVEL, {**LEVEL, "listeners": 301.0}])]
