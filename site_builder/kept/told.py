"""Keeping what a reader of sources finds, with what it has to tell about them."""

from collections.abc import Callable

from site_builder.diagnostics import Diagnostics
from site_builder.kept.keeper import kept_as, reads_unknown


def kept_reading[T](
    name: str, given: object, problems: Diagnostics, read: Callable[[Diagnostics], T]
) -> tuple[T, bytes]:
    """What ``read`` finds, and the hash of all that it was made from, as `kept_as` gives it. What
    it tells goes to ``problems``; with mistakes nothing is kept, since what would be legal may
    depend on anything."""

    def make() -> tuple[T, Diagnostics]:
        own = Diagnostics()
        value = read(own)
        if own:
            reads_unknown()
        return value, own

    (value, own), made_from = kept_as(name, given, make, str(read.__module__))
    problems.found.extend(own.found)
    problems.doubts.extend(own.doubts)
    return value, made_from
