"""The whole book as one document, for the printer: every id and link of it unambiguous."""

import re
from copy import deepcopy
from xml.etree.ElementTree import Element

from site_builder.editions.compose import Composed, Section
from site_builder.editions.links import Place, bind_links
from site_builder.editions.page_numbers import page_number
from site_builder.editions.tree import elements, first, parse
from site_builder.pages.back_matter import BACK_MATTER
from site_builder.pages.environment import render_template

BEYOND_ASCII = re.compile(r"[^\x21-\x7e]")


def anchor(place: Place) -> str:
    """Id in the whole of a place on a page; in ASCII, as names in a PDF have no encoding."""
    id = f"{place.page}.{place.id}" if place.id else place.page
    return BEYOND_ASCII.sub(lambda found: f"_{ord(found[0]):x}", id)


def volume(composed: Composed) -> Element:
    """The document, its page numbers still to be filled in."""
    frame = render_template(
        "editions/volume.html",
        composed.book,
        composed=composed,
        anchor=lambda page, id: anchor(Place(page, id)),
        stylesheet=f"{composed.assets}css/book.css",
    )
    document = parse(frame)
    for entry in [item for item in elements(document) if "data-entry" in item.attrib]:
        entry.append(page_number(entry.attrib.pop("data-entry"), "toc-page"))
    body = first(document, "body")
    for section in composed.sections:
        body.append(_bound(section, composed))
    return document


def _bound(section: Section, composed: Composed) -> Element:
    """A section as part of the whole. Behind links into other sections their page is printed."""
    content = deepcopy(section.article)
    for element in content.iter():
        if "id" in element.attrib:
            element.set("id", anchor(Place(section.id, element.attrib["id"])))
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
