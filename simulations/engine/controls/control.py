"""Types and functions for all kinds of controls."""

from collections.abc import Callable, Mapping
from dataclasses import field
from functools import partial
from typing import Any

type Value = float | int | str | bool


class ControlError(ValueError):
    """An illegal value of a control. The message states the value and what is legal."""


def setting(default: Value, control: Callable[..., object], /, **details: object) -> Any:
    """The field of a dataclass of settings; ``control(name=…)``, with the details, makes its
    control."""
    return field(default=default, metadata={"control": partial(control, **details)})


def suggestion(given: object, legal: Mapping[str, object]) -> str:
    """``; did you mean 'x'?`` if a legal name is similar, else empty."""
    import difflib  # a large module, rarely needed

    near = difflib.get_close_matches(str(given), list(legal), n=1)
    return f"; did you mean {near[0]!r}?" if near else ""
