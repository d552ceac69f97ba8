"""``{video} clips/file.mp4``: a film from ``content/``, with a still, captions and controls."""

from dataclasses import dataclass
from pathlib import Path, PurePosixPath

from site_builder.markdown.bodies import CAPTION
from site_builder.markdown.directive import (
    LABEL,
    Argument,
    Directive,
    DirectiveCall,
    Numbered,
    OptionLine,
    OptionValue,
)
from site_builder.markdown.files.content_files import PICTURES, Size, found, picture_size
from site_builder.markdown.parse_context import ParseContext
from site_builder.page_model.passage import Passage, Plain

KINDS = {".mp4": "video/mp4", ".webm": "video/webm"}
SILENT = "none"
"""In place of captions, for a film without words."""


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
    """Of the still, so that its room is kept before it is there."""
    captions: str
    """Nothing for a film without words."""
    language: str
    caption: Passage


def read_video(call: DirectiveCall, caption: Passage, context: ParseContext) -> Video | None:
    file = found(call.argument, call.line, context, "film", tuple(KINDS))
    poster = _file(call.options.get("poster"), context, "picture file", PICTURES)
    captions = call.options.get("captions")
    words = None
    if captions and captions.text and captions.text != SILENT:
        words = _file(captions, context, "captions", (".vtt",))
    if file is None:
        return None
    if not _is_film(file):
        expected = f"a whole {file.suffix} file"
        context.problem(call.line, f"film {call.argument!r} is none inside; legal: {expected}")
    if captions and words and not _are_captions(words):
        expected = "WebVTT, whose first line is 'WEBVTT'"
        context.problem(captions.line, f"captions {captions.text!r}; legal: {expected}")
    context.files.update(
        path for path in (call.argument, captions.text if words and captions else "") if path
    )
    return Video(
        file=call.argument,
        kind=KINDS[file.suffix],
        alt=call.text("alt"),
        poster=call.text("poster"),
        size=picture_size(poster) if poster else None,
        captions=captions.text if words and captions else "",
        language=call.text("language") or context.shared.words.language,
        caption=caption,
    )


def _file(
    given: OptionValue | None, context: ParseContext, kind: str, suffixes: tuple[str, ...]
) -> Path | None:
    """None where nothing is given too, which is reported of required options already."""
    if given is None or not given.text:
        return None
    return found(given.text, given.line, context, kind, suffixes)


def _is_film(file: Path) -> bool:
    """By the mark at the beginning of its kind."""
    with file.open("rb") as data:
        head = data.read(12)
    return head[4:8] == b"ftyp" if file.suffix == ".mp4" else head[:4] == b"\x1a\x45\xdf\xa3"


def _are_captions(file: Path) -> bool:
    with file.open("rb") as data:
        return data.read(9).removeprefix(b"\xef\xbb\xbf").startswith(b"WEBVTT")


VIDEO = Directive(
    name="video",
    doc="a film of yours",
    argument=Argument("clips/file.mp4", lacks="names no film"),
    options=(
        OptionLine("alt", doc="what the film shows", required=True),
        OptionLine("poster", doc="the picture before it starts, and on paper", required=True),
        OptionLine("captions", doc="what is said, `clips/file.vtt`, or `none`", required=True),
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
