"""``{audio} sounds/file.mp3``: a recording from ``content/``, with what is heard in it in words."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import PurePosixPath

from markdown_it.token import Token

from site_builder.document.passage import Passage, Plain, passage
from site_builder.markdown.bodies import plain_tokens
from site_builder.markdown.directive import (
    LABEL,
    Argument,
    Body,
    Directive,
    DirectiveCall,
    FileKind,
    Numbered,
    OptionLine,
)
from site_builder.markdown.parse_context import ParseContext

KINDS = {".mp3": "audio/mpeg", ".m4a": "audio/mp4", ".ogg": "audio/ogg", ".wav": "audio/wav"}


@dataclass(frozen=True, slots=True)
class Audio:
    """A recording that the reader starts."""

    file: str
    """Path below ``content/``."""
    kind: str
    """Media type."""
    title: str
    licence: str
    """Under which terms it is here, and whose it is; nothing where it is the book's own."""
    transcript: Passage


def read_transcript(call: DirectiveCall, tokens: Sequence[Token], context: ParseContext) -> Passage:
    if not tokens:
        context.problem(call.line, "{audio} without a transcript; legal: in words what is heard")
    return passage(plain_tokens(call, tokens, context))


def read_audio(call: DirectiveCall, transcript: Passage, context: ParseContext) -> Audio:
    context.files.update(filter(None, [call.argument]))
    kind = KINDS[PurePosixPath(call.argument).suffix]
    return Audio(call.argument, kind, call.text("title"), call.text("licence"), transcript)


AUDIO = Directive(
    name="audio",
    doc="a recording of yours",
    argument=Argument(
        "sounds/file.mp3", lacks="names no recording", file=FileKind("recording", tuple(KINDS))
    ),
    options=(
        OptionLine("title", doc="what it is called", required=True),
        OptionLine("licence", doc="whose it is and under which terms, `Ada Lovelace, CC BY 4.0`"),
        LABEL,
    ),
    body=Body("what is heard, in words", read_transcript),
    read=read_audio,
    template="audio",
    numbered=Numbered(
        "Figure", lambda call: f"figure-{PurePosixPath(call.argument).stem}", again=True
    ),
    plain=lambda audio: Plain((audio.title, audio.transcript), "figure"),
)
