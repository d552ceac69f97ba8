"""Which parts of a page say what: to be read in one place when a template changes."""

from collections.abc import Mapping
from typing import Literal

type Channel = Literal["outside", "hidden", "title", "term", "text", "figure", "question"]

ARTICLE = "data-searched"
"""Marks the articles whose text can be found."""
NEVER_CLOSED = {
    "area", "br", "col", "embed", "hr", "img", "input", "link", "meta", "source", "track", "wbr",
}  # fmt: skip
INLINE = {
    "a", "abbr", "b", "code", "dfn", "em", "i", "math", "mfrac", "mi", "mn", "mo", "mrow",
    "mspace", "msqrt", "msub", "msubsup", "msup", "mtext", "small", "span", "strong", "sub", "sup",
}  # fmt: skip
"""Elements whose end does not end a word."""
HEADINGS = {"h1", "h2", "h3"}
"""Each begins a section; ``h1`` is the title of what stands before the first."""
SILENT_TAGS = {
    "button", "footer", "nav", "noscript", "pre", "script", "select", "style", "svg", "video",
}  # fmt: skip
SILENT_CLASSES = {
    "answer", "chapter-facts", "feedback",  # what waits, and what is not of the text
    "callout-title", "chapter-number", "panel-title", "question-number",
    "controls", "figure-foot", "figure-status", "handles", "panel-dots", "predict-actions",
    "download-size", "progress", "tools", "entry-places", "letter-name",
    "extremes", "ladder-actions", "ladder-key", "ladder-table", "readouts", "source",
    "stage-costs",
}  # fmt: skip
QUESTION_CLASSES = {"predict-question"}
FIGURE_CLASSES = {"illustration", "ladder", "simulation"}
"""Of ``figure`` elements; tables and listings are text."""


def channel_of(tag: str, attributes: Mapping[str, str], outer: Channel) -> Channel:
    """What the text of an element is, inside one whose text is ``outer``."""
    classes = set(attributes.get("class", "").split())
    if outer == "outside":
        return "text" if ARTICLE in attributes else "outside"
    if tag == "legend":
        return "question"
    if tag == "fieldset" and outer != "hidden":
        return "hidden"
    if outer == "hidden" or _is_silent(tag, attributes, classes):
        return "hidden"
    if tag in HEADINGS:
        return "title"
    if outer == "figure":
        return "hidden" if tag == "table" else "figure"
    if tag == "figure" and classes & FIGURE_CLASSES:
        return "figure"
    if classes & QUESTION_CLASSES or outer == "question":
        return "question"
    if tag in ("strong", "em", "dfn") and outer == "text":
        return "term"
    return outer


def title_in(tag: str, attributes: Mapping[str, str], outer: Channel) -> str:
    """A title or a description that stands in an attribute: of a figure, of a picture."""
    if outer != "figure":
        return ""
    if tag == "form" or attributes.get("role") == "img":
        return attributes.get("aria-label", "")
    if tag == "video":
        return attributes.get("aria-label", "")
    if "on-dark" in attributes.get("class", "").split():
        return ""  # its twin on light paper has said it
    return attributes.get("alt", "") if tag == "img" else ""


def _is_silent(tag: str, attributes: Mapping[str, str], classes: set[str]) -> bool:
    displayed = tag == "math" and attributes.get("display") == "block"
    unseen = "hidden" in attributes or attributes.get("aria-hidden") == "true"
    return displayed or unseen or tag in SILENT_TAGS or bool(classes & SILENT_CLASSES)
