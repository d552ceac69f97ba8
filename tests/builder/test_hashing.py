"""Hashes of what results depend on."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest

from site_builder.cache.hashing import UnhashableError, hash_of, source_hash


@dataclass(frozen=True)
class Point:
    x: float
    y: float


VALUES = [
    None, True, 1, 1.0, "1", b"1", Path("1"), (), ("",), ("", ""), ("ab",), ("a", "b"),
    (("a",), "b"), {}, {"a": 1}, {"a": 1, "b": 2}, frozenset("ab"),
    np.zeros(2), np.zeros((2, 1)), np.ones(2), Point(1, 2), Point(2, 1), float("nan"),
]  # fmt: skip


def test_different_values_have_different_hashes() -> None:
    assert len({hash_of(value) for value in VALUES}) == len(VALUES)


def test_equal_values_have_equal_hashes() -> None:
    assert hash_of(Point(1, 2), {"a": [1]}) == hash_of(Point(1, 2), {"a": [1]})
    assert hash_of(frozenset("abcdef")) == hash_of(frozenset("fedcba"))


def test_a_function_with_a_closure_has_no_hash() -> None:
    def make(number: int) -> Callable[[], int]:
        return lambda: number

    with pytest.raises(UnhashableError):
        hash_of(make(1))


def test_sources_include_what_is_imported_however_indirectly() -> None:
    names = ("frame", "scene", "controls")
    assert len({source_hash(f"simulations.engine.{name}") for name in names}) == len(names)
