"""A strict reader of HTML, which asserts that elements are closed in order and ids are unique.

`outline` is the content of a page without its markup: kinds, ids, addresses, numbers and text.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from html.parser import HTMLParser

VOID = {"meta", "link", "img", "input", "br", "hr", "source", "track"}
NO_PARAGRAPHS_INSIDE = {"p", "h1", "h2", "h3", "h4", "label", "summary", "a", "span"}
BLOCKS = {"p", "div", "ul", "ol", "table", "figure", "section", "aside", "form", "pre"}


@dataclass(slots=True)
class Element:
    """An element, the text directly in it, and its content in order."""

    tag: str
    attributes: dict[str, str | None]
    inside: tuple[str, ...]
    """Tags of the elements around it, outermost first."""
    text: str = ""
    content: list["str | Element"] = field(default_factory=list)

    def __getitem__(self, name: str) -> str:
        """An attribute; empty where it has no value or is missing."""
        return self.attributes.get(name) or ""


@dataclass(slots=True)
class Page:
    """All elements of a page, in order."""

    elements: list[Element] = field(default_factory=list)

    def all(self, tag: str, name: str = "") -> list[Element]:
        """Elements by tag and, if given, class."""
        return [
            element
            for element in self.elements
            if element.tag == tag and (not name or name in element["class"].split())
        ]

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
        if self.open and tag in BLOCKS:
            assert self.open[-1].tag not in NO_PARAGRAPHS_INSIDE, f"<{tag}> in {self.open[-1].tag}"
        element = self._add(tag, attrs)
        if tag not in VOID:
            self.open.append(element)

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self._add(tag, attrs)

    def _add(self, tag: str, attrs: list[tuple[str, str | None]]) -> Element:
        element = Element(tag, dict(attrs), tuple(item.tag for item in self.open))
        self.page.elements.append(element)
        if self.open:
            self.open[-1].content.append(element)
        return element

    def handle_endtag(self, tag: str) -> None:
        assert self.open, f"</{tag}> closes nothing"
        assert self.open[-1].tag == tag, f"</{tag}> closes <{self.open[-1].tag}> {self.getpos()}"
        self.open.pop()

    def handle_data(self, data: str) -> None:
        if self.open:
            self.open[-1].text += data
            self.open[-1].content.append(data)


def read_html(markup: bytes) -> Page:
    """The page; asserts that it is well formed and that its ids are unique."""
    parser = _Parser()
    parser.feed(markup.decode())
    parser.close()
    assert not parser.open, f"never closed: {[item.tag for item in parser.open]}"
    ids = [item["id"] for item in parser.page.elements if "id" in item.attributes]
    assert len(set(ids)) == len(ids), f"ids twice: {sorted(i for i in ids if ids.count(i) > 1)}"
    return parser.page


INLINE = {
    "a", "abbr", "br", "button", "cite", "code", "em", "i", "img", "input", "label", "math",
    "option", "output", "q", "select", "small", "span", "strong", "sub", "summary", "sup",
    "textarea", "time",
}  # fmt: skip
FURNITURE = ("header", "script", "style", "template", "button", "textarea", "svg")
"""Elements that the builder adds to the author's text; `outline` leaves them out."""
ATTRIBUTES = (
    "id", "name", "type", "value", "min", "max", "step", "checked", "selected", "alt", "width",
    "height", "colspan", "lang", "start", "open", "data-quiz", "data-predict",
    "data-kind", "data-answers", "data-simulation", "data-figure", "data-values", "data-state",
    "data-frames", "data-handle", "data-with",
)  # fmt: skip
ROLE = re.compile(r"\brole-(\S+)")


def outline(element: Element) -> str:
    """The content of the element, one block per line, indented by depth.

    Links are ``[words](address)``, code stands between backticks, formulae between ``$``.
    """
    return "\n".join(_lines(element.content)) + "\n"


def within(element: Element) -> Iterator[Element]:
    """All elements inside this one, at any depth."""
    for item in element.content:
        if isinstance(item, Element):
            yield item
            yield from within(item)


def _lines(content: "list[str | Element]") -> Iterator[str]:
    words = ""
    for item in content:
        if isinstance(item, str) or item.tag in INLINE:
            words += item if isinstance(item, str) else _inline(item)
            continue
        yield from filter(None, (_plain(words),))
        words = ""
        if item.tag in FURNITURE or {"hidden", "data-progress"} & item.attributes.keys():
            continue
        head = item.tag + _attributes(item)
        if item.tag == "simulation-figure":
            yield head
            yield from _lines([one for one in within(item) if one["id"].endswith("-caption")])
            continue
        if item.tag == "tr":
            cells = (one for one in item.content if isinstance(one, Element))
            yield "tr: " + " | ".join(" / ".join(_lines(cell.content)) for cell in cells)
            continue
        lines = list(_lines(item.content))
        if head in ("div", "thead", "tbody") or not (lines or _attributes(item)):
            yield from lines
        elif item.tag == "pre":
            yield f"pre: {_letters(item).rstrip()!r}"
        elif len(lines) == 1 and not lines[0].startswith(" "):
            yield f"{head}: {lines[0]}"
        else:
            yield head
            yield from (f"  {line}" for line in lines)
    yield from filter(None, (_plain(words),))


def _plain(words: str) -> str:
    line = " ".join(words.replace("\u00a0", "~").split())
    repeated = re.compile(r"(<input[^>]*>)(?: \1)+")
    return repeated.sub(lambda found: f"{found[0].count('<input')} × {found[1]}", line)


def _attributes(element: Element) -> str:
    shown = []
    for name in ATTRIBUTES:
        if name in element.attributes:
            value = _address(element[name])
            shown.append(f"#{value}" if name == "id" else f"{name}={value}" if value else name)
    return "".join(f" {one}" for one in shown)


def _address(text: str) -> str:
    return re.sub(r"assets/[0-9a-f]+/", "assets/…/", text)


def _letters(element: Element) -> str:
    return "".join(item if isinstance(item, str) else _letters(item) for item in element.content)


def _inline(element: Element) -> str:
    inner = "".join(item if isinstance(item, str) else _inline(item) for item in element.content)
    role = ROLE.search(element["class"])
    match element.tag:
        case "math":
            sign = "$$" if element["display"] == "block" else "$"
            return sign + re.sub("[\u2061\u200b\u00a0\\s]", "", _letters(element)) + sign
        case "a":
            words = inner.strip()
            return f"[{words}]({_address(element['href'])}){_braced(element)}" if words else ""
        case "code":
            return f"`{_letters(element)}`"
        case "em" | "strong" | "sub" | "sup":
            mark = {"em": "*", "strong": "**", "sub": "~", "sup": "^"}[element.tag]
            return f"{mark}{inner}{mark}"
        case "br":
            return " / "
        case "span" | "output" if role:
            return f"{{{role[1]}}}{inner}"
        case "span" | "small" | "abbr" | "q" | "i" | "cite" | "time":
            return inner
        case tag if tag in FURNITURE:
            return ""
        case "label":
            return inner
        case tag:
            source = _address(element["src"])
            return f"<{tag}{f' {source}' if source else ''}{_attributes(element)}>{inner}"


def _braced(element: Element) -> str:
    shown = _attributes(element).strip()
    return f"{{{shown}}}" if shown else ""
