"""The lines between ``---`` at the top of a chapter: its title and its summary, what to know before
it, and what one can do after it."""

import re
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass

import yaml
from markdown_it.token import Token

from site_builder.diagnostics import unknown
from site_builder.markdown.parse_context import ParseContext

TEXTS = ("title", "summary")
"""Required."""
LISTS = ("before", "after")
KEYS = (*TEXTS, *LISTS)
OUTCOMES = range(2, 5)
"""How many things a reader can do after a chapter."""
KINDS = {
    "int": "a number", "float": "a number", "bool": "a yes or no", "timestamp": "a date",
    "null": "empty", "seq": "a list", "map": "a mapping",
}  # fmt: skip
MARKUP = re.compile(r"\*[^*\s][^*]*\*|`[^`]+`|\$[^$\s][^$]*\$|\]\([^)]*\)|</?\w[^>]*>")
REASONS = (
    ("mapping values are not allowed", "a second ': ' in a line; legal: quotes around the text"),
    ("could not find expected ':'", "a line without ':'; legal: 'name: text'"),
    ("found character '\\t'", "a tab; legal: spaces"),
    ("that cannot start any token", "a text that begins with a mark; legal: quotes around it"),
    ("unexpected end of stream", "a quotation mark is never closed; legal: a second one"),
    ("expected ',' or", "a bracket is never closed; legal: quotes around a text that begins so"),
    ("expected <block end>", "a line out of place; legal: 'name: text' at the margin, or '- text'"),
    ("unknown escape", "a backslash between double quotes; legal: single quotes"),
    ("undefined alias", "a text that begins with '*'; legal: quotes around it"),
    ("expected alphabetic or numeric", "a text that begins with a mark; legal: quotes around it"),
    ("expected a single document", "a second '---'; legal: one above and one below"),
)
"""What the parser says, in part, and what its author did."""
TAKEN_OTHERWISE = re.compile(r"[\t\ufeff]|(?:^|[\s\[{,-])\?")
"""Where libyaml and PyYAML differ: tabs, byte order marks, and keys that begin with ``?``."""
LEGAL = "legal: '---', 'title: …', 'summary: …', '---'"
BEFORE = "legal: a list of texts, each alone or as 'chapter-id: what of it'"
AFTER = f"legal: a list of {OUTCOMES[0]} to {OUTCOMES[-1]} texts"


@dataclass(frozen=True, slots=True)
class Entry:
    """One entry of a list, as its author wrote it."""

    text: str
    line: int
    chapter: str = ""
    """Id before the colon, where there is one."""


@dataclass(frozen=True, slots=True)
class FrontMatter:
    """What a chapter says of itself; empty where that is missing or wrong, which is reported."""

    title: str = ""
    summary: str = ""
    before: tuple[Entry, ...] = ()
    after: tuple[Entry, ...] = ()


def read_front_matter(tokens: Sequence[Token], context: ParseContext) -> FrontMatter:
    """What stands in the first of ``tokens``."""
    if not tokens or tokens[0].type != "front_matter":
        context.problem(1, f"no front matter; {LEGAL}")
        return FrontMatter()
    try:
        root = _composed(tokens[0].content)
    except yaml.YAMLError as error:
        mark = getattr(error, "problem_mark", None)  # a character that YAML forbids has none
        context.problem(mark.line + 2 if mark else 1, f"malformed YAML: {_reason(error)}")
        return FrontMatter()
    if not isinstance(root, yaml.MappingNode):
        context.problem(1, f"front matter is no mapping; {LEGAL}")
        return FrontMatter()
    entries = _read_entries(root, context)
    return FrontMatter(
        **_read_texts(entries, context),
        before=_read_before(entries.get("before"), context),
        after=_read_after(entries.get("after"), context),
    )


def _composed(text: str) -> yaml.Node | None:
    """Read by libyaml, where PyYAML has it, in a fifth of the time. Of what that refuses, or might
    take otherwise, PyYAML's own reader is asked: it tells better what is wrong, and where. Raises
    `yaml.YAMLError`."""
    if yaml.__with_libyaml__ and not TAKEN_OTHERWISE.search(text):
        with suppress(yaml.YAMLError):
            return yaml.compose(text, Loader=yaml.CSafeLoader)
    return yaml.compose(text, Loader=yaml.SafeLoader)


def _reason(error: yaml.YAMLError) -> str:
    """In our words, where we have some."""
    said = getattr(error, "problem", None) or str(error).partition("\n")[0]
    return next((ours for theirs, ours in REASONS if theirs in said), said)


def _read_entries(root: yaml.MappingNode, context: ParseContext) -> dict[str, yaml.Node]:
    entries: dict[str, yaml.Node] = {}
    for key, value in root.value:
        if key.value not in KEYS:
            context.problem(_line(key), unknown("front matter key", str(key.value), KEYS))
            continue
        if key.value in entries:
            context.problem(_line(key), f"{key.value!r} is given twice; legal: once")
        entries[key.value] = value
    return entries


def _read_texts(entries: Mapping[str, yaml.Node], context: ParseContext) -> dict[str, str]:
    texts = {name: _text(entries.get(name)) for name in TEXTS}
    for name, text in texts.items():
        node = entries.get(name)
        line = _line(node) if node else 1
        if not text:
            given = _kind(node)
            said = f"{name!r} is {given}" if given else f"front matter without {name!r}"
            expected = f'{name}: "{node.value}"' if node and _is_scalar(node) else f"'{name}: text'"
            context.problem(line, f"{said}; legal: {expected}")
        elif found := MARKUP.search(text):
            context.problem(
                line,
                f"{found[0]!r} in {name!r}, which is shown as it stands; "
                "legal: words without marks",
            )
    return texts


def _read_before(node: yaml.Node | None, context: ParseContext) -> tuple[Entry, ...]:
    if node is None:
        return ()
    found = tuple(_needs(node))
    if not found or not all(entry.text for entry in found):
        context.problem(_line(node), f"what to know 'before' is not told; {BEFORE}")
    return found


def _needs(node: yaml.Node) -> Iterator[Entry]:
    for item in node.value if isinstance(node, yaml.SequenceNode) else ():
        if isinstance(item, yaml.MappingNode):
            for key, value in item.value:
                yield Entry(_text(value), _line(key), chapter=str(key.value))
        else:
            yield Entry(_text(item), _line(item))


def _read_after(node: yaml.Node | None, context: ParseContext) -> tuple[Entry, ...]:
    if node is None:
        return ()
    items = node.value if isinstance(node, yaml.SequenceNode) else ()
    found = tuple(Entry(_text(item), _line(item)) for item in items)
    if len(found) not in OUTCOMES or not all(entry.text for entry in found):
        context.problem(_line(node), f"what one can do 'after' is not told; {AFTER}")
    return found


def _text(node: yaml.Node | None) -> str:
    """The text of a node; nothing where it is none."""
    return node.value.strip() if node and node.tag == "tag:yaml.org,2002:str" else ""


def _kind(node: yaml.Node | None) -> str:
    """What YAML takes a node for that is no text; nothing of what is one, or is not there."""
    return KINDS.get(node.tag.rpartition(":")[2], "") if node else ""


def _is_scalar(node: yaml.Node | None) -> bool:
    return isinstance(node, yaml.ScalarNode) and bool(node.value)


def _line(node: yaml.Node) -> int:
    """Below the ``---``, and counted from 1."""
    line: int = node.start_mark.line
    return line + 2
