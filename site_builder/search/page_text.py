"""What a finished page says, section by section, as the search sees it.

A page is read as its reader sees it at first: what waits for a guess or an answer is left out, and
so is what can only be pressed.
"""

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from html import unescape
from typing import NamedTuple

from site_builder.cache import cached
from site_builder.search.tags import INLINE, NEVER_CLOSED, Channel, channel_of, title_in

WORDS_A_MINUTE = 180
"""Of a text with formulae, read with care."""
UNREAD = re.compile(
    r"""(<(?:pre|script|nav)\b[^>]*>|<math\b[^>]*\bdisplay="block"[^>]*>).*?(?=</(?:pre|script|nav|math)>)""",
    re.DOTALL,
)
"""What is long, silent and never inside its like: left out before a page is taken apart."""
FORMULA = re.compile(r"<math([^>]*>)(.*?)(?=</math>)", re.DOTALL)
"""Of its many elements nothing is asked but their text, which is all that is then left."""
TAG = re.compile(r"<[^>]*>")
FOLDED = re.compile(r"<details(?![^>]*\bopen\b).*?</details>", re.DOTALL)
PART = re.compile(
    r"""([^<]+|<(?![/!a-zA-Z]))|<!--.*?-->|"""
    r"""<(/?[a-zA-Z][^\s/>]*(?:[^>"']++|"[^"]*"|'[^']*')*)>""",
    re.DOTALL,
)
"""Text, a comment, or the beginning or end of an element: `html.parser`, which reads what nobody
should write as well, takes four times as long for the pages that we write."""
HEAD = re.compile(r"(/?[^\s/]*)(.*)", re.DOTALL)
"""Name and attributes of what stands between ``<`` and ``>``."""
ATTRIBUTE = re.compile(r"""([^\s"'=/>]+)(?:\s*=\s*(?:"([^"]*)"|'([^']*)'|([^\s"'>]+)))?""")
UNHEARD = ("outside", "hidden")
SHOWN_AS: Mapping[Channel, Channel] = {"term": "text"}
"""What is introduced is text as well."""
LONGEST_FORMULA = 14
"""Characters of a formula in a line of text; a longer one becomes an ellipsis."""


@dataclass(frozen=True, slots=True)
class Section:
    """A heading and what stands below it, up to the next."""

    anchor: str
    """Element id of the heading; nothing for what stands before the first."""
    title: str
    terms: tuple[str, ...]
    """Words that are introduced here: set in bold, or defined."""
    text: str
    figures: str
    """Titles, descriptions and captions of figures."""
    questions: str
    """What is asked, never what is right."""


@dataclass(slots=True)
class _Draft:
    anchor: str = ""
    parts: dict[Channel, list[str]] = field(default_factory=dict)

    def add(self, channel: Channel, text: str) -> None:
        self.parts.setdefault(channel, []).append(text)

    @property
    def is_silent(self) -> bool:
        said = (*self.parts.get("title", ()), *self.parts.get("text", ()))
        return not any(part.strip() for part in said)

    def count_words(self) -> int:
        """Of title, text, figures and questions."""
        channels: tuple[Channel, ...] = ("title", "text", "figure", "question")
        return sum(len("".join(self.parts.get(channel, ())).split()) for channel in channels)

    def finished(self) -> Section:
        return Section(
            anchor=self.anchor,
            title=self._text("title"),
            terms=tuple(dict.fromkeys(self._terms())),
            text=self._text("text"),
            figures=self._text("figure"),
            questions=self._text("question"),
        )

    def _terms(self) -> Iterator[str]:
        return (" ".join(term.split()).rstrip(".,:;?") for term in self.parts.get("term", ()))

    def _text(self, channel: Channel) -> str:
        return " ".join("".join(self.parts.get(channel, ())).split())


@cached
def read_sections(html: str) -> tuple[Section, ...]:
    """The sections of a page's article, in order; those that say nothing are left out."""
    return _sections(html)


def _sections(html: str) -> tuple[Section, ...]:
    return tuple(draft.finished() for draft in _drafts(html))


def _drafts(html: str) -> Iterator[_Draft]:
    """Those that say something."""
    shown, reader = _shown(html), _Reader()
    body, read = _latest.get("body", ("", _Reader()))
    before, found, behind = shown.partition(body) if body else (shown, "", "")
    reader.read(before)
    if found and reader.is_in_text:
        reader.take(read)
    else:
        reader.read(found)
    reader.read(behind)
    return (draft for draft in reader.drafts if not draft.is_silent)


def _shown(html: str) -> str:
    """Without what is long and silent."""
    shown = UNREAD.sub(r"\1", html)
    if "<math" not in shown:
        return shown
    return FORMULA.sub(lambda found: f"<math{found[1]}{TAG.sub('', found[2])}", shown)


def reading_minutes(body: str) -> int:
    """How long an article's body takes to read: its text, captions and questions. What is folded
    is opened, and figures are played with, by those who like."""
    shown = _shown(FOLDED.sub("", body) if "<details" in body else body)
    reader = _Reader("text")
    reader.read(shown)
    if reader.is_whole:
        _latest["body"] = shown, reader
    said = sum(draft.count_words() for draft in reader.drafts if not draft.is_silent)
    return max(1, round(said / WORDS_A_MINUTE))


