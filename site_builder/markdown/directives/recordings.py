"""``{audio}`` and ``{video}``: recordings and films from ``content/``."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import PurePosixPath

from markdown_it.token import Token

from site_builder.document.passage import Passage, Plain, passage
from site_builder.markdown.bodies import CAPTION, plain_tokens
from site_builder.markdown.content_files import PICTURES, Size, picture_size
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

SOUND_KINDS = {".mp3": "audio/mpeg", ".m4a": "audio/mp4", ".ogg": "audio/ogg", ".wav": "audio/wav"}


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
    kind = SOUND_KINDS[PurePosixPath(call.argument).suffix]
    return Audio(call.argument, kind, call.text("title"), call.text("licence"), transcript)


AUDIO = Directive(
    name="audio",
    doc="a recording of yours",
    argument=Argument(
        "sounds/file.mp3",
        lacks="names no recording",
        file=FileKind("recording", tuple(SOUND_KINDS)),
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


CAPTIONS = FileKind("captions", (".vtt",))
KINDS = {".mp4": "video/mp4", ".webm": "video/webm"}


@dataclass(frozen=True, slots=True)
class Video:
    """A film that the reader starts."""

    file: str
    """Path below ``content/``, like those of still and captions."""
    kind: str
    """Media type."""
    alt: str
    poster: str
    size: Size | None
    """Size of the still, so that the page reserves its space."""
    captions: str
    """Nothing for a film without words."""
    language: str
    caption: Passage


def read_video(call: DirectiveCall, caption: Passage, context: ParseContext) -> Video:
    poster, captions = call.text("poster"), call.text("captions")
    context.files.update(path for path in (call.argument, captions) if path)
    return Video(
        file=call.argument,
        kind=KINDS[PurePosixPath(call.argument).suffix],
        alt=call.text("alt"),
        poster=poster,
        size=picture_size(context.content / poster) if poster else None,
        captions=captions,
        language=call.text("language") or context.shared.words.language,
        caption=caption,
    )


VIDEO = Directive(
    name="video",
    doc="a film of yours",
    argument=Argument("clips/file.mp4", lacks="names no film", file=FileKind("film", tuple(KINDS))),
    options=(
        OptionLine("alt", doc="what the film shows", required=True),
        OptionLine(
            "poster", doc="the picture before it starts, and on paper", required=True, file=PICTURES
        ),
        OptionLine("captions", doc="what is said in it, `clips/file.vtt`", file=CAPTIONS),
        OptionLine("language", doc="of the captions, `de`; the book's where you say none"),
        LABEL,
    ),
    body=CAPTION,
    read=read_video,
    template="video",
    numbered=Numbered(
        "Figure", lambda call: f"figure-{PurePosixPath(call.argument).stem}", again=True
    ),
    plain=lambda video: Plain((video.alt, video.caption), "figure"),
)
