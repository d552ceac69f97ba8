"""``{download}``, a file of ``content/``, and ``{data-sheet}``, the results of instruments."""

from dataclasses import dataclass
from pathlib import Path, PurePosixPath

from site_builder.document.passage import Passage, Plain
from site_builder.languages.words import ENGLISH, Words
from site_builder.markdown.bodies import CAPTION
from site_builder.markdown.directive import Argument, Directive, DirectiveCall, FileKind
from site_builder.markdown.parse_context import ParseContext

ACTIVE = (
    ".html", ".htm", ".xhtml", ".xht", ".shtml", ".mht", ".mhtml", ".xml", ".xsl", ".xslt", ".svgz",
    ".js", ".mjs",
)  # fmt: skip
"""Files that a browser would run with the rights of the book's own pages."""
UNITS = ("bytes", "kB", "MB", "GB")


@dataclass(frozen=True, slots=True)
class Download:
    """A file to keep."""

    file: str
    """Path below ``content/``."""
    name: str
    """What it is called once it is there."""
    size: str
    words: Passage
    """A description; may be empty."""


def read_download(call: DirectiveCall, words: Passage, context: ParseContext) -> Download | None:
    file = context.content / call.argument
    if _runs(file) and not context.shared.raw_html:
        expected = "packed, as a '.zip', or trusted in book.toml"
        message = f"file {call.argument!r}, which a browser would run; legal: {expected}"
        context.problem(call.line, message)
        return None
    context.files.add(call.argument)
    name = PurePosixPath(call.argument).name
    return Download(
        call.argument, name, size_words(file.stat().st_size, context.shared.words), words
    )


def _runs(file: Path) -> bool:
    """An SVG is checked only where its name ends in ``.svg``."""
    kind = file.suffix.lower()
    return kind in ACTIVE or (kind == ".svg" and file.suffix != kind)


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


@dataclass(frozen=True, slots=True)
class DataSheet:
    """Where the results stand."""

    words: Passage
    """May be empty."""


def read_data_sheet(_call: DirectiveCall, words: Passage, _context: ParseContext) -> DataSheet:
    return DataSheet(words)


DATA_SHEET = Directive(
    name="data-sheet",
    doc="the results of the instruments of a page",
    argument=None,
    body=CAPTION,
    read=read_data_sheet,
    template="data-sheet",
    plain=lambda sheet: Plain((sheet.words,)),
)
