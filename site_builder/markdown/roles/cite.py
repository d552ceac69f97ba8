"""``{cite}`zhang2000; hartley2004, §4.4```: the works behind a claim, linked to the references.

Works are parted by semicolons; what follows the key and a comma says where in the work. ``{cite}``
sets all in brackets, (Zhang 2000); ``{citet}`` makes the authors a part of the sentence, Zhang
(2000).
"""

from collections.abc import Callable, Iterator, Sequence

from markdown_it.token import Token

from site_builder.diagnostics import unknown
from site_builder.markdown.parse_context import ParseContext
from site_builder.markdown.role import Role
from site_builder.page_model.places import Citation
from site_builder.references.bibliography import Work

FORM = "KEY[, PLACE]; …"


def bracketed(words: str, line: int, context: ParseContext) -> Sequence[Token]:
    """``(Zhang 2000; Hartley and Zisserman 2004, §4.4)``."""

    def link(work: Work, place: str) -> Iterator[Token]:
        yield from _link(work, f"{work.who} {work.year}", line, context)
        yield from _text(f", {place}" if place else "")

    return [*_text("("), *_joined(words, link, line, context), *_text(")")]


def in_the_sentence(words: str, line: int, context: ParseContext) -> Sequence[Token]:
    """``Zhang (2000); Hartley and Zisserman (2004, §4.4)``."""

    def link(work: Work, place: str) -> Iterator[Token]:
        where = f", {place}" if place else ""
        yield from _link(work, f"{work.who} ({work.year}{where})", line, context)

    return _joined(words, link, line, context)


def _joined(
    words: str, link: Callable[[Work, str], Iterator[Token]], line: int, context: ParseContext
) -> list[Token]:
    tokens: list[Token] = []
    for part in words.split(";"):
        key, _, place = (piece.strip() for piece in part.partition(","))
        work = context.shared.bibliography.works.get(key)
        if work is None:
            context.problem(line, unknown("work", key, context.shared.bibliography.works))
            continue
        tokens += [*_text("; " if tokens else ""), *link(work, place)]
    return tokens


def _link(work: Work, words: str, line: int, context: ParseContext) -> Iterator[Token]:
    name = context.free_id(f"cite-{work.key}", line)
    context.citations.append(Citation(work.key, name))
    attributes: dict[str, str | int | float] = {
        "class": "citation",
        "id": name,
        "href": f"../references/#{work.key}",
        "title": work.told,
    }
    yield Token("link_open", "a", 1, attrs=attributes)
    yield from _text(words)
    yield Token("link_close", "a", -1)


def _text(words: str) -> Sequence[Token]:
    return [Token("text", "", 0, content=words)] if words else []


CITES = (
    Role(
        name="cite",
        form=FORM,
        doc="works of `content/references.bib` in brackets: (Zhang 2000)",
        inline=bracketed,
    ),
    Role(
        name="citet",
        form=FORM,
        doc="the same in the sentence: Zhang (2000)",
        inline=in_the_sentence,
    ),
)
"""The names are those of natbib's commands, as MyST and others have taken them up."""
