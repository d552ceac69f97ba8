"""Equal values have equal fingerprints; values that differ in anything that counts do not."""

import functools
import itertools
import subprocess
import sys
from dataclasses import dataclass

import numpy as np
import pytest
from markupsafe import Markup

from site_builder.kept.fingerprint import fingerprint


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


def test_what_cannot_be_told_is_refused() -> None:
    with pytest.raises(TypeError, match="object has no fingerprint"):
        fingerprint((1, object()))
