"""What Python's own exceptions mean, in the words of the other messages: what is there, what is
not, and what may have been meant.

Only those whose own words presume that one knows the traceback: a `KeyError` says nothing but the
key. What a library or an author's code raises with words of its own keeps them.
"""

import difflib
import re
import sys
from collections.abc import Iterable
from types import ModuleType

UNBOUND = r"^cannot access local variable ('\w+') .*$"
REMEMBERED = "words_of_the_book"


def remember_words[E: BaseException](error: E, words: str) -> E:
    """The error, which between processes loses the traceback that its words come from."""
    setattr(error, REMEMBERED, words)
    return error


def words_of(error: BaseException) -> str:
    """What is wrong, without the exception's name; nothing where it has no words."""
    remembered = getattr(error, REMEMBERED, None)
    if remembered is not None:
        return str(remembered)
    if isinstance(error, SyntaxError):
        return error.msg
    if type(error).__module__ != "builtins":
        return str(error)
    return _in_words(error) or str(error)


def _in_words(error: BaseException) -> str:
    """Of Python's own exceptions; nothing where it says it well itself."""
    match error:
        case KeyError(args=(str(words),)) if " " in words:
            return words  # an author's own: Python would put them between quotation marks
        case KeyError(args=(key,)):
            return f"there is no {key!r}"
        case AttributeError(name=str(name), obj=owner) if owner is not None:
            kind = owner if isinstance(owner, ModuleType | type) else type(owner)
            return f"{kind.__name__} has no {name!r}{_meant(name, dir(owner))}"
        case UnboundLocalError():
            return re.sub(UNBOUND, r"\1 is used before it is given a value", str(error))
        case NameError(name=str(name)):
            return f"nothing is called {name!r}{_meant(name, _names_at(error))}"
        case ModuleNotFoundError(name=str(name)):
            return f"there is no module {name!r}"
        case ImportError(name=str(module), name_from=str(name)):
            return f"{module} has no {name!r}{_meant(name, _names_in(module))}"
        case FileNotFoundError(filename=str(file)):
            return f"there is no file {file!r}"
        case RecursionError():
            return "a function calls itself without end"
        case AssertionError(args=()):
            return "what is asserted does not hold"
        case _:
            return ""


def _meant(name: str, known: Iterable[str]) -> str:
    near = difflib.get_close_matches(name, sorted(known), n=1)
    return f"; did you mean {near[0]!r}?" if near else ""


def _names_at(error: BaseException) -> set[str]:
    """All names in sight of the innermost line."""
    place = error.__traceback__
    while place and place.tb_next:
        place = place.tb_next
    return {*place.tb_frame.f_locals, *place.tb_frame.f_globals} if place else set()


def _names_in(module: str) -> list[str]:
    return dir(sys.modules[module]) if module in sys.modules else []
