"""``{figure}``, a picture of the author's, and ``{illustration}``, a drawing by our models."""

from dataclasses import dataclass
from functools import partial
from importlib import import_module
from pathlib import PurePosixPath

from simulations.engine.illustration import Illustration
from simulations.registry import modules_in
from site_builder.cache.hashing import source_hash
from site_builder.cache.results import cached
from site_builder.diagnostics.blame import CodeError
from site_builder.diagnostics.diagnostic import cause
from site_builder.document.places import Passage, Plain
from site_builder.markdown.block_tree import CAPTION
from site_builder.markdown.content_files import PICTURES, Size, picture_size
from site_builder.markdown.directive import (
    LABEL,
    Argument,
    Body,
    Directive,
    DirectiveCall,
    Numbered,
    OptionLine,
)
from site_builder.markdown.parse_context import ParseContext
from site_builder.markdown.text.tokens import end_of_element
from site_builder.pool.processes import run_in_pool

WIDTH = r"([1-9]\d?|100)%|[1-9]\d{1,3}px"
ALIKE = 0.01
"""Largest difference between the proportions of a picture and its dark variant."""


@dataclass(frozen=True, slots=True, kw_only=True)
class PictureFile:
    file: str
    """Path below ``content/``."""
    alt: str
    """What it shows."""
    caption: Passage
    size: Size | None
    """So that the page reserves its space."""
    width: str
    """``60%`` or ``320px``; empty: its own."""
    dark: str
    """What is shown in its place on dark paper."""


def read_picture_file(call: DirectiveCall, caption: Passage, context: ParseContext) -> PictureFile:
    dark = call.text("dark")
    size = picture_size(context.content / call.argument)
    other = picture_size(context.content / dark) if dark else None
    if size and other and abs(size[0] * other[1] / (size[1] * other[0]) - 1) > ALIKE:
        shapes = "{} × {} for a picture of {} × {}".format(*other, *size)
        context.problem(call.line_of("dark"), f"dark variant of {shapes}; legal: its shape")
    return PictureFile(
        file=call.argument,
        alt=call.text("alt"),
        caption=caption,
        size=size,
        width=call.text("width"),
        dark=dark,
    )


FIGURE = Directive(
    name="figure",
    doc="a picture of yours, scaled down to what screens can show of it",
    argument=Argument("images/file.svg", lacks="names no picture", file=PICTURES),
    options=(
        OptionLine(name="alt", doc="what the picture shows", required=True),
        OptionLine(name="width", doc="how wide it is shown, `60%` or `320px`", form=WIDTH),
        OptionLine(name="dark", doc="a picture for dark paper, `images/dark.svg`", file=PICTURES),
        LABEL,
    ),
    body=CAPTION,
    read=read_picture_file,
    template="figure",
    numbered=Numbered(
        "Figure",
        lambda call: f"figure-{'-'.join(PurePosixPath(call.argument).stem.split())}",
        again=True,
    ),
    plain=lambda shown: Plain((shown.alt, shown.caption), "figure"),
)


MODULES = modules_in("illustrations")


@dataclass(frozen=True, slots=True)
class DrawnIllustration:
    illustration: Illustration
    description: str
    caption: Passage
    sentences: Passage
    """A list of one item for each step; nothing for a drawing that appears at once."""

    @property
    def steps(self) -> tuple[Passage, ...]:
        """The items of the list."""
        tokens = self.sentences.tokens
        starts = [at for at, token in enumerate(tokens) if token.type == "list_item_open"]
        return tuple(Passage(tokens[at + 1 : end_of_element(tokens, at) - 1]) for at in starts)


def read_illustration(
    call: DirectiveCall, words: Passage, context: ParseContext
) -> DrawnIllustration:
    what = f"illustration {call.argument!r}"
    try:
        module = MODULES[call.argument]
        illustration = illustration_of(module, source_hash(module))
    except Exception as error:  # whatever its code may raise is the author's to see
        raise CodeError(f"{what} cannot be drawn: {cause(error)}") from error
    kinds = [token.type for token in words.tokens]
    end = kinds.index("ordered_list_open") if "ordered_list_open" in kinds else len(kinds)
    caption, sentences = Passage(words.tokens[:end]), Passage(words.tokens[end:])
    if not caption:
        context.problem(call.line, f"{what} has no caption; legal: one to three sentences")
    description = call.text("alt") or illustration.description
    drawn = DrawnIllustration(illustration, description, caption, sentences)
    if max(1, len(drawn.steps)) != illustration.steps:
        counts = f"{illustration.steps} steps and a numbered list of {len(drawn.steps)}"
        context.problem(call.line, f"{what} has {counts}; legal: a sentence for each step")
    return drawn


@cached
def illustration_of(module: str, _sources: bytes) -> Illustration:
    return run_in_pool(partial(_drawn, module), of=module)


def _drawn(module: str) -> Illustration:
    drawn = import_module(module).draw()
    if not isinstance(drawn, Illustration):
        raise TypeError(f"draw returned {type(drawn).__name__}; legal: an Illustration")
    return drawn


ILLUSTRATION = Directive(
    name="illustration",
    doc="a drawing made by the book's models",
    argument=Argument("name", "names no drawing", MODULES, "illustration"),
    options=(OptionLine(name="alt", doc="what it shows, instead of its own description"), LABEL),
    body=Body("a caption; for a drawing in steps, a numbered list of sentences", CAPTION.read),
    read=read_illustration,
    template="illustration",
    numbered=Numbered("Figure", lambda call: f"figure-{call.argument}", again=True),
    plain=lambda drawn: Plain((drawn.description, drawn.caption, drawn.sentences), "figure"),
)
