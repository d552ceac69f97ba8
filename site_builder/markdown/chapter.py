"""One Markdown file to one `Chapter`, in two steps: what all chapters refer to is known between.

The lines between ``---`` at its top have its title and its summary, what to know before it, and
what one can do after it.
"""

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import yaml
from markdown_it.token import Token

from site_builder.diagnostics.diagnostic import Diagnostics, nearest, unknown
from site_builder.document.book import Chapter
from site_builder.document.places import Formula, Need, Reference, Target, Targets
from site_builder.files.text import CONTROL, control_character_message
from site_builder.markdown.annotation import annotate, inline_passage
from site_builder.markdown.block_tree import read_page
from site_builder.markdown.glossary import mark_terms
from site_builder.markdown.numbering import number_targets
from site_builder.markdown.parse_context import PAGE_IDS, ParseContext

TEXTS = ("title", "summary")
"""Required."""
KEYS = (*TEXTS, "before", "after")
OUTCOMES = range(2, 5)
"""How many things a reader can do after a chapter."""
MARKUP = re.compile(r"\*[^*\s][^*]*\*|`[^`]+`|\$[^$\s][^$]*\$|\]\([^)]*\)|</?\w[^>]*>")
LEGAL_MATTER = "legal: '---', 'title: …', 'summary: …', '---'"
YAML = "legal: lines 'name: text', with quotes around a text that holds ': ' or begins with a mark"
BEFORE = "a list of texts, each alone or as 'chapter-id: what of it'"
AFTER = f"a list of {OUTCOMES[0]} to {OUTCOMES[-1]} texts"


@dataclass(frozen=True, slots=True)
class ListEntry:
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
    before: tuple[ListEntry, ...] = ()
    after: tuple[ListEntry, ...] = ()


def read_front_matter(tokens: Sequence[Token], context: ParseContext) -> FrontMatter:
    """What stands in the first of ``tokens``."""
    if not tokens or tokens[0].type != "front_matter":
        is_open = bool(tokens) and tokens[0].type == "hr" and tokens[0].map == [0, 1]
        what = "front matter without an end" if is_open else "no front matter"
        own = ("unknown target", "is cited nowhere", f"unknown anchor in {context.path}")
        spoils = () if tokens else own
        context.problems.add(context.path, 1, f"{what}; {LEGAL_MATTER}", spoils=spoils)
        return FrontMatter()
    try:
        root = yaml.compose(tokens[0].content, Loader=yaml.SafeLoader)
    except (yaml.YAMLError, RecursionError) as error:
        mark = getattr(error, "problem_mark", None)  # a character that YAML forbids has none
        reason = getattr(error, "problem", None) or str(error).partition("\n")[0]
        context.problem(mark.line + 2 if mark else 1, f"malformed YAML: {reason}; {YAML}")
        return FrontMatter()
    if not isinstance(root, yaml.MappingNode):
        context.problem(1, f"front matter is no mapping; {LEGAL_MATTER}")
        return FrontMatter()
    nodes = _by_key(root, context)
    before, after = (tuple(_entries(nodes.get(name))) for name in ("before", "after"))
    texts_alone = all(entry.text and not entry.chapter for entry in after)
    for name, is_legal, expected in (
        ("before", before and all(entry.text for entry in before), BEFORE),
        ("after", len(after) in OUTCOMES and texts_alone, AFTER),
    ):
        if name in nodes and not is_legal:
            context.problem(_line_of(nodes[name]), f"malformed {name!r}; legal: {expected}")
    texts = {name: _read_text(name, nodes.get(name), context) for name in TEXTS}
    return FrontMatter(**texts, before=before, after=after)


def _by_key(root: yaml.MappingNode, context: ParseContext) -> dict[str, yaml.Node]:
    nodes: dict[str, yaml.Node] = {}
    for key, value in root.value:
        if key.value not in KEYS:
            message = unknown("front matter key", str(key.value), KEYS)
            spoils = (f"front matter without {nearest(str(key.value), KEYS)!r}",)
            context.problem(_line_of(key), message, spoils=spoils)
            continue
        if key.value in nodes:
            context.problem(_line_of(key), f"{key.value!r} is given twice; legal: once")
        nodes[key.value] = value
    return nodes


def _read_text(name: str, node: yaml.Node | None, context: ParseContext) -> str:
    text, line = _text(node), _line_of(node) if node else 1
    if not text:
        fault = f"{name!r} is no text" if node else f"front matter without {name!r}"
        value = node.value if isinstance(node, yaml.ScalarNode) else ""
        context.problem(line, f'{fault}; legal: {name}: "{value or "some text"}"')
    elif found := CONTROL.search(text):  # written as an escape
        context.problem(line, control_character_message(found[0]))
        text = ""
    elif found := MARKUP.search(text):
        fault = f"{found[0]!r} in {name!r}, which is shown as it stands"
        context.problem(line, f"{fault}; legal: words without marks")
    return text


