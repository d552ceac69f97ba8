"""A page of the site without what only a screen can do: what is left is read."""

from collections.abc import Mapping
from xml.etree.ElementTree import Element, SubElement

from site_builder.editions.tree import classes, elements, first, parents, parse, remove

DROPPED_NAMES = frozenset({"script", "noscript", "button", "select", "textarea", "progress"})
DROPPED_CLASSES = frozenset(
    {
        *("controls", "figure-foot", "figure-status", "panel-dots", "handles", "anchor"),
        *("on-this-page", "progress", "ladder-actions", "own", "reading-time"),
        *("feedback", "answer-waits", "predict-actions", "sketch-points", "sketch-legend"),
        "on-dark",
        *("letters", "truth", "drawn", "points", "grip", "order-place", "figure-link"),
    }
)
"""What is pressed, what waits for an answer or for a measurement, and what would betray one."""
KEPT_ATTRIBUTES = frozenset({"aria-label", "aria-hidden", "data-count", "data-label"})
"""Of those that speak to scripts and to screen readers."""
DROPPED_ATTRIBUTES = frozenset({"tabindex", "for", "name", "autocomplete", "loading"})
LETTERS = "ABCDEFGHIJKLMNOPQRSTUVWXYZ"


def article(page: bytes) -> Element:
    """What a page of the site says, reduced."""
    found = first(parse(page.decode("utf-8")), "article")
    _drop(found)
    _open(found)
    _still(found)
    _letter_options(found)
    _quieten(found)
    return found


def put_rows(root: Element, rows: Mapping[str, Element]) -> None:
    """Behind the panels of each figure its row of small multiples, by element id."""
    for figure in elements(root, "figure", "simulation"):
        row = rows.get(figure.get("id", ""))
        if row is not None:
            inner = first(figure, "simulation-figure")
            place = list(inner).index(first(inner, kind="panels"))
            inner.insert(place + 1, row)


def _drop(root: Element) -> None:
    for child, parent in parents(root).items():
        if child.tag in DROPPED_NAMES or classes(child) & DROPPED_CLASSES:
            remove(parent, child)
    for heading in elements(root, "th", "times"):
        heading.set("colspan", "2")  # the third was the reader's own device


def _open(root: Element) -> None:
    """Folds are open on paper."""
    for fold in elements(root, "details"):
        fold.tag = "section"
        fold.attrib.pop("open", None)
        for summary in elements(fold, "summary"):
            summary.tag = "p"
            summary.set("class", "fold-title")


def _still(root: Element) -> None:
    """A film is the picture that it begins with."""
    for film in list(elements(root, "video")):
        kept = {"src": film.get("poster", ""), "alt": film.get("aria-label", "")}
        kept |= {name: film.attrib[name] for name in ("width", "height") if name in film.attrib}
        for child in list(film):
            film.remove(child)
        film.tag, film.text = "img", None
        film.attrib.clear()
        film.attrib.update(kept)


def _letter_options(root: Element) -> None:
    """Each answer to choose from gets the letter that its explanation names; a number, a line."""
    for question in elements(root, "form"):
        items = [*elements(question, kind="option"), *elements(question, kind="order-item")]
        for letter, item in zip(LETTERS, items, strict=False):
            for box in elements(item, "input"):
                remove(item, box)
            mark = Element("span", {"class": "option-letter"})
            mark.text, mark.tail = letter, " "
            item.text, before = None, item.text
            mark.tail = (before or "").strip() + " "
            item.insert(0, mark)
    for child, parent in parents(root).items():
        if child.tag == "input" and child.get("type") == "number":
            child.tag = "span"
            child.attrib.clear()
            child.set("class", "blank")
        elif child.tag == "input":
            remove(parent, child)


def _quieten(root: Element) -> None:
    """Without what speaks to scripts, or of ids that are gone."""
    for element in root.iter():
        if element.tag == "label":
            element.tag = "div" if "option" in classes(element) else "span"
        for name in list(element.attrib):
            script = name.startswith(("data-", "aria-")) and name not in KEPT_ATTRIBUTES
            if script or name in DROPPED_ATTRIBUTES:
                del element.attrib[name]
        if element.get("role") not in (None, "img"):
            del element.attrib["role"]
        if element.get("role") is None and element.tag != "a" and "aria-label" in element.attrib:
            del element.attrib["aria-label"]


def note(parent: Element, kind: str, text: str = "") -> Element:
    """A new paragraph at the end of ``parent``."""
    paragraph = SubElement(parent, "p", {"class": kind})
    paragraph.text = text
    return paragraph
