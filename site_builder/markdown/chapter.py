"""One Markdown file to one `Chapter`, in two steps: what all chapters refer to is known between."""

from collections.abc import Sequence
from dataclasses import dataclass

from markdown_it.token import Token

from site_builder.diagnostics.diagnostic import Diagnostics
from site_builder.document.book import Chapter
from site_builder.document.places import Formula, Need, Target
from site_builder.markdown.blocks import read_blocks
from site_builder.markdown.front_matter import FrontMatter, read_front_matter
from site_builder.markdown.glossary import mark_terms
from site_builder.markdown.inline import annotate, inline_passage
from site_builder.markdown.numbering import number_targets
from site_builder.markdown.parse_context import PAGE_IDS, ParseContext
from site_builder.markdown.questions.draws import set_aside
from site_builder.markdown.targets import Targets


@dataclass(frozen=True, slots=True)
class Draft:
    """A chapter that is parsed and numbered, its words not yet looked at."""

    tokens: Sequence[Token]
    matter: FrontMatter
    target: Target
    inside: tuple[Target, ...]
    context: ParseContext


def parse_chapter(text: str, context: ParseContext) -> Draft:
    """The chapter in ``text``; mistakes are reported and reading goes on."""
    tokens = context.shared.parser.parse(text, context.env)
    for line, message in context.env.pop("problems", ()):
        context.problem(line, message)
    for line, message in context.env.pop("doubts", ()):
        context.problems.warn(context.path, line, message)
    matter = read_front_matter(tokens, context)
    position, name = context.position, context.chapter
    target = Target(position.kind, name, "", position.mark, matter.title, 1, name=position.name)
    return Draft(tokens, matter, target, number_targets(tokens, name, context), context)


@dataclass(frozen=True, slots=True)
class Survey:
    """What other chapters may refer to in one."""

    path: str
    target: Target
    inside: tuple[Target, ...]


def survey(draft: Draft) -> Survey:
    return Survey(draft.context.path, draft.target, draft.inside)


def find_targets(surveys: Sequence[Survey], problems: Diagnostics) -> Targets:
    """What references may lead to. Two of one label in different chapters are reported."""
    first: dict[str, tuple[Target, str]] = {}
    for found in surveys:
        for target in found.inside:
            if not target.labelled:
                continue
            other, path = first.setdefault(target.id, (target, found.path))
            if other.chapter != target.chapter:
                message = f"duplicate label {target.id!r}; first used at {path}:{other.line}"
                problems.add(found.path, target.line, message)
    return Targets(
        {found.target.chapter: found.target for found in surveys},
        {found.target.chapter: found.inside for found in surveys},
    )


def read_chapter(draft: Draft, targets: Targets) -> Chapter:
    """The whole chapter; mistakes are reported and reading goes on."""
    context = draft.context
    context.targets = targets
    tokens = set_aside(draft.tokens)
    annotate(tokens, context)
    mark_terms(tokens, context)
    body = read_blocks(tokens, context)
    before = tuple(
        Need(inline_passage(entry.text, entry.line, context), entry.chapter, entry.line)
        for entry in draft.matter.before
    )
    after = tuple(inline_passage(entry.text, entry.line, context) for entry in draft.matter.after)
    return Chapter(
        position=context.position,
        id=context.chapter,
        path=context.path,
        title=draft.matter.title,
        summary=draft.matter.summary,
        body=body,
        headings=tuple(context.headings),
        anchors=frozenset(context.ids) - set(PAGE_IDS),
        links=tuple(context.links),
        citations=tuple(context.citations),
        term_uses=tuple(context.term_uses),
        index_marks=tuple(context.index_marks),
        files=frozenset(context.files),
        formulae=tuple(_formula(*found, draft) for found in context.formulae),
        before=before,
        after=after,
        figures=tuple(place.id for place in context.figures),
    )


def _formula(line: int, tex: str, displayed: bool, draft: Draft) -> Formula:
    above = [item.id for item in draft.inside if item.kind == "Section" and item.line <= line]
    return Formula(tex, line, above[-1] if above else "", displayed=displayed)
