"""Whether the section that is to explain a term uses it, and whether any text does before it."""

from site_builder.diagnostics.diagnostic import Diagnostics
from site_builder.document.book import Book
from site_builder.document.places import Target, TermUse
from site_builder.references.glossary import FILE


def check_glossary(book: Book, problems: Diagnostics) -> None:
    """Report terms whose explaining section never uses them."""
    used = {(use.term, ch.id, use.section) for ch in book.chapters for use in ch.term_uses}
    for definition in book.glossary:
        term, place = definition.term, definition.explained
        if place and (term.name, place.chapter, place.id) not in used:
            sections = [
                f"{chapter}#{section}" if section else chapter
                for name, chapter, section in sorted(used)
                if name == term.name
            ]
            expected = ", ".join(sections[:6]) or "a section that does"
            message = f"{term.name!r} is not in the text of {term.explained!r}; legal: {expected}"
            problems.add(FILE, term.line, message)


def check_order(book: Book, problems: Diagnostics) -> None:
    """Warn of terms used before the section that explains them, unless the author marked the use:
    a mark shows the definition."""
    unexplained = {item.term.name: item.explained for item in book.glossary if item.explained}
    for chapter in book.chapters:
        for use in chapter.term_uses:
            place = unexplained.pop(use.term, None)
            if place and not use.by_author and not _is_in(use, chapter.id, place):
                message = f"{use.term!r} is used before {place.name}, which explains it"
                better = f"explain it here, or mark it: {{term}}`{use.term}`"
                problems.warn(chapter.path, use.line, f"{message}; better: {better}")


def _is_in(use: TermUse, chapter: str, place: Target) -> bool:
    return chapter == place.chapter and place.id in ("", use.section)
