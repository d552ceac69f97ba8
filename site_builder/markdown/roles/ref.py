"""``{ref}`figure-lens-distortion```: a link with the name and number of its target.

A target is a chapter's id, an element's id, or ``CHAPTER#ID``. Without words of its own the link
is named after its target: “Chapter 4 (Lens Distortion)” at the first link of a page to that
chapter and “Chapter 4” after that, “Figure 4.2”, “Equation (4.7)”. In words before ``<TARGET>``,
``{name}``, ``{number}``, ``{title}`` and ``{chapter}`` are filled in.
"""

import re
from collections.abc import Mapping

from site_builder.diagnostics.diagnostic import unknown
from site_builder.document.places import Target
from site_builder.markdown.parse_context import ParseContext
from site_builder.markdown.role import Linked, Role

PLACEHOLDER = re.compile(r"\{(\w+)\}")


def reference(words: str, given: str | None, line: int, context: ParseContext) -> Linked:
    """The link; one without attributes, and a report, where it leads nowhere."""
    try:
        target = context.targets.find(words if given is None else given, context.chapter)
        chapter = context.targets.chapters[target.chapter]
        context.warn_of_count(target, line)
        if given is None:
            name = _name(target, chapter, context)
            return Linked(_attributes(target, chapter, context), lambda _: name)
        filled = _filled(words, target, chapter)
    except LookupError as error:
        context.problem(line, str(error.args[0]))
        return Linked({})
    return Linked(
        _attributes(target, chapter, context),
        lambda text: PLACEHOLDER.sub(lambda found: filled[found[1]], text),
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
        "number": target.number or chapter.number,
        "title": target.title,
        "chapter": chapter.name,
    }
    expected = {name: value for name, value in values.items() if value}
    for name in PLACEHOLDER.findall(words):
        if name not in expected:
            raise LookupError(unknown(f"part of a reference to {target.name}", name, expected))
    return expected


REF = Role(
    name="ref",
    form="TARGET` or `WORDS <TARGET>",
    doc="a link to a chapter, section, figure, equation, table, example or question, with its "
    "number; the words may say `{name}`, `{number}`, `{title}`, `{chapter}`",
    link=reference,
)
