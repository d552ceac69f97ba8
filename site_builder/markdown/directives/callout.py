"""``{note}``, ``{tip}``, ``{warning}`` and their kin: asides, with a title."""

from collections.abc import Sequence
from dataclasses import dataclass

from site_builder.markdown.bodies import BLOCKS
from site_builder.markdown.directive import Argument, Directive, DirectiveCall, OptionLine
from site_builder.markdown.inline import inline_passage
from site_builder.markdown.parse_context import ParseContext
from site_builder.page_model.blocks import Block
from site_builder.page_model.passage import Passage, Plain


@dataclass(frozen=True, slots=True)
class Kind:
    """One name that an aside may have; where the author gives no title, the language does."""

    look: str
    """Its class in the style sheet: several kinds look alike."""
    doc: str


KINDS = {
    "tip": Kind("tip", "an aside that helps"),
    "hint": Kind("tip", "an aside that helps"),
    "note": Kind("note", "an aside that adds"),
    "seealso": Kind("note", "an aside that leads on"),
    "important": Kind("important", "an aside not to be missed"),
    "attention": Kind("warning", "an aside that warns"),
    "caution": Kind("warning", "an aside that warns"),
    "warning": Kind("warning", "an aside that warns"),
    "danger": Kind("danger", "an aside that warns of harm"),
    "error": Kind("danger", "an aside on what goes wrong"),
    "key-idea": Kind("key-idea", "what to remember"),
}
"""Kinds of callout: those of MyST, and ours."""
LOOKS = tuple(dict.fromkeys(["note", *(kind.look for kind in KINDS.values())]))
"""Ways to look; the first where the author says none."""


@dataclass(frozen=True, slots=True)
class Callout:
    """An aside; what it says is in the blocks inside."""

    kind: str
    """Its class."""
    title: Passage


def read_callout(call: DirectiveCall, _body: Sequence[Block], context: ParseContext) -> Callout:
    title = call.argument or context.words(f"callout.{call.name}")
    return Callout(KINDS[call.name].look, inline_passage(title, call.line, context))


def read_admonition(call: DirectiveCall, _body: Sequence[Block], context: ParseContext) -> Callout:
    return Callout(call.text("class"), inline_passage(call.argument, call.line, context))


CALLOUTS = (
    *(
        Directive(
            name=name,
            doc=kind.doc,
            argument=Argument("Title"),
            body=BLOCKS,
            read=read_callout,
            template="callout",
            plain=lambda _callout: Plain(),
        )
        for name, kind in KINDS.items()
    ),
    Directive(
        name="admonition",
        doc="an aside of another kind",
        argument=Argument("Title", lacks="has no title"),
        options=(OptionLine("class", doc="what it looks like", expected=LOOKS),),
        body=BLOCKS,
        read=read_admonition,
        template="callout",
        plain=lambda _callout: Plain(),
    ),
)
