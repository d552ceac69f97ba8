"""The folder of all notebooks: beside them the Python that their figures run."""

from pathlib import Path

import numpy as np

from site_builder.build import CheckedBook
from site_builder.document.book import Colours
from site_builder.editions.notebooks.notebook import make_notebook
from site_builder.editions.notebooks.page import Page
from site_builder.output.assets import Content
from site_builder.output.light_theme import style_of_drawings
from site_builder.publishing.vector import Fonts, whole_fonts
from site_builder.runtime.imports import archive_path
from site_builder.runtime.pack import book_modules

OWN = Path(__file__).with_name("style.css")
REQUIREMENTS = "requirements.txt"
NEEDED = f"numpy=={np.__version__}\npillow\nipywidgets\njupyterlab\n"
"""numpy as the book has it, so that both compute alike."""
STYLE = "simulations/notebook/style.css"


def make_notebooks(checked: CheckedBook, root: Path) -> dict[str, Content]:
    """All files by path. ``root`` is the book's folder."""
    fonts = whole_fonts()
    style = notebook_style(root, fonts, checked.book.colours)
    asked_for = "".join(f"{name}\n" for name in checked.book.settings.runtime.packages)
    content = root / "content"
    pages = [Page(checked, chapter, content, style, fonts) for chapter in checked.book.chapters]
    modules = book_modules(root / "simulations")
    handed_out = {name for chapter in checked.book.chapters for name in chapter.files}
    return {
        **{f"{page.chapter.id}.ipynb": make_notebook(page) for page in pages},
        **{archive_path(name, file): file for name, file in modules.items()},
        **{f"content/{name}": content / name for name in sorted(handed_out)},
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
