"""``{figure} images/file.svg``: a picture from ``content/``, with ``:alt:`` and a caption."""

import re
from dataclasses import dataclass
from pathlib import PurePosixPath

from site_builder.markdown.bodies import CAPTION
from site_builder.markdown.directive import (
    LABEL,
    Argument,
    Directive,
    DirectiveCall,
    Numbered,
    OptionLine,
)
from site_builder.markdown.files.content_files import PICTURES, Size, found, picture_size
from site_builder.markdown.parse_context import ParseContext
from site_builder.page_model.passage import Passage, Plain

SUFFIXES = PICTURES
WIDTH = re.compile(r"([1-9]\d?|100)%|([1-9]\d{1,3})px")
LEGAL_WIDTH = "'60%' of the text, or '320px'"
ALIKE = 0.01
"""Of the proportions of a picture and its dark variant, by how much they may differ."""


@dataclass(frozen=True, slots=True)
class Figure:
    """A picture file with a caption."""

    file: str
    """Path below ``content/``."""
    alt: str
    caption: Passage
    size: Size | None
    """Its own, so that its room is kept before it is there."""
    width: str = ""
    """How wide it is shown, where its author says it: ``60%`` or ``320px``."""
    dark: str = ""
    """Path of what is shown in its place on dark paper."""


def read_figure(call: DirectiveCall, caption: Passage, context: ParseContext) -> Figure | None:
    file = found(call.argument, call.line, context, "picture file", PICTURES)
    size = picture_size(file) if file else None
    dark, width = _dark(call, size, context), _width(call, context)
    if file is None:
        return None
    return Figure(call.argument, call.text("alt"), caption, size, width, dark)


def _width(call: DirectiveCall, context: ParseContext) -> str:
    given = call.options.get("width")
    if given is None or WIDTH.fullmatch(given.text):
        return given.text if given else ""
    context.problem(given.line, f"width {given.text!r}; legal: {LEGAL_WIDTH}")
    return ""


def _dark(call: DirectiveCall, size: Size | None, context: ParseContext) -> str:
    given = call.options.get("dark")
    if given is None:
        return ""
    file = found(given.text, given.line, context, "picture file", PICTURES)
    other = picture_size(file) if file else None
    if size and other and abs(size[0] * other[1] / (size[1] * other[0]) - 1) > ALIKE:
        each = [f"{width} × {height}" for width, height in (size, other)]
        context.problem(
            given.line, f"dark variant of {each[1]} for a picture of {each[0]}; legal: its shape"
        )
    return given.text if file else ""


FIGURE = Directive(
    name="figure",
    doc="a picture of yours",
    argument=Argument("images/file.svg", lacks="names no picture"),
    options=(
        OptionLine("alt", doc="what the picture shows", required=True),
        OptionLine("width", doc="how wide it is shown, `60%` or `320px`"),
        OptionLine("dark", doc="a picture for dark paper, `images/dark.svg`"),
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