def _entries(node: yaml.Node | None) -> Iterator[ListEntry]:
    for item in node.value if isinstance(node, yaml.SequenceNode) else ():
        if isinstance(item, yaml.MappingNode):
            for key, value in item.value:
                yield ListEntry(_text(value), _line_of(key), chapter=str(key.value))
        else:
            yield ListEntry(_text(item), _line_of(item))


def _text(node: yaml.Node | None) -> str:
    """The text of a node; nothing where it is none."""
    return node.value.strip() if node and node.tag == "tag:yaml.org,2002:str" else ""


def _line_of(node: yaml.Node) -> int:
    """Below the ``---``, and counted from 1."""
    line: int = node.start_mark.line
    return line + 2


@dataclass(frozen=True, slots=True)
class ParsedChapter:
    """A chapter with its tokens and numbers, before roles and directives are read."""

    tokens: Sequence[Token]
    matter: FrontMatter
    target: Target
    inside: tuple[Target, ...]
    context: ParseContext


def parse_chapter(text: str, context: ParseContext) -> ParsedChapter:
    """The chapter in ``text``; mistakes are reported and reading goes on."""
    tokens = context.shared.parser.parse(text, context.env)
    for line, message, *spoils in context.env.pop("problems", ()):
        context.problem(line, message, spoils=tuple(spoils))
    for line, message in context.env.pop("doubts", ()):
        context.problems.warn(context.path, line, message)
    matter = read_front_matter(tokens, context)
    position, name = context.position, context.chapter
    target = Target(
        kind=position.kind,
        chapter=name,
        id="",
        number=position.mark,
        title=matter.title,
        line=1,
        name=position.name,
    )
    return ParsedChapter(tokens, matter, target, number_targets(tokens, name, context), context)


@dataclass(frozen=True, slots=True)
class ChapterTargets:
    """The targets of one chapter: all that other chapters may refer to."""

    path: str
    target: Target
    inside: tuple[Target, ...]


def chapter_targets(parsed: ParsedChapter) -> ChapterTargets:
    """The targets that numbering found."""
    return ChapterTargets(parsed.context.path, parsed.target, parsed.inside)


def find_targets(chapters: Sequence[ChapterTargets], problems: Diagnostics) -> Targets:
    """What references may lead to. Two of one label in different chapters are reported."""
    first: dict[str, tuple[Target, str]] = {}
    for found in chapters:
        for target in found.inside:
            if not target.labelled:
                continue
            other, path = first.setdefault(target.id, (target, found.path))
            if other.chapter != target.chapter:
                message = f"duplicate label {target.id!r}; first used at {path}:{other.line}"
                problems.add(found.path, target.line, message)
    return Targets(
        {found.target.chapter: found.target for found in chapters},
        {found.target.chapter: found.inside for found in chapters},
    )


def read_chapter(parsed: ParsedChapter, targets: Targets) -> Chapter:
    """The whole chapter; mistakes are reported and reading goes on."""
    context = parsed.context
    context.targets = targets
    annotate(parsed.tokens, context)
    mark_terms(parsed.tokens, context)
    body = read_page(parsed.tokens, context)
    before = tuple(
        Need(inline_passage(entry.text, entry.line, context), entry.chapter, entry.line)
        for entry in parsed.matter.before
    )
    after = tuple(inline_passage(entry.text, entry.line, context) for entry in parsed.matter.after)
    return Chapter(
        position=context.position,
        id=context.chapter,
        path=context.path,
        title=parsed.matter.title,
        summary=parsed.matter.summary,
        body=body,
        headings=tuple(context.headings),
        anchors=frozenset(context.ids) - set(PAGE_IDS),
        links=tuple(context.links),
        citations=tuple(context.citations),
        term_uses=tuple(context.term_uses),
        references=tuple(
            Reference(target, _section_at(line, parsed), line)
            for target, line in context.references
        ),
        index_marks=tuple(context.index_marks),
        formulae=tuple(
            Formula(tex, line, _section_at(line, parsed), displayed=displayed)
            for line, tex, displayed in context.formulae
        ),
        before=before,
        after=after,
        figures=tuple(place.id for place in context.figures),
    )


def _section_at(line: int, parsed: ParsedChapter) -> str:
    """Element id of the heading above a line; nothing before the first."""
    above = [item.id for item in parsed.inside if item.kind == "Section" and item.line <= line]
    return above[-1] if above else ""
