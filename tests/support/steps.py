"""The parts of a long test by name, so that a failure says in which it happened."""

from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def step(name: str) -> Iterator[None]:
    """A part of a test. What it raises has a note with its name."""
    try:
        yield
    except BaseException as failure:  # `pytest.fail` raises no Exception
        failure.add_note(f"in the step: {name}")
        raise
