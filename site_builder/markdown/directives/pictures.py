"""``{figure}``, a picture from ``content/``, and ``{illustration}``, a drawing by our models."""

from dataclasses import dataclass
from functools import partial
from pathlib import PurePosixPath

from simulations.engine.illustration import Illustration
from simulations.registry import found
from site_builder.cache.results import cached
from site_builder.diagnostics.diagnostic import cause
from site_builder.document.passage import Passage, Plain
from site_builder.markdown.bodies import CAPTION
from site_builder.markdown.content_files import PICTURES, Size, picture_size
from site_builder.markdown.directive import (
    LABEL,
    Argument,
    Directive,
    DirectiveCall,
    Numbered,
    OptionLine,
)
from site_builder.markdown.parse_context import ParseContext
from site_builder.sandbox.data import Code, called
from site_builder.sandbox.pool import run_limited

WIDTH = r"([1-9]\d?|100)%|[1-9]\d{1,3}px"
ALIKE = 0.01
"""Largest difference between the proportions of a picture and its dark variant."""


@dataclass(frozen=True, slots=True)
class Figure:
    """A picture file with a caption."""

    file: str
    """Path below ``content/``."""
    alt: str
    caption: Passage
    size: Size | None
    """Its own, so that the page reserves its space."""
    width: str = ""
    """``60%`` or ``320px``; empty: its own."""
    dark: str = ""
    """Path of what is shown in its place on dark paper."""


def read_figure(call: DirectiveCall, caption: Passage, context: ParseContext) -> Figure:
    size, dark = picture_size(context.content / call.argument), call.text("dark")
    other = picture_size(context.content / dark) if dark else None
    if size and other and abs(size[0] * other[1] / (size[1] * other[0]) - 1) > ALIKE:
        shapes = "{} × {} for a picture of {} × {}".format(*other, *size)
        context.problem(call.line_of("dark"), f"dark variant of {shapes}; legal: its shape")
    return Figure(call.argument, call.text("alt"), caption, size, call.text("width"), dark)


FIGURE = Directive(
    name="figure",
    doc="a picture of yours",
    argument=Argument("images/file.svg", lacks="names no picture", file=PICTURES),
    options=(
        OptionLine("alt", doc="what the picture shows", required=True),
        OptionLine("width", doc="how wide it is shown, `60%` or `320px`", form=WIDTH),
        OptionLine("dark", doc="a picture for dark paper, `images/dark.svg`", file=PICTURES),
        LABEL,
    ),
    body=CAPTION,
    read=read_figure,
    template="figure",
    numbered=Numbered(
        "Figure", lambda call: f"figure-{PurePosixPath(call.argument).stem}", again=True
    ),
    plain=lambda figure: Plain((figure.alt, figure.caption), "figure"),
)


MODULES = found("illustrations")


@dataclass(frozen=True, slots=True)
class DrawnIllustration:
    """An illustration with its caption."""

    illustration: Illustration
    description: str
    caption: Passage


def read_illustration(
    call: DirectiveCall, caption: Passage, context: ParseContext
) -> DrawnIllustration | None:
    what = f"illustration {call.argument!r}"
    try:
        illustration = illustration_of(Code(MODULES[call.argument], "draw"))
    except Exception as error:  # whatever its code may raise is the author's to see
        context.problem(call.line, f"{what} cannot be drawn: {cause(error)}", error)
        return None
    if not isinstance(illustration, Illustration):
        kind = type(illustration).__name__
        context.problem(call.line, f"{what}: draw returned {kind}; legal: an Illustration")
        return None
    if not caption:
        context.problem(call.line, f"{what} has no caption; legal: one to three sentences")
    return DrawnIllustration(illustration, call.text("alt") or illustration.description, caption)


@cached
def illustration_of(draw: Code) -> Illustration:
    return run_limited(partial(called, draw))  # type: ignore[no-any-return]


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
