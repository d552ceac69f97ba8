"""Whether the section that is to explain a term speaks of it."""

from site_builder.beside.glossary import FILE
from site_builder.book import Book
from site_builder.diagnostics import Diagnostics


def check_glossary(book: Book, problems: Diagnostics) -> None:
    """Report terms whose section never uses them, which readers would be led to in vain."""
    used = {(use.term, ch.id, use.section) for ch in book.chapters for use in ch.term_uses}
    for definition in book.glossary:
        term, place = definition.term, definition.explained
        if place and (term.name, place.chapter, place.id) not in used:
            sections = [
                f"{chapter}#{section}" if section else chapter
                for name, chapter, section in sorted(used)
                if name == term.name
            ]
            legal = ", ".join(sections[:6]) or "a section that does"
            message = f"{term.name!r} is not in the text of {term.explained!r}; legal: {legal}"
            problems.add(FILE, term.line, message)