@dataclass(slots=True)
class _Reader:
    """Walks a page, or a part of one; each element hands its channel on to those inside."""

    around: Channel = "outside"
    """Of what stands around the part."""
    drafts: list[_Draft] = field(default_factory=lambda: [_Draft()])
    _open: list["_Opened"] = field(default_factory=list)
    _started: list[int] = field(default_factory=list)
    """Where the text of each of these starts in what was read before."""
    _words: list[str] = field(default_factory=list)
    """All that was read, whatever its channel: bold words and formulae are taken from here."""
    _formulae: int = 0
    """Of those that are open."""
    _astray: bool = False
    """Whether something ended that had not begun."""

    @property
    def is_whole(self) -> bool:
        """Whether all has ended that began, and the other way round: then it is read the same
        wherever it stands in a text."""
        return not self._open and not self._astray

    @property
    def is_in_text(self) -> bool:
        return bool(self._open) and self._open[-1].channel == "text" and not self._formulae

    def take(self, part: "_Reader") -> None:
        """What another has read, as if it stood here."""
        first, *others = part.drafts
        for channel, said in first.parts.items():
            self.drafts[-1].parts.setdefault(channel, []).extend(said)
        for draft in others:
            parts = {channel: [*said] for channel, said in draft.parts.items()}
            self.drafts.append(_Draft(draft.anchor, parts))

    def read(self, html: str) -> None:
        opened, words, formulae = self._open, self._words, self._formulae
        channel = opened[-1].channel if opened else self.around
        add = self.drafts[-1].add
        for head, text in _pieces(html):
            if head:
                tag = _tag(head, channel)
                if element := tag.opened:
                    if element.section is not None:
                        self.drafts.append(_Draft(element.section))
                        add = self.drafts[-1].add
                    if element.said:
                        add("figure", element.said)
                    if tag.name not in NEVER_CLOSED:
                        opened.append(element)
                        self._started.append(len(words))
                        channel = element.channel
                        formulae += tag.name == "math"
                if tag.ends:
                    if any(element.tag == tag.name for element in reversed(opened)):
                        channel, closed = self._close(tag.name)
                        formulae -= closed
                    elif not tag.opened:
                        self._astray = True
            if text and channel not in UNHEARD:
                said = unescape(text) if "&" in text else text
                words.append(said)
                if not formulae:
                    add(SHOWN_AS.get(channel, channel), said)
        self._formulae = formulae

    def _close(self, tag: str) -> tuple[Channel, int]:
        """End the innermost of that name with all inside it; the channel around it, and how many
        of these were formulae."""
        formulae = 0
        while True:
            element, start = self._open.pop(), self._started.pop()
            formulae += element.tag == "math"
            around = self._open[-1].channel if self._open else self.around
            if said := _said_at_end(element, self._words, start, around):
                self.drafts[-1].add(*said)
            if element.tag == tag:
                return around, formulae


_latest: dict[str, tuple[str, _Reader]] = {}
"""The article's body that was read last: its page is, next."""


def _pieces(html: str) -> Iterable[tuple[str, str]]:
    """What stands between ``<`` and ``>``, and the text behind it, in turn. Pages as we write them
    are cut at these two; in others, such as those with comments, every letter is looked at."""
    first, *rest = html.split("<")
    found = [("", first)]
    for piece in rest:
        head, end, text = piece.partition(">")
        quoted = '"' in head and head.count('"') % 2
        if not end or quoted or "='" in head or not (head[:1].isalpha() or head[:1] == "/"):
            return _careful_pieces(html)
        found.append((head, text))
    return found


def _careful_pieces(html: str) -> Iterator[tuple[str, str]]:
    for text, head in PART.findall(html):
        if text or head:
            yield head, text


def _said_at_end(
    element: "_Opened", words: Sequence[str], start: int, around: Channel
) -> tuple[Channel, str] | None:
    """What the end of an element adds to a section; ``words`` are its own from ``start`` on."""
    channel = element.channel
    if element.ends_word:
        return channel, " "
    if channel == "term" and around != "term":
        return "term", "".join(words[start:])
    if element.tag == "math" and channel != "hidden":
        formula = "".join("".join(words[start:]).split())
        shown = formula if len(formula) <= LONGEST_FORMULA else "…"
        return SHOWN_AS.get(channel, channel), shown
    return None


class _Opened(NamedTuple):
    """An element, and what its beginning does."""

    tag: str
    channel: Channel
    section: str | None
    """Id of the section that it begins."""
    said: str
    """What its attributes say of a figure."""
    ends_word: bool
    """Whether its end ends a word."""


class _Tag(NamedTuple):
    """The beginning of an element, its end, or both."""

    name: str
    opened: _Opened | None
    ends: bool


@lru_cache(maxsize=4096)
def _tag(head: str, outer: Channel) -> _Tag:
    """What stands between ``<`` and ``>``, inside an element whose text is ``outer``."""
    name, written = HEAD.match(head).groups()  # type: ignore[union-attr]  # it matches anything
    if name.startswith("/"):
        return _Tag(name[1:].lower(), None, ends=True)
    tag = name.lower()
    return _Tag(tag, _opened(tag, written, outer), ends=written.endswith("/"))


def _opened(tag: str, written: str, outer: Channel) -> _Opened:
    attributes = {
        name.lower(): unescape(quoted or single or bare)
        for name, quoted, single, bare in ATTRIBUTE.findall(written)
    }
    channel = channel_of(tag, attributes, outer)
    begins = channel == "title" and outer != "title" and tag != "h1"
    title = title_in(tag, attributes, outer)
    said = f"{title.rstrip('.')}. " if title else ""
    section = attributes.get("id", "") if begins else None
    ends_word = tag not in INLINE and channel in ("text", "figure", "question")
    return _Opened(tag, channel, section, said, ends_word)
