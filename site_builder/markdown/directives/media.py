"""Files of ``content/``: ``{figure}``, a picture, ``{audio}``, ``{video}`` and ``{download}``; and
``{illustration}``, a drawing by our models, and ``{data-sheet}``, the results of instruments."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from importlib import import_module
from pathlib import Path, PurePosixPath

from markdown_it.token import Token

from simulations.engine.illustration import Illustration
from simulations.registry import found
from site_builder.cache.hashing import source_hash
from site_builder.cache.results import cached
from site_builder.diagnostics.blame import CodeError
from site_builder.diagnostics.diagnostic import cause
from site_builder.document.blocks import Prose
from site_builder.document.places import Passage, Plain, passage
from site_builder.languages.words import ENGLISH, Words
from site_builder.markdown.blocks import CAPTION, plain_tokens
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
from site_builder.markdown.text.tokens import end_of_element
from site_builder.pool.processes import run_in_pool

WIDTH = r"([1-9]\d?|100)%|[1-9]\d{1,3}px"
ALIKE = 0.01
"""Largest difference between the proportions of a picture and its dark variant."""
SOUND_KINDS = {".mp3": "audio/mpeg", ".m4a": "audio/mp4", ".ogg": "audio/ogg", ".wav": "audio/wav"}
FILM_KINDS = {".mp4": "video/mp4", ".webm": "video/webm"}


@dataclass(frozen=True, slots=True)
class Media:
    """A picture, or a recording or film that the reader starts."""

    file: str
    """Path below ``content/``, like those of the other files."""
    alt: str
    """What it shows, or what it is called."""
    caption: Passage
    """What is heard in a recording, in words."""
    kind: str
    """Media type of what is played."""
    size: Size | None
    """Size of a picture or of a film's still, so that the page reserves its space."""
    width: str
    """``60%`` or ``320px``; empty: its own."""
    dark: str
    """What is shown in its place on dark paper."""
    poster: str
    captions: str
    """Nothing for a film without words."""
    language: str
    licence: str
    """Under which terms it is here, and whose it is; nothing where it is the book's own."""


GIVEN = ("width", "dark", "poster", "captions", "language", "licence")


def read_media(call: DirectiveCall, caption: Passage, context: ParseContext) -> Media:
    given = {name: call.text(name) for name in GIVEN}
    given["language"] = given["language"] or context.shared.words.language
    kind = (SOUND_KINDS | FILM_KINDS).get(PurePosixPath(call.argument).suffix.lower(), "")
    if kind:
        context.files.update(path for path in (call.argument, given["captions"]) if path)

    def size_of(file: str) -> Size | None:
        return picture_size(context.content / file) if file else None

    size, other = size_of(given["poster"] if kind else call.argument), size_of(given["dark"])
    if size and other and abs(size[0] * other[1] / (size[1] * other[0]) - 1) > ALIKE:
        shapes = "{} × {} for a picture of {} × {}".format(*other, *size)
        context.problem(call.line_of("dark"), f"dark variant of {shapes}; legal: its shape")
    alt = call.text("alt") or call.text("title")
    return Media(call.argument, alt, caption, kind, size, **given)


def _transcript(call: DirectiveCall, tokens: Sequence[Token], context: ParseContext) -> Passage:
    if not tokens:
        context.problem(call.line, "{audio} without a transcript; legal: in words what is heard")
    return passage(plain_tokens(call, tokens, context))


def _media(
    name: str, doc: str, argument: Argument, *options: OptionLine, body: Body[Passage] = CAPTION
) -> Directive[Passage]:
    return Directive(
        name=name,
        doc=doc,
        argument=argument,
        options=(*options, LABEL),
        body=body,
        read=read_media,
        template=name,
        numbered=Numbered(
            "Figure",
            lambda call: f"figure-{'-'.join(PurePosixPath(call.argument).stem.split())}",
            again=True,
        ),
        plain=lambda shown: Plain((shown.alt, shown.caption), "figure"),
    )


