"""A strict reading of HTML: every element closed in order, ids unique; gives elements to tests."""

from dataclasses import dataclass, field
from html.parser import HTMLParser

VOID = {"meta", "link", "img", "input", "br", "hr", "source", "track"}
NO_PARAGRAPHS_INSIDE = {"p", "h1", "h2", "h3", "h4", "label", "summary", "a", "span"}
BLOCKS = {"p", "div", "ul", "ol", "table", "figure", "section", "aside", "form", "pre"}


@dataclass(slots=True)
class Element:
    """An element and the text directly in it."""

    tag: str
    attributes: dict[str, str | None]
    inside: tuple[str, ...]
    """Tags of the elements around it, outermost first."""
    text: str = ""


@dataclass(slots=True)
class Page:
    """All elements of a page, in order."""

    elements: list[Element] = field(default_factory=list)

    def all(self, tag: str, name: str = "") -> list[Element]:
        """Elements by tag and, if given, class."""
        return [
            element
            for element in self.elements
            if element.tag == tag
            and (not name or name in (element.attributes.get("class") or "").split())
        ]  # fmt: skip

    def addresses(self) -> list[str]:
        """Everything that the page links to or loads."""
        return [
            str(element.attributes[name])
            for element in self.elements
            for name in ("href", "src")
            if name in element.attributes
        ]


class _Parser(HTMLParser):
    def __init__(self) -> None:
        super().__init__()
        self.page = Page()
        self.open: list[Element] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        names = [name for name, _ in attrs]
        assert len(set(names)) == len(names), f"attribute twice in <{tag}> {attrs}"
        element = Element(tag, dict(attrs), tuple(item.tag for item in self.open))
        self.page.elements.append(element)
        if self.open and tag in BLOCKS:
            assert self.open[-1].tag not in NO_PARAGRAPHS_INSIDE, f"<{tag}> in {self.open[-1]}"
        if tag not in VOID:
            self.open.append(element)

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.page.elements.append(Element(tag, dict(attrs), tuple(i.tag for i in self.open)))

    def handle_endtag(self, tag: str) -> None:
        assert self.open, f"</{tag}> closes nothing"
        assert self.open[-1].tag == tag, f"</{tag}> closes <{self.open[-1].tag}> {self.getpos()}"
        self.open.pop()

    def handle_data(self, data: str) -> None:
        if self.open:
            self.open[-1].text += data


def read_html(markup: bytes) -> Page:
    """The page; asserts that it is well formed and names no id twice."""
    parser = _Parser()
    parser.feed(markup.decode())
    parser.close()
    assert not parser.open, f"never closed: {[item.tag for item in parser.open]}"
    ids = [item.attributes["id"] or "" for item in parser.page.elements if "id" in item.attributes]
    assert len(set(ids)) == len(ids), f"ids twice: {sorted(i for i in ids if ids.count(i) > 1)}"
    return parser.page
