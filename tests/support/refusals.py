"""Tables of what functions refuse: a part of the message, the call, and its illegal values."""

from collections.abc import Callable, Iterable
from typing import Any

import pytest

type Call = Callable[[Any], object]


def each_of(*rows: tuple[str, Call, Iterable[Any]]) -> pytest.MarkDecorator:
    """Parametrises a test by every illegal value of every row."""
    cases = [(message, call, value) for message, call, values in rows for value in values]
    return pytest.mark.parametrize(("message", "call", "value"), cases)


def assert_refused(message: str, call: Call, value: Any) -> None:
    with pytest.raises(ValueError, match=message):
        call(value)
