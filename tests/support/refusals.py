"""Tables of what functions refuse: a part of the message, the call, and its illegal values."""

from collections.abc import Callable, Iterable
from typing import Any

import pytest

type Call = Callable[[Any], object]


def each_of(*rows: tuple[str, Call, Iterable[Any]]) -> pytest.MarkDecorator:
    """Parametrises a test by the rows."""
    return pytest.mark.parametrize(("message", "call", "values"), rows)


def assert_refused(message: str, call: Call, values: Iterable[Any]) -> None:
    """Every one of the values."""
    for value in values:
        try:
            with pytest.raises(ValueError, match=message):
                call(value)
        except (AssertionError, pytest.fail.Exception) as failure:
            failure.add_note(f"of the value {value!r}")
            raise