FIGURE = _media(
    "figure",
    "a picture of yours, scaled down to what screens can show of it",
    Argument("images/file.svg", lacks="names no picture", file=PICTURES),
    OptionLine("alt", doc="what the picture shows", required=True),
    OptionLine("width", doc="how wide it is shown, `60%` or `320px`", form=WIDTH),
    OptionLine("dark", doc="a picture for dark paper, `images/dark.svg`", file=PICTURES),
)
RECORDING = FileKind("recording", tuple(SOUND_KINDS))
AUDIO = _media(
    "audio",
    "a recording of yours",
    Argument("sounds/file.mp3", lacks="names no recording", file=RECORDING),
    OptionLine("title", doc="what it is called", required=True),
    OptionLine("licence", doc="whose it is and under which terms, `Ada Lovelace, CC BY 4.0`"),
    body=Body("what is heard, in words", _transcript),
)
POSTER_DOC = "the picture before it starts, and on paper"
CAPTIONS = FileKind("captions", (".vtt",))
VIDEO = _media(
    "video",
    "a film of yours",
    Argument("clips/file.mp4", lacks="names no film", file=FileKind("film", tuple(FILM_KINDS))),
    OptionLine("alt", doc="what the film shows", required=True),
    OptionLine("poster", doc=POSTER_DOC, required=True, file=PICTURES),
    OptionLine("captions", doc="what is said in it, `clips/file.vtt`", file=CAPTIONS),
    OptionLine("language", doc="of the captions, `de`; the book's where you say none"),
)


MODULES = found("illustrations")


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
    options=(OptionLine("alt", doc="what it shows, instead of its own description"), LABEL),
    body=Body("a caption; for a drawing in steps, a numbered list of sentences", CAPTION.read),
    read=read_illustration,
    template="illustration",
    numbered=Numbered("Figure", lambda call: f"figure-{call.argument}", again=True),
    plain=lambda drawn: Plain((drawn.description, drawn.caption, drawn.sentences), "figure"),
)


ACTIVE = (
    ".html", ".htm", ".xhtml", ".xht", ".shtml", ".mht", ".mhtml", ".xml", ".xsl", ".xslt", ".svgz",
    ".js", ".mjs",
)  # fmt: skip
"""Files that a browser would run with the rights of the book's own pages."""
UNITS = ("bytes", "kB", "MB", "GB")


@dataclass(frozen=True, slots=True)
class Download:
    file: str
    """Path below ``content/``."""
    name: str
    """What it is called once it is there."""
    size: str
    words: Passage
    """A description; may be empty."""


def read_download(call: DirectiveCall, words: Passage, context: ParseContext) -> Download:
    file = context.content / call.argument
    if _runs(file) and not context.shared.raw_html:
        expected = "packed, as a '.zip', or trusted in book.toml"
        raise CodeError(f"file {call.argument!r}, which a browser would run; legal: {expected}")
    context.files.add(call.argument)
    size = size_words(file.stat().st_size, context.shared.words)
    return Download(call.argument, PurePosixPath(call.argument).name, size, words)


def _runs(file: Path) -> bool:
    return file.suffix.lower() in ACTIVE


def size_words(size: int, words: Words = ENGLISH) -> str:
    """``340 bytes``, ``1.2 kB``, ``35 MB``: two digits, or all below a thousand."""
    amount, unit = float(size), 0
    while amount >= 999.5 and unit < len(UNITS) - 1:
        amount, unit = amount / 1000, unit + 1
    digits = 1 if unit and amount < 9.95 else 0
    named = UNITS[unit] if unit else words("download.bytes")
    return f"{words.numeral(f'{amount:.{digits}f}')} {named}"


DOWNLOAD = Directive(
    name="download",
    doc="a file of yours for the reader to keep",
    argument=Argument("data/file.csv", lacks="names no file", file=FileKind("file")),
    body=CAPTION,
    read=read_download,
    template="download",
    plain=lambda download: Plain((download.name, download.words)),
)
DATA_SHEET = Directive(
    name="data-sheet",
    doc="the results of the instruments of a page",
    argument=None,
    body=CAPTION,
    read=lambda _call, words, _context: Prose(words),
    template="data-sheet",
    plain=lambda sheet: Plain((sheet.words,)),
)
