"""``{illustration} name``: a drawing that our own models make while the book is built."""

from collections.abc import Callable
from dataclasses import dataclass

from simulations.engine.illustration import Illustration
from simulations.registry import found
from site_builder.cache.results import cached
from site_builder.diagnostics.diagnostic import cause
from site_builder.document.passage import Passage, Plain
from site_builder.markdown.bodies import CAPTION
from site_builder.markdown.directive import (
    LABEL,
    Argument,
    Directive,
    DirectiveCall,
    Numbered,
    OptionLine,
)
from site_builder.markdown.parse_context import ParseContext
from site_builder.sandbox.loading import imported
from site_builder.sandbox.pool import run_limited

MODULES = found("illustrations")


@dataclass(frozen=True, slots=True)
class Drawn:
    """An illustration with its caption."""

    illustration: Illustration
    description: str
    caption: Passage


def read_illustration(call: DirectiveCall, caption: Passage, context: ParseContext) -> Drawn | None:
    what = f"illustration {call.argument!r}"
    try:
        illustration = illustration_of(imported(MODULES[call.argument]).draw)
    except Exception as error:  # whatever its code may raise is the author's to see
        context.problem(call.line, f"{what} cannot be drawn: {cause(error)}", error)
        return None
    if not isinstance(illustration, Illustration):
        kind = type(illustration).__name__
        context.problem(call.line, f"{what}: draw returned {kind}; legal: an Illustration")
        return None
    if not caption:
        context.problem(call.line, f"{what} has no caption; legal: one to three sentences")
    return Drawn(illustration, call.text("alt") or illustration.description, caption)


@cached
def illustration_of(draw: Callable[[], Illustration]) -> Illustration:
    return run_limited(draw)


ILLUSTRATION = Directive(
    name="illustration",
    doc="a drawing made by the book's models",
    argument=Argument("name", "names no drawing", MODULES, "illustration"),
    options=(
        OptionLine("alt", doc="what it shows, instead of its own description"),
        LABEL,
    ),
    body=CAPTION,
    read=read_illustration,
    template="illustration",
    numbered=Numbered("Figure", lambda call: f"figure-{call.argument}", again=True),
    plain=lambda drawn: Plain((drawn.description, drawn.caption), "figure"),
)
