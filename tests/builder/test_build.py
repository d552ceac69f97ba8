"""Building: the same bytes from the same sources, and nothing where there is a mistake."""

import re
from collections.abc import Callable
from pathlib import Path

import pytest
from support.little_book import OUTLINE

from site_builder import build
from site_builder.build import Options, render_site
from site_builder.diagnostics.diagnostic import BuildError
from site_builder.output.assets import content_bytes
from site_builder.sources.outline import OWN_FOLDERS

type MakeBook = Callable[..., Options]


def test_a_build_is_deterministic(make_book: MakeBook) -> None:
    options = make_book(":::{simulation} demo\n:::\n")
    first, second = render_site(options), render_site(options)
    assert {p: content_bytes(c) for p, c in first.items()} == {
        p: content_bytes(c) for p, c in second.items()
    }


def test_a_mistake_writes_nothing(make_book: MakeBook, tmp_path: Path) -> None:
    make_book(":::{nope}\n:::\n")
    written: list[Path] = []
    with pytest.raises(BuildError):
        build.build_site(
            tmp_path,
            tmp_path / "site",
            runtime=False,
            write=lambda _files, out: written.append(out),
        )
    assert written == []


def test_a_book_without_figures_ships_no_interpreter_and_no_editor(make_book: MakeBook) -> None:
    options = make_book("Text.\n", {"content/book.toml": OUTLINE})
    files = render_site(Options(options.root, search=False))
    told = content_bytes(files["licences/index.html"]).decode()
    assert not [path for path in files if path.startswith("runtime/") or "/js/editor/" in path]
    assert [name for name in ("Pyodide", "CodeMirror", "NumPy") if name in told] == []


def test_pages_listen_for_rebuilds_only_while_serving(make_book: MakeBook) -> None:
    options = make_book()
    for reload in (False, True):
        files = render_site(Options(options.root, False, reload, options.load_scene))
        assert (b"/.reload/" in content_bytes(files["first/index.html"])) is reload


def test_no_chapter_may_take_the_place_of_the_site_s_own_folders(make_book: MakeBook) -> None:
    quiz = ":::{quiz} q\nWhich?\n- [x] A\n  : Yes.\n- [ ] B\n  : No.\n:::\n"
    body = f":::{{source}} simulations.models.thing:double\n:::\n\n{{cite}}`k`\n\n{quiz}"
    work = "@misc{k, author = {A, B}, title = {T}, year = 2000}\n"
    lists = {
        "references.bib": work,
        "glossary.toml": '[text]\nsays = "Words."\nexplained = "second#a-section"\n',
        "symbols.toml": "[book]\n",
        "lecture-plan.toml": 'intro = "I."\n[[section]]\nnumber = "2"\ntitle = "T"\nnote = "N."\n'
        'taught = ["second#a-section"]\n',
    }
    files = {f"content/{name}": text for name, text in lists.items()}
    site = render_site(make_book(body, files))
    folders = {path.split("/")[0] for path in site if "/" in path}
    assert folders - {"first", "second"} | {"cards", "embed", "runtime", "search"} == set(
        OWN_FOLDERS
    )


def test_source_is_shown_where_python_finds_it(make_book: MakeBook) -> None:
    code = '\ufeff"""One\u2028two."""\n\f\n\n\ndef half(x):\n    return x / 2\n'
    body = ":::{source} simulations.models.thing:half\n:::\n"
    site = render_site(make_book(body, {"simulations/models/thing.py": code}))
    page = content_bytes(site["first/index.html"]).decode()
    shown = re.sub(r"<[^>]+>", "", page)
    assert "def half(x):" in shown
    assert "return x / 2" in shown
