"""The functions that ``calc`` blocks import, as expressions of a page call them."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from typing import Any

from site_builder.cache.results import cached
from site_builder.sandbox.pool import run_limited


@dataclass(frozen=True, slots=True)
class ModelFunction:
    """A function of the author's, called in the sandbox: one that never ends, fills the memory or
    opens a file is a mistake at the line of the expression."""

    function: Callable[..., Any]

    def __call__(self, *given: object, **named: object) -> Any:
        """Raises whatever the function does, and `LimitError`."""
        return _called(self.function, given, named)


@cached
def _called(
    function: Callable[..., Any], given: tuple[object, ...], named: Mapping[str, object]
) -> Any:
    return run_limited(partial(function, *given, **named))
