"""What a notebook is made of, before it is a file: words with their pictures, and code."""

from base64 import b64encode
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from itertools import groupby
from mimetypes import guess_type
from pathlib import Path
from types import MappingProxyType
from typing import Any

from nbformat import v4

from simulations.engine.frame import Panel
from simulations.notebook.picture import frame_svg
from site_builder.build import CheckedBook
from site_builder.document.blocks import Simulation
from site_builder.document.book import Book, Chapter
from site_builder.document.places import Target
from site_builder.editions.tree import on_site
from site_builder.figures.initial_frames import InitialFrame
from site_builder.languages.words import Words
from site_builder.publishing.vector import Fonts, png_of
from site_builder.render.markdown import MarkdownRenderer, escaped

NO_PICTURES: Mapping[str, bytes] = MappingProxyType({})


@dataclass(frozen=True, slots=True)
class Text:
    """Markdown; it shows ``pictures``, files by name, as ``attachment:NAME``."""

    markdown: str
    pictures: Mapping[str, bytes] = field(default=NO_PICTURES)


@dataclass(frozen=True, slots=True)
class Code:
    """Python, and what it showed when the book was built."""

    source: str
    picture: bytes = b""
    """PNG; nothing where it shows none."""
    words: str = ""
    """The same for readers who cannot see it."""
    may_fail: bool = False
    """Whether the cells below run also where this one raises."""


type Part = Text | Code


def wrapped(parts: Iterable[Part], wrap: Callable[[str], str]) -> Iterator[Part]:
    """``parts`` with ``wrap`` around the words; code stays, as it cannot stand inside of words."""
    for is_text, run in groupby(parts, key=lambda part: isinstance(part, Text)):
        if is_text:
            joined = join(part for part in run if isinstance(part, Text))
            yield Text(wrap(joined.markdown), joined.pictures)
        else:
            yield from run


def join(texts: Iterable[Text]) -> Text:
    each = [*texts]
    pictures = {name: file for text in each for name, file in text.pictures.items()}
    return Text("\n\n".join(text.markdown for text in each), pictures)


def cell_of(part: Part, id: str) -> Any:
    """The cell as nbformat has it."""
    if isinstance(part, Text):
        attached = {
            name: {guess_type(name)[0]: b64encode(file).decode()}
            for name, file in part.pictures.items()
        }
        more = {"attachments": attached} if attached else {}
        return v4.new_markdown_cell(part.markdown, id=id, **more)
    data = {"image/png": b64encode(part.picture).decode(), "text/plain": part.words}
    outputs = [v4.new_output("display_data", data)] if part.picture else []
    metadata = {"tags": ["raises-exception"]} if part.may_fail else {}
    return v4.new_code_cell(part.source, id=id, outputs=outputs, metadata=metadata)


PX_PER_UNIT = 1.25
"""Scale of a picture: labels of 13 units become as large as the text around it."""


@dataclass(frozen=True)
class ChapterPage:
    checked: CheckedBook
    chapter: Chapter
    content: Path
    """The folder of the book's pictures."""
    style: str
    """The sheet for drawings."""
    fonts: Fonts

    @property
    def book(self) -> Book:
        return self.checked.book

    @property
    def words(self) -> Words:
        return self.book.words

    @cached_property
    def markdown(self) -> MarkdownRenderer:
        return MarkdownRenderer(self.book.settings.macros, self.address)

    def address(self, href: str) -> str:
        """Where a link of the chapter leads: into the site, where that has an address."""
        site = self.book.address
        return on_site(href, f"{site}{self.chapter.url}" if site else "")

    def initial_frame(self, figure: Simulation) -> InitialFrame:
        return self.checked.initial_frames[figure.path, figure.line]

    def picture(self, panels: Sequence[Panel]) -> bytes:
        """The panels as one PNG."""
        width = round(PX_PER_UNIT * sum(panel.width for panel in panels))
        return png_of(frame_svg(panels, self.style), width, self.fonts)


def named(target: Target | None) -> str:
    """``**Figure 4.2** ``, for the words behind it."""
    return f"**{escaped(target.name)}** " if target else ""


def folded(summary: str, markdown: str) -> str:
    """Words that are shown on request."""
    return f"<details>\n<summary>{summary}</summary>\n\n{markdown}\n\n</details>"
