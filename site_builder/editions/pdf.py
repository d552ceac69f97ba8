"""The book as a PDF, printed by Chromium: once for the page numbers, then with them."""

import io
import mimetypes
from collections.abc import Callable, Mapping
from copy import deepcopy
from pathlib import Path
from xml.etree.ElementTree import Element

from site_builder.assets.pages import Files
from site_builder.editions.compose import Composed
from site_builder.editions.page_numbers import fill
from site_builder.editions.tree import xhtml
from site_builder.editions.volume import volume
from site_builder.output.assets import content_bytes
from site_builder.programs.chromium import launch_arguments, require_chromium

SITE = "http://book.invalid/"
"""Addresses are answered from memory: nothing is served, nothing fetched."""
DOCUMENT = "volume.xhtml"
STYLE = Path(__file__).with_name("volume.css")
TURNS = 4
"""Times that the book is set at most; numbers seldom move a line, so that two mostly do."""

type Pages = Mapping[str, int]
type Print = Callable[[bytes], bytes]


class UnsettledError(RuntimeError):
    """The page numbers still change after `TURNS` prints."""


def make_pdf(composed: Composed) -> bytes:
    """Raises `MissingChromiumError` without a browser."""
    chromium = require_chromium("the PDF")
    from playwright.sync_api import Route, sync_playwright  # installed, as Chromium was found by it

    files: dict[str, bytes] = {"volume.css": STYLE.read_bytes()}

    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=chromium, args=launch_arguments())
        page = browser.new_page()

        def answer(route: Route) -> None:
            name = route.request.url.removeprefix(SITE)
            content = files[name] if name in files else _content(composed.files, name)
            if content is None:
                route.abort()
            else:
                route.fulfill(body=content, content_type=_type(name))

        def printed(document: bytes) -> bytes:
            files[DOCUMENT] = document
            page.goto(SITE + DOCUMENT, wait_until="load", timeout=0)
            page.evaluate("document.fonts.ready")
            page.set_default_timeout(0)
            return page.pdf(outline=True, tagged=True, prefer_css_page_size=True)

        page.route("**/*", answer)
        try:
            return settle(volume(composed), printed, anchor_pages)
        finally:
            browser.close()


def settle(document: Element, printed: Print, pages_of: Callable[[bytes], Pages]) -> bytes:
    """Set the document until the page numbers in it are those of its own pages."""
    known: Pages | None = None
    for _ in range(TURNS):
        turn = deepcopy(document)
        fill(turn, known)
        pdf = printed(xhtml(turn))
        found = pages_of(pdf)
        if found == known:
            return pdf
        known = found
    raise UnsettledError(f"after {TURNS} turns page numbers still move what they lead to")


def anchor_pages(pdf: bytes) -> dict[str, int]:
    """The page, from 1, of everything that a link leads to, by element id."""
    from pypdf import PdfReader

    reader = PdfReader(io.BytesIO(pdf))
    found = {}
    for name, destination in reader.named_destinations.items():
        number = reader.get_destination_page_number(destination)
        if number is not None:
            found[name.removeprefix("/")] = number + 1
    return found


def _content(files: Files, name: str) -> bytes | None:
    return content_bytes(files[name]) if name in files else None


def _type(name: str) -> str:
    return mimetypes.guess_type(name)[0] or "application/octet-stream"
