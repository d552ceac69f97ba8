"""The lines between ``---`` at the top of a chapter: its title and its summary, what to know before
it, and what one can do after it."""

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import yaml
from markdown_it.token import Token

from site_builder.diagnostics.diagnostic import unknown
from site_builder.markdown.parse_context import ParseContext

TEXTS = ("title", "summary")
"""Required."""
KEYS = (*TEXTS, "before", "after")
OUTCOMES = range(2, 5)
"""How many things a reader can do after a chapter."""
MARKUP = re.compile(r"\*[^*\s][^*]*\*|`[^`]+`|\$[^$\s][^$]*\$|\]\([^)]*\)|</?\w[^>]*>")
LEGAL = "legal: '---', 'title: …', 'summary: …', '---'"
YAML = "legal: lines 'name: text', with quotes around a text that holds ': ' or begins with a mark"
BEFORE = "a list of texts, each alone or as 'chapter-id: what of it'"
AFTER = f"a list of {OUTCOMES[0]} to {OUTCOMES[-1]} texts"


@dataclass(frozen=True, slots=True)
class Entry:
    """One entry of a list, as its author wrote it."""

    text: str
    line: int
    chapter: str = ""
    """Id before the colon, where there is one."""


@dataclass(frozen=True, slots=True)
class FrontMatter:
    """A chapter's own description; empty where it is missing or wrong, which is reported."""

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
        root = yaml.compose(tokens[0].content, Loader=yaml.SafeLoader)
    except yaml.YAMLError as error:
        mark = getattr(error, "problem_mark", None)  # a character that YAML forbids has none
        reason = getattr(error, "problem", None) or str(error).partition("\n")[0]
        context.problem(mark.line + 2 if mark else 1, f"malformed YAML: {reason}; {YAML}")
        return FrontMatter()
    if not isinstance(root, yaml.MappingNode):
        context.problem(1, f"front matter is no mapping; {LEGAL}")
        return FrontMatter()
    nodes = _by_key(root, context)
    before, after = (tuple(_entries(nodes.get(name))) for name in ("before", "after"))
    texts_alone = all(entry.text and not entry.chapter for entry in after)
    for name, is_legal, expected in (
        ("before", before and all(entry.text for entry in before), BEFORE),
        ("after", len(after) in OUTCOMES and texts_alone, AFTER),
    ):
        if name in nodes and not is_legal:
            context.problem(_line(nodes[name]), f"malformed {name!r}; legal: {expected}")
    texts = {name: _read_text(name, nodes.get(name), context) for name in TEXTS}
    return FrontMatter(**texts, before=before, after=after)


def _by_key(root: yaml.MappingNode, context: ParseContext) -> dict[str, yaml.Node]:
    nodes: dict[str, yaml.Node] = {}
    for key, value in root.value:
        if key.value not in KEYS:
            context.problem(_line(key), unknown("front matter key", str(key.value), KEYS))
            continue
        if key.value in nodes:
            context.problem(_line(key), f"{key.value!r} is given twice; legal: once")
        nodes[key.value] = value
    return nodes


def _read_text(name: str, node: yaml.Node | None, context: ParseContext) -> str:
    text, line = _text(node), _line(node) if node else 1
    if not text:
        fault = f"{name!r} is no text" if node else f"front matter without {name!r}"
        value = node.value if isinstance(node, yaml.ScalarNode) else ""
        context.problem(line, f'{fault}; legal: {name}: "{value or "some text"}"')
    elif found := MARKUP.search(text):
        fault = f"{found[0]!r} in {name!r}, which is shown as it stands"
        context.problem(line, f"{fault}; legal: words without marks")
    return text


def _entries(node: yaml.Node | None) -> Iterator[Entry]:
    for item in node.value if isinstance(node, yaml.SequenceNode) else ():
        if isinstance(item, yaml.MappingNode):
            for key, value in item.value:
                yield Entry(_text(value), _line(key), chapter=str(key.value))
        else:
            yield Entry(_text(item), _line(item))


def _text(node: yaml.Node | None) -> str:
    """The text of a node; nothing where it is none."""
    return node.value.strip() if node and node.tag == "tag:yaml.org,2002:str" else ""


def _line(node: yaml.Node) -> int:
    """Below the ``---``, and counted from 1."""
    line: int = node.start_mark.line
    return line + 2
