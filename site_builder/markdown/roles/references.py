"""``{cite}`zhang2000; hartley2004, §4.4```: the works behind a claim, linked to the references;
``{ref}``, ``{term}`` and ``{index}``; and ``{ray}`the ray```: words in the colour of their idea.

Works are parted by semicolons, or by commas; what follows the key and a comma and is no key says
where in the work. ``{cite}`` sets all in brackets, (Zhang 2000); ``{citet}`` makes the authors a
part of the sentence, Zhang (2000).
"""

import re
from collections.abc import Iterator, Mapping, Sequence
from functools import partial

from markdown_it.token import Token

from site_builder.diagnostics.diagnostic import nearest, unknown
from site_builder.document.places import Citation, Target
from site_builder.formulae.temml import COLOURS as NAMES
from site_builder.markdown.numbering import slug
from site_builder.markdown.parse_context import ParseContext
from site_builder.markdown.role import Linked, Role
from site_builder.references.bibliography import Work, Works
from site_builder.references.terms import Term

FORM = "KEY[, PLACE]; …"


def cited(
    words: str, line: int, context: ParseContext, *, in_sentence: bool = False
) -> Sequence[Token]:
    """``(Zhang 2000; Hartley and Zisserman 2004, §4.4)``; ``Zhang (2000)`` ``in_sentence``."""
    works = context.shared.bibliography
    tokens: list[Token] = []
    for key, place in _keys(words, works):
        if key not in works:
            meant = nearest(key, works)
            spoils = (f"work {meant!r} is cited nowhere" if meant else "is cited nowhere",)
            context.problem(line, unknown("work", key, works), spoils=spoils)
            continue
        who, year, where = works[key].who, works[key].year, f", {place}" if place else ""
        tokens.append(_text("; " if tokens else ""))
        if in_sentence:
            tokens += _link(works[key], f"{who} ({year}{where})", line, context)
        else:
            tokens += [*_link(works[key], f"{who} {year}", line, context), _text(where)]
    return tokens if in_sentence else [_text("("), *tokens, _text(")")]


KEY = re.compile(r"(?!(?:pp?|figs?|eqs?|secs?|chaps?|nos?|vols?)\b)[A-Za-z][\w:+-]*\d{2}[a-z]*")
"""What a key looks like, and no place in a work."""


def _keys(words: str, works: Works) -> Iterator[tuple[str, str]]:
    """Each key with what is said of a place in its work."""
    for part in words.split(";"):
        key, *others = (piece.strip() for piece in part.split(","))
        places: list[str] = []
        for other in others:
            if other in works or KEY.fullmatch(other) or nearest(other, works, 0.8):
                yield key, ", ".join(places)
                key, places = other, []
            else:
                places.append(other)
        yield key, ", ".join(places)


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


PLACEHOLDER = re.compile(r"\{(\w+)\}|%s")
"""``%s``, as Sphinx has it, is the number that the target has itself."""


def reference(words: str, given: str | None, line: int, context: ParseContext) -> Linked:
    """The link; one without attributes, and a report, where it leads nowhere."""
    try:
        target = context.targets.find(words if given is None else given, context.chapter)
        chapter = context.targets.chapters[target.chapter]
        context.warn_of_count(target, line)
        context.references.append((target, line))
        if given is None:
            name = _name(target, chapter, context)
            return Linked(_attributes(target, chapter, context), lambda _: name)
        filled = _filled(words, target, chapter)
    except LookupError as error:
        context.problem(line, str(error.args[0]))
        return Linked({})
    return Linked(
        _attributes(target, chapter, context),
        lambda text: PLACEHOLDER.sub(lambda found: filled[found[1] or "%s"], text),
    )


def _attributes(target: Target, chapter: Target, context: ParseContext) -> dict[str, str]:
    here = target.chapter == context.chapter
    page = "" if here else f"../{target.chapter}/"
    fragment = f"#{target.id or 'main'}" if here or target.id else ""
    title = {} if here else {"title": f"{chapter.name}: {chapter.title}"}
    return {"class": "reference", "href": page + fragment, **title}


def _name(target: Target, chapter: Target, context: ParseContext) -> str:
    """The words of the link; the first to a chapter has its title."""
    here = target.chapter == context.chapter
    if target.kind == "Section":
        elsewhere = {"title": target.title, "chapter": chapter.name}
        return (
            target.name if here else context.shared.words("labels.section_elsewhere", **elsewhere)
        )
    if target is chapter and not here and target.chapter not in context.introduced:
        context.introduced.add(target.chapter)
        return f"{target.name} ({target.title})"
    return target.name


def _filled(words: str, target: Target, chapter: Target) -> Mapping[str, str]:
    """What stands for each placeholder. Raises `LookupError`."""
    values = {
        "name": target.name,
        "%s": target.number,
        "number": target.number or chapter.number,
        "title": target.title,
        "chapter": chapter.name,
    }
    expected = {name: value for name, value in values.items() if value}
    for found in PLACEHOLDER.finditer(words):
        name = found[1] or "%s"
        if name not in expected:
            legal = [f"{{{name}}}" for name in expected if name != "%s"]
            kind = f"part of a reference to {target.name}"
            raise LookupError(unknown(kind, found[0], legal))
    return expected


REF = Role(
    name="ref",
    form="TARGET` or `WORDS <TARGET>",
    doc="a link to a chapter, section, figure, equation, table, example or question, with its "
    "number; the words may say `{name}`, `{number}`, `{title}`, `{chapter}`",
    link=reference,
)


COLOURS = tuple(
    Role(name=name, form="words", doc="the words in the colour of their idea, as in the figures")
    for name in NAMES
)
"""One for each colour that a formula may name with ``\\role``."""


def indexed(words: str, given: str | None, line: int, context: ParseContext) -> Linked:
    """The words with an id, and the entry to list them under."""
    entry = words if given is None else given
    name = context.free_id(f"index-{slug(entry)}", line)
    return Linked({"id": name}, meta={"index": entry})


INDEX = Role(
    name="index",
    form="WORDS` or `WORDS <ENTRY>",
    doc="the words, listed in the index of terms",
    link=indexed,
)


NONE = "none"


def marked(words: str, given: str | None, line: int, context: ParseContext) -> Linked:
    """The link; one without attributes where no term is meant, or, with a report, where there is
    none of that name."""
    if given == NONE:
        return Linked({})
    try:
        term = context.shared.glossary.find(words if given is None else given)
    except LookupError as error:
        context.problem(line, str(error.args[0]))
        return Linked({})
    return Linked(term_link(term, line, context), meta={"term": term})


def term_link(term: Term, line: int, context: ParseContext) -> dict[str, str]:
    """Attributes of a link to the glossary."""
    return {
        "class": "term",
        "id": context.free_id(f"term-{term.id}", line),
        "href": f"../glossary/#{term.id}",
        "aria-describedby": f"definition-{term.id}",
    }


TERM = Role(
    name="term",
    form="WORDS` or `WORDS <TERM>` or `WORDS <none>",
    doc="a link to the glossary where none is made by itself; with `none`, no link",
    link=marked,
)
