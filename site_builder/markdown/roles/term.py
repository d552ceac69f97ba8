"""``{term}`two stops <stop>```: a term of the glossary that is not found by its words, or a
second use to be marked. ``{term}`the stop sign <none>```: words that are no term.
"""

from site_builder.markdown.parse_context import ParseContext
from site_builder.markdown.role import Linked, Role
from site_builder.references.glossary import Term

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
