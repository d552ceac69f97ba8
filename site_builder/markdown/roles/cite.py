"""``{cite}`zhang2000; hartley2004, §4.4```: the works behind a claim, linked to the references.

Works are parted by semicolons; what follows the key and a comma says where in the work. ``{cite}``
sets all in brackets, (Zhang 2000); ``{citet}`` makes the authors a part of the sentence, Zhang
(2000).
"""

from collections.abc import Iterator, Sequence
from functools import partial

from markdown_it.token import Token

from site_builder.diagnostics.diagnostic import unknown
from site_builder.document.places import Citation
from site_builder.markdown.parse_context import ParseContext
from site_builder.markdown.role import Role
from site_builder.references.bibliography import Work

FORM = "KEY[, PLACE]; …"


def cited(
    words: str, line: int, context: ParseContext, *, in_sentence: bool = False
) -> Sequence[Token]:
    """``(Zhang 2000; Hartley and Zisserman 2004, §4.4)``; ``Zhang (2000)`` ``in_sentence``."""
    works = context.shared.bibliography.works
    tokens: list[Token] = []
    for part in words.split(";"):
        key, _, place = (piece.strip() for piece in part.partition(","))
        if key not in works:
            context.problem(line, unknown("work", key, works))
            continue
        who, year, where = works[key].who, works[key].year, f", {place}" if place else ""
        tokens.append(_text("; " if tokens else ""))
        if in_sentence:
            tokens += _link(works[key], f"{who} ({year}{where})", line, context)
        else:
            tokens += [*_link(works[key], f"{who} {year}", line, context), _text(where)]
    return tokens if in_sentence else [_text("("), *tokens, _text(")")]


def _link(work: Work, words: str, line: int, context: ParseContext) -> Iterator[Token]:
    name = context.free_id(f"cite-{work.key}", line)
    context.citations.append(Citation(work.key, name))
    attributes: dict[str, str | int | float] = {
        "class": "citation",
        "id": name,
        "href": f"../references/#{work.key}",
        "title": work.reference,
    }
    yield Token("link_open", "a", 1, attrs=attributes)
    yield _text(words)
    yield Token("link_close", "a", -1)


def _text(words: str) -> Token:
    return Token("text", "", 0, content=words)


CITES = (
    Role(
        name="cite",
        form=FORM,
        doc="works of `content/references.bib` in brackets: (Zhang 2000)",
        inline=cited,
    ),
    Role(
        name="citet",
        form=FORM,
        doc="the same in the sentence: Zhang (2000)",
        inline=partial(cited, in_sentence=True),
    ),
)
"""The names are those of natbib's commands, as MyST and others have taken them up."""
