"""``{ray}`the ray```: words in the colour of their idea, as in the figures."""

from site_builder.markdown.headings import slug
from site_builder.markdown.parse_context import ParseContext
from site_builder.markdown.role import Linked, Role
from site_builder.markdown.text.math import COLOURS as NAMES
from site_builder.references.glossary import Term

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
