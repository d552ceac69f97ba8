"""One chapter as a notebook, nbformat 4."""

from collections.abc import Iterator

import nbformat
from nbformat import v4

from site_builder.editions.notebooks.blocks import parts_of
from site_builder.editions.notebooks.cells import Code, Part, Text, cell_of
from site_builder.editions.notebooks.page import Page
from site_builder.render.markdown import escaped, link

SETUP = "from simulations.notebook.live import figure"


def make_notebook(page: Page) -> bytes:
    """The file. The same chapter is the same bytes."""
    cells = [cell_of(part, f"cell-{place}") for place, part in enumerate(_parts(page))]
    metadata = {
        "kernelspec": {"name": "python3", "display_name": "Python 3", "language": "python"},
        "language_info": {"name": "python"},
        "title": f"{page.book.title}: {page.chapter.title}",
        "authors": [{"name": name} for name, _ in page.book.settings.imprint.people],
    }
    notebook = v4.new_notebook(cells=cells, metadata=metadata)
    nbformat.validate(notebook)
    return f"{nbformat.writes(notebook)}\n".encode()


def _parts(page: Page) -> Iterator[Part]:
    yield Text(_head(page))
    if page.chapter.simulations:
        yield Text(page.words("edition.notebook"))
        yield Code(SETUP)
    yield from parts_of(page.chapter.body, page)
    if page.chapter.citations:
        yield Text(_references(page))


def _head(page: Page) -> str:
    """What the chapter is about, what it takes and what it gives, and under which terms it is."""
    chapter, words, licence = page.chapter, page.words, page.book.settings.licence
    parts = [f"# {escaped(chapter.name)}. {escaped(chapter.title)}", escaped(chapter.summary)]
    titles = {other.id: other.title for other in page.book.chapters}
    needs = [
        (f"{escaped(titles[need.chapter])}: " if need.chapter else "") + page.markdown(need.words)
        for need in chapter.before
    ]
    for key, entries in (
        ("chapter.before", needs),
        ("chapter.after", [page.markdown(outcome) for outcome in chapter.after]),
    ):
        if entries:
            listed = "\n".join(f"- {entry}" for entry in entries)
            parts.append(f"**{escaped(words(key))}**\n\n{listed}")
    terms = words("frame.terms_of_use", code=licence.code, text=licence.text)
    book = link(escaped(page.book.title), page.address(f"../{chapter.url}"))
    parts.append(f"*{book}*. {escaped(terms)}")
    return "\n\n".join(parts)


def _references(page: Page) -> str:
    works = page.book.bibliography.works
    cited = dict.fromkeys(citation.key for citation in page.chapter.citations)
    lines = [
        f"- {escaped(works[key].reference)} {link(escaped(works[key].address), works[key].address)}"
        for key in cited
    ]
    return "\n".join([f"## {escaped(page.words('references.title'))}", "", *lines])
