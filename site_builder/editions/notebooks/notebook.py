"""Each chapter as a notebook, nbformat 4, in a folder with the Python that the figures run."""

from collections.abc import Iterator
from pathlib import Path

import nbformat
import numpy as np
from nbformat import v4

from site_builder.build import CheckedBook
from site_builder.document.book import Colours
from site_builder.editions.notebooks.cells import ChapterPage, Code, Part, Text, cell_of
from site_builder.editions.notebooks.directive_cells import parts_of
from site_builder.output.style_sheets import style_of_drawings
from site_builder.output.writer import Content
from site_builder.publishing.vector import Fonts, uncut_fonts
from site_builder.render.markdown import escaped, link
from site_builder.runtime.imports import archive_path
from site_builder.runtime.pack import book_modules, data_beside

SETUP = "from simulations.notebook.live import figure"


def make_notebook(page: ChapterPage) -> bytes:
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


def _parts(page: ChapterPage) -> Iterator[Part]:
    yield Text(_head(page))
    if page.chapter.simulations:
        yield Text(page.words("edition.notebook"))
        yield Code(SETUP)
    yield from parts_of(page.chapter.body, page)
    if page.chapter.citations:
        yield Text(_references(page))


def _head(page: ChapterPage) -> str:
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


def _references(page: ChapterPage) -> str:
    works = page.book.bibliography
    cited = dict.fromkeys(citation.key for citation in page.chapter.citations)
    lines = [
        f"- {escaped(works[key].reference)} {link(escaped(works[key].address), works[key].address)}"
        for key in cited
    ]
    return "\n".join([f"## {escaped(page.words('references.title'))}", "", *lines])


OWN = Path(__file__).with_name("style.css")
REQUIREMENTS = "requirements.txt"
NEEDED = f"numpy=={np.__version__}\npillow\nipywidgets\njupyterlab\n"
"""numpy as the book has it, so that both compute alike."""
STYLE = "simulations/notebook/style.css"


def make_notebooks(checked: CheckedBook, root: Path) -> dict[str, Content]:
    """All files by path. ``root`` is the book's folder."""
    fonts = uncut_fonts()
    style = notebook_style(root, fonts, checked.book.colours)
    asked_for = "".join(f"{name}\n" for name in checked.book.settings.runtime.packages)
    content = root / "content"
    pages = [
        ChapterPage(checked, chapter, content, style, fonts) for chapter in checked.book.chapters
    ]
    modules = {archive_path(*each): each[1] for each in book_modules(root / "simulations").items()}
    return {
        **{f"{page.chapter.id}.ipynb": make_notebook(page) for page in pages},
        **modules,
        **{path: file for each in modules.items() for path, file in data_beside(*each).items()},
        STYLE: style.encode(),
        REQUIREMENTS: (NEEDED + asked_for).encode(),
    }


def notebook_style(root: Path, fonts: Fonts, colours: Colours) -> str:
    """How drawings look, in plain CSS: with the book's faces where they are installed."""
    families = {
        "--serif": f"'{fonts.serif}', serif",
        "--sans": f"'{fonts.sans}', 'Source Sans 3', 'Helvetica Neue', Arial, sans-serif",
    }
    return style_of_drawings(root, OWN.read_text(encoding="utf-8"), families, colours)
