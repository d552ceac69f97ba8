"""The glossary's definitions, set as the text of the chapters is."""

from site_builder.book import Definition
from site_builder.glossary import Glossary, Term
from site_builder.markdown.inline import inline_html
from site_builder.markdown.reading import Reading


def read_definitions(glossary: Glossary, reading: Reading) -> tuple[Definition, ...]:
    """All of them; ``reading`` is of the glossary's file."""
    return tuple(_definition(term, reading) for term in glossary.terms.values())


def _definition(term: Term, reading: Reading) -> Definition:
    html = inline_html(term.says, term.line, reading)
    if reading.citations or reading.links:
        legal = "a {ref}, or a citation in the section that explains it"
        reading.problem(
            term.line, f"link or citation in the definition of {term.name!r}; legal: {legal}"
        )
        reading.citations.clear()
        reading.links.clear()
    try:
        explained = (
            reading.targets.find(term.explained, reading.chapter) if term.explained else None
        )
    except LookupError as error:
        reading.problem(term.line, str(error.args[0]))
        explained = None
    if explained and explained.kind not in ("Section", "Chapter", "Appendix"):
        legal = "a section, 'CHAPTER#ID', or a chapter"
        reading.problem(term.line, f"{term.name!r} explained by {explained.name}; legal: {legal}")
    return Definition(term, html, explained)
