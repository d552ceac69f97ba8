"""What a worker does between two builds, while nobody waits."""

import gc
import weakref
from collections.abc import Iterator

import pytest

from site_builder.serving.bench import _set_apart


@pytest.fixture(autouse=True)
def _mixed_again() -> Iterator[None]:
    yield
    gc.unfreeze()


class Thing:
    """Something that can be part of a circle."""

    itself: "Thing"


def test_what_is_in_memory_is_set_apart_from_the_garbage_of_the_next_build() -> None:
    before = gc.get_freeze_count()
    _set_apart()
    assert gc.get_freeze_count() > before


def test_what_was_set_apart_and_is_of_no_use_any_more_is_let_go_of() -> None:
    thing = Thing()
    thing.itself = thing
    watched = weakref.ref(thing)
    _set_apart()
    del thing
    assert watched() is not None
    _set_apart()
    assert watched() is None
