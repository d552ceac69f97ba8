"""The book as a PDF: printed by Chromium once for the page numbers, then with them."""

import io
import mimetypes
import re
from collections.abc import Callable, Mapping
from copy import deepcopy
from pathlib import Path
from urllib.parse import unquote
from xml.etree.ElementTree import Element

from site_builder.editions.compose import BoundSection, Composed
from site_builder.editions.tree import LinkTarget, bind_links, elements, first, parse, xhtml
from site_builder.output.writer import content_bytes
from site_builder.pages.back_matter import BACK_MATTER
from site_builder.pages.environment import render_template
from site_builder.programs.chromium import launch_arguments, require_chromium

PAGE_OF = "data-page-of"
"""Names the element whose page is to be printed here."""
PAGE_AS = "data-page-as"
"""In which words, with ``{page}`` for the number."""
UNKNOWN = "000"
"""Stands for a number while none is known: as wide as most."""


class PageNumberError(ValueError):
    """A place to which a number leads is on no page."""


def page_number(anchor: str, kind: str, words: str = "{page}") -> Element:
    """Where a number is to be printed in these words: ``kind`` is its class."""
    return Element("span", {"class": kind, PAGE_OF: anchor, PAGE_AS: words})


def fill(root: Element, pages: Mapping[str, int] | None) -> None:
    """Print the page of each anchor; before pages are known, what is as wide.

    Raises `PageNumberError` naming the anchors that are on no page.
    """
    asked = [element for element in elements(root) if PAGE_OF in element.attrib]
    missing = {element.get(PAGE_OF, "") for element in asked} - set(pages or ())
    if pages is not None and missing:
        raise PageNumberError(f"anchors on no page: {', '.join(sorted(missing))}")
    for element in asked:
        number = str(pages[element.get(PAGE_OF, "")]) if pages else UNKNOWN
        element.text = element.get(PAGE_AS, "{page}").replace("{page}", number)


BEYOND_ASCII = re.compile(r"[^\x21-\x7e]")


def anchor(place: LinkTarget) -> str:
    """Id in the whole of a place on a page; in ASCII, as names in a PDF have no encoding."""
    id = f"{place.page}.{place.id}" if place.id else place.page
    return BEYOND_ASCII.sub(lambda found: f"_{ord(found[0]):x}", id)


def volume(composed: Composed) -> Element:
    """The document, its page numbers still to be filled in."""
    frame = render_template(
        "editions/volume.html",
        composed.book,
        composed=composed,
        anchor=lambda page, id: anchor(LinkTarget(page, id)),
        stylesheet=f"{composed.assets}css/book.css",
    )
    document = parse(frame)
    for entry in [item for item in elements(document) if "data-entry" in item.attrib]:
        entry.append(page_number(entry.attrib.pop("data-entry"), "toc-page"))
    body = first(document, "body")
    for section in composed.sections:
        body.append(_bound_section(section, composed))
    return document


def _bound_section(section: BoundSection, composed: Composed) -> Element:
    """A section as part of the whole. Behind links into other sections their page is printed."""
    content = deepcopy(section.article)
    for element in content.iter():
        if "id" in element.attrib:
            element.set("id", anchor(LinkTarget(section.id, element.attrib["id"])))
        if element.get("src", "").startswith("../"):
            element.set("src", element.attrib["src"].removeprefix("../"))
    on_page = composed.book.words("edition.on_page", page="{page}")
    links = bind_links(content, section.id, composed.ids, lambda place: f"#{anchor(place)}")
    for parent, link, place in links:
        if place.page not in (section.id, *BACK_MATTER):
            number = page_number(anchor(place), "page-ref", on_page)
            parent.insert(list(parent).index(link) + 1, number)
            number.tail, link.tail = link.tail, "\N{NO-BREAK SPACE}"
    content.set("id", section.id)
    content.set("style", f"page: {section.id}")
    return content


SITE = "http://book.invalid/"
"""Addresses are answered from memory: nothing is served, nothing fetched."""
DOCUMENT = "volume.xhtml"
STYLE = Path(__file__).with_name("volume.css")
TURNS = 4
"""Times that the book is set at most; numbers seldom move a line, so that two mostly do."""

type Pages = Mapping[str, int]
type Print = Callable[[bytes], bytes]


def pdf_printer() -> Path:
    """The Chromium of `make_pdf`. Raises `MissingChromiumError`, naming all that it lacks."""
    return require_chromium("the PDF", "pypdf")


class UnsettledError(RuntimeError):
    """The page numbers still change after `TURNS` prints."""


def make_pdf(composed: Composed, chromium: Path) -> bytes:
    """Printed by this Chromium: see `pdf_printer`."""
    from playwright.sync_api import Route, sync_playwright  # `pdf_printer` found it

    files: dict[str, bytes] = {"volume.css": STYLE.read_bytes()}

    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=chromium, args=launch_arguments())
        page = browser.new_page()

        def answer(route: Route) -> None:
            name = unquote(route.request.url.removeprefix(SITE))
            if (found := files.get(name, composed.files.get(name))) is None:
                route.abort()
            else:
                kind = mimetypes.guess_type(name)[0] or "application/octet-stream"
                route.fulfill(body=content_bytes(found), content_type=kind)

        def printed(document: bytes) -> bytes:
            files[DOCUMENT] = document
            page.goto(SITE + DOCUMENT, wait_until="load", timeout=0)
            page.evaluate("document.fonts.ready")
            page.set_default_timeout(0)
            return page.pdf(outline=True, tagged=True, prefer_css_page_size=True)

        page.route("**/*", answer)
        try:
            return print_until_stable(volume(composed), printed, anchor_pages)
        finally:
            browser.close()


def print_until_stable(
    document: Element, printed: Print, pages_of: Callable[[bytes], Pages]
) -> bytes:
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
