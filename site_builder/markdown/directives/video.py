"""``{video} clips/file.mp4``: a film from ``content/``, with a still, captions and controls."""

from dataclasses import dataclass
from pathlib import PurePosixPath

from site_builder.document.passage import Passage, Plain
from site_builder.markdown.bodies import CAPTION
from site_builder.markdown.directive import (
    LABEL,
    Argument,
    Directive,
    DirectiveCall,
    FileKind,
    Numbered,
    OptionLine,
)
from site_builder.markdown.files.content_files import PICTURES, Size, picture_size
from site_builder.markdown.parse_context import ParseContext

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
    """Of the still, so that the page reserves its space."""
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
