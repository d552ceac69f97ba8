"""A chapter on its way to a notebook: what the functions of all directives need."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from simulations.engine.frame import Panel
from simulations.notebook.picture import frame_svg
from site_builder.build import CheckedBook
from site_builder.document.blocks import Simulation
from site_builder.document.book import Book, Chapter
from site_builder.document.places import Target
from site_builder.editions.links import on_site
from site_builder.figures.initial_frames import InitialFrame
from site_builder.languages.words import Words
from site_builder.publishing.vector import Fonts, png_of
from site_builder.render.markdown import MarkdownRenderer, escaped

PX_PER_UNIT = 1.25
"""Of a picture: labels of 13 units become as large as the text around it."""


@dataclass(frozen=True)
class Page:
    """One chapter."""

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

    def still(self, figure: Simulation) -> InitialFrame:
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
