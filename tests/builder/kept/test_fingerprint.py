"""Equal values have equal fingerprints; values that differ in anything that counts do not."""

import functools
import itertools
import subprocess
import sys
from dataclasses import dataclass

import numpy as np
import pytest
from markupsafe import Markup

from site_builder.kept.fingerprint import Prints, fingerprint


@dataclass(frozen=True)
class Point:
    x: object
    y: object


@dataclass(frozen=True)
class Pair:
    x: object
    y: object


DIFFERENT: list[object] = [
    None, True, 1, 1.0, -0.0, 0.0, "1", b"1", Markup("1"), (), (1,), ((1,),), (1, 2), ("1", "2"),
    ("12",), {1: 2}, {2: 1}, {1: 2, 3: 4}, {3: 4, 1: 2}, {1, 2}, frozenset(), Point(1, 2),
    Point(2, 1), Pair(1, 2), np.zeros(2), np.zeros(2, np.float32), np.zeros((2, 1)), np.float64(0),
    functools.partial(Point, 1), functools.partial(Point, 2),
]  # fmt: skip


def name(value: object) -> bytes | None:
    return b"point" if value is Point else None


def test_values_that_differ_have_different_fingerprints() -> None:
    for one, other in itertools.combinations(DIFFERENT, 2):
        assert fingerprint(one, name) != fingerprint(other, name), (one, other)


def test_a_list_counts_as_its_tuple() -> None:
    assert fingerprint([1, "a"]) == fingerprint((1, "a"))


def test_another_process_with_another_hash_seed_agrees() -> None:
    value = "({'b', 'a', 'c'}, {'k': 1.5}, 'é')"
    code = (
        f"from site_builder.kept.fingerprint import fingerprint; print(fingerprint({value}).hex())"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], env={"PYTHONHASHSEED": "7"},
        capture_output=True, text=True, check=True,
    )  # fmt: skip
    assert done.stdout.strip() == fingerprint(({"b", "a", "c"}, {"k": 1.5}, "é")).hex()


@dataclass
class Open:
    x: object


def test_a_frozen_value_is_walked_once_and_then_known_by_identity() -> None:
    asked: list[object] = []

    def count(value: object) -> bytes | None:
        asked.append(value)
        return None

    prints, point = Prints(), Point(1, Point(2, ()))
    first = fingerprint([point], count, prints)
    assert len(asked) == 2
    assert fingerprint([point], count, prints) == first == fingerprint([point])
    assert len(asked) == 2
    assert fingerprint([Point(1, Point(2, ()))], count, prints) == first


def test_a_value_that_can_be_changed_is_looked_at_again() -> None:
    prints, value = Prints(), Open(1)
    before = fingerprint(value, prints=prints)
    value.x = 2
    assert fingerprint(value, prints=prints) != before


def test_the_hash_of_what_nobody_asks_for_any_more_is_let_go() -> None:
    prints, kept, left = Prints(), Point(1, 1), Point(2, 2)
    fingerprint((kept, left), prints=prints)
    for _ in range(2):
        prints.next_round()
        fingerprint(kept, prints=prints)
    assert prints.get(kept)
    assert prints.get(left) is None


def test_what_cannot_be_told_is_refused() -> None:
    with pytest.raises(TypeError, match="object has no fingerprint"):
        fingerprint((1, object()))
