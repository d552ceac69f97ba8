"""Single scripts of the book: in the book they are bundled, and no address leads to one."""

from collections.abc import Iterable
from pathlib import Path

from site_builder.diagnostics import Diagnostics
from site_builder.engine_files import static_files
from site_builder.languages.words import load_words
from site_builder.output.book_files import book_script
from site_builder.output.scripts import bundle_scripts
from site_builder.pages.kind_files import kind_files
from site_builder.settings.reading import read_settings


def write_scripts(root: Path, site: Path, modules: Iterable[str]) -> None:
    """Each of these, such as ``page/text``, with what it imports, into ``js/`` of a site."""
    settings, _ = read_settings(root, Diagnostics())
    book = book_script(settings, load_words(settings.language))
    scripts = {**static_files(root), **kind_files()}
    sources = {name: file for name, file in scripts.items() if name.endswith((".ts", ".js"))}
    for module in modules:
        bundle = bundle_scripts({**sources, "js/book.js": book}, f"js/{module}.ts")
        for name, script in bundle.files.items():
            (site / name).parent.mkdir(parents=True, exist_ok=True)
            (site / name).write_bytes(script)
