"""``{video} clips/file.mp4``: a film from ``content/``, with a still, captions and controls."""

from dataclasses import dataclass
from pathlib import Path, PurePosixPath

from site_builder.markdown.bodies import CAPTION
from site_builder.markdown.directive import (
    LABEL,
    Argument,
    Directive,
    Numbered,
    OptionLine,
    OptionValue,
    Use,
)
from site_builder.markdown.files.content_files import PICTURES, Size, found, picture_size
from site_builder.markdown.reading import Reading

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
    caption_html: str


def read_video(use: Use, caption_html: str, reading: Reading) -> Video | None:
    file = found(use.argument, use.line, reading, "film", tuple(KINDS))
    poster = _file(use.options.get("poster"), reading, "picture file", PICTURES)
    captions = use.options.get("captions")
    words = None
    if captions and captions.text and captions.text != SILENT:
        words = _file(captions, reading, "captions", (".vtt",))
    if file is None:
        return None
    if not _is_film(file):
        legal = f"a whole {file.suffix} file"
        reading.problem(use.line, f"film {use.argument!r} is none inside; legal: {legal}")
    if captions and words and not _are_captions(words):
        legal = "WebVTT, whose first line is 'WEBVTT'"
        reading.problem(captions.line, f"captions {captions.text!r}; legal: {legal}")
    reading.files.update(
        path for path in (use.argument, captions.text if words and captions else "") if path
    )
    return Video(
        file=use.argument,
        kind=KINDS[file.suffix],
        alt=use.text("alt"),
        poster=use.text("poster"),
        size=picture_size(poster) if poster else None,
        captions=captions.text if words and captions else "",
        language=use.text("language") or reading.words.language,
        caption_html=caption_html,
    )


def _file(
    given: OptionValue | None, reading: Reading, kind: str, suffixes: tuple[str, ...]
) -> Path | None:
    """None where nothing is given too, which is reported of required options already."""
    if given is None or not given.text:
        return None
    return found(given.text, given.line, reading, kind, suffixes)


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
    says="a film of yours",
    argument=Argument("clips/file.mp4", lacks="names no film"),
    options=(
        OptionLine("alt", says="what the film shows", required=True),
        OptionLine("poster", says="the picture before it starts, and on paper", required=True),
        OptionLine("captions", says="what is said, `clips/file.vtt`, or `none`", required=True),
        OptionLine("language", says="of the captions, `de`; the book's where you say none"),
        LABEL,
    ),
    body=CAPTION,
    read=read_video,
    template="video",
    numbered=Numbered(
        "Figure", lambda use: f"figure-{PurePosixPath(use.argument).stem}", again=True
    ),
)
