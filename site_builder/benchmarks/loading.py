"""Scenes and ladders by their ids; why one cannot be had is told in one sentence."""

from collections.abc import Callable

from simulations.registry import UnknownIdError
from site_builder.diagnostics import cause
from site_builder.drawing.apart import in_time
from site_builder.kept.keeper import reads_code


def loaded[T](kind: str, item_id: str, load: Callable[[str], T], error: type[Exception]) -> T:
    """What ``load`` makes of the id; an id that is not known, and whatever a scene's or ladder's
    own code may raise, is an ``error``. ``kind``: ``simulation`` or ``ladder``."""
    try:
        with in_time():
            found = load(item_id)
    except UnknownIdError as unknown:
        raise error(str(unknown)) from unknown
    except Exception as failure:
        raise error(f"{kind} {item_id!r} cannot be loaded: {cause(failure)}") from failure
    reads_code(found)
    return found
