"""Chapters as notebooks, and passages as Markdown: read again, it says the same."""

from base64 import b64decode
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import nbformat
import pytest
from markdown_it import MarkdownIt
from mdit_py_plugins.dollarmath import dollarmath_plugin
from support.little_book import MakeBook

from site_builder.build import check_site, load
from site_builder.document.blocks import Prose, contents
from site_builder.editions.notebooks.notebook import make_notebooks
from site_builder.output.assets import content_bytes
from site_builder.render.markdown import MarkdownRenderer, code, quoted, table

SIGNS = r"A \*star\*, a \_line\_, a [bracket], 2 < 3, \$5, \# 1, a \`tick\` and a \\ back slash."
READ_AGAIN = MarkdownIt("commonmark").enable("table").use(dollarmath_plugin)


@pytest.mark.parametrize("address", ["", "https://host/book/"])
def test_a_notebook_has_frames_files_and_links_to_the_site_where_it_has_an_address(
    make_book: MakeBook, address: str
) -> None:
    body = "See {ref}`second`.\n\n:::{simulation} demo\n:k1: 0.25\n:tier: fast\nPull it.\n:::\n\n"
    body += ":::{audio} sounds/a tone.wav\n:title: A tone\nIt *hums*.\n:::\n"
    options = replace(make_book(body, {"content/sounds/a tone.wav": "RIFF"}), address=address)
    files = make_notebooks(check_site(options), options.root)
    assert content_bytes(files["content/sounds/a tone.wav"]) == b"RIFF"
    notebook = nbformat.reads(content_bytes(files["first.ipynb"]).decode(), as_version=4)
    nbformat.validate(notebook)
    (figure,) = (cell for cell in notebook.cells if cell.source.startswith('figure("demo"'))
    (output,) = figure.outputs
    assert output.data["text/plain"] == "Shows k1 of 0.25 in tier fast."
    assert b64decode(output.data["image/png"]).startswith(b"\x89PNG")
    (text,) = (cell.source for cell in notebook.cells if cell.source.startswith("See "))
    assert (f"]({address}second/)" in text) if address else "](" not in text


def test_only_a_folder_of_notebooks_is_replaced(run: Callable[..., int], tmp_path: Path) -> None:
    out, full = tmp_path / "out", tmp_path / "full"
    full.mkdir()
    (full / "thesis.txt").touch()
    assert [run("notebooks", "--out", str(folder)) for folder in (out, out, full)] == [0, 0, 1]
    assert (out / "first.ipynb").is_file()
    assert [file.name for file in full.iterdir()] == ["thesis.txt"]


@pytest.mark.parametrize(
    "body",
    [
        SIGNS,
        "1\\. is no list, and neither is\n\\- this, or\n\\# that.",
        "- One\n- Two\n  - Three\n\n4. Four\n\n   More of it.\n5. Five",
        "> Words that *another* said, in **two**\n> lines.",
        "```python\nx = '```'\n```",
        "Call `f(a|b)`, or ``a`b``.",
        "| Left | Right |\n|:---|---:|\n| one \\| two | `c\\|d` |",
    ],
)
def test_a_passage_written_as_markdown_shows_what_its_author_wrote(
    make_book: MakeBook, body: str
) -> None:
    render = MarkdownRenderer({}, lambda _href: "")
    chapter = load(make_book(body)).book.chapters[0]
    written = "\n\n".join(render(prose.words) for prose in contents(chapter.body, Prose))
    assert READ_AGAIN.render(written) == READ_AGAIN.render(body)


def test_bars_ticks_and_formulae_keep_their_place() -> None:
    row = table(["a"], [[r"$|x| = \|y\|$ | z"]]).splitlines()[-1]
    assert row == r"| $\vert x\vert  = \Vert y\Vert $ \| z |"
    assert quoted("So\n\n$$\na\n= b\n$$") == "> So\n>\n> $$a = b$$"
    assert code("a`b") == "`` a`b ``"
