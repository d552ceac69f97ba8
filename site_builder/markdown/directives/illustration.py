"""``{illustration} name``: a drawing that our own models make while the book is built."""

from collections.abc import Callable
from dataclasses import dataclass
from importlib import import_module

from simulations.engine.illustration import Illustration
from simulations.registry import found
from site_builder.diagnostics import cause
from site_builder.drawing.apart import apart
from site_builder.kept.keeper import kept, reads_code
from site_builder.markdown.bodies import CAPTION
from site_builder.markdown.directive import LABEL, Argument, Directive, Numbered, OptionLine, Use
from site_builder.markdown.reading import Reading

MODULES = found("illustrations")
ROOM = "simulations/illustrations/"


@dataclass(frozen=True, slots=True)
class Drawn:
    """An illustration with its caption."""

    illustration: Illustration
    description: str
    caption_html: str


def read_illustration(use: Use, caption_html: str, reading: Reading) -> Drawn | None:
    if not MODULES:
        reading.problem(use.line, f"the book has no illustrations; legal: one in {ROOM}")
        return None
    try:
        illustration = _drawn(import_module(MODULES[use.argument]).draw)
    except Exception as error:  # whatever its code may raise is the author's to see
        message = f"illustration {use.argument!r} cannot be drawn: {cause(error)}"
        reading.problem(use.line, message)
        return None
    if not isinstance(illustration, Illustration):
        kind = type(illustration).__name__
        message = f"illustration {use.argument!r}: draw returned {kind}; legal: an Illustration"
        reading.problem(use.line, message)
        return None
    if not caption_html:
        legal = "one to three sentences"
        reading.problem(use.line, f"illustration {use.argument!r} has no caption; legal: {legal}")
    words = use.text("alt") or illustration.description
    return Drawn(illustration, words, caption_html)


def _drawn(draw: Callable[[], Illustration]) -> Illustration:
    reads_code(draw)
    return illustration_of(draw)


@kept
def illustration_of(draw: Callable[[], Illustration]) -> Illustration:
    return apart(draw)


ILLUSTRATION = Directive(
    name="illustration",
    says="a drawing made by the book's models",
    argument=Argument("name", "names no drawing", MODULES, "illustration"),
    options=(
        OptionLine("alt", says="what it shows, instead of its own description"),
        LABEL,
    ),
    body=CAPTION,
    read=read_illustration,
    template="illustration",
    numbered=Numbered("Figure", lambda use: f"figure-{use.argument}", again=True),
)
