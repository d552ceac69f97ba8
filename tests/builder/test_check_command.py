"""What ``check`` tells programs, and what asks it before a commit."""

import json
import re
import shlex
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
import yaml
from support.little_book import OUTLINE

from site_builder.__main__ import find
from site_builder.build import Options, render_site
from site_builder.diagnostics.as_json import column_of, suggestion_of
from site_builder.diagnostics.diagnostic import BuildError, Diagnostic, unknown
from site_builder.runtime import freeze, pack

ROOT = Path(__file__).resolve().parents[2]
TWO = ":::{nott}\n:::\n\nA price of 5$ each.\n"
FIGURE = ":::{simulation} demo\n:::\n"
type Run = Callable[..., int]


@pytest.fixture
def run(run: Run) -> Run:
    """The command on a small book, without the browser's Python."""
    return lambda name, *more, **book: run(name, "--no-runtime", *more, **book)


def test_programs_get_the_fields_that_are_promised(
    run: Run, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run("check", "--json", body="A price of 5$ each.\n") == 1
    said = capsys.readouterr()
    assert said.err == ""
    assert json.loads(said.out) == {
        "mistakes": 1,
        "warnings": 0,
        "diagnostics": [
            {
                "file": "content/00-first.md",
                "line": 5,
                "column": 13,
                "severity": "error",
                "message": r"'$' opens or closes no formula; legal: '$…$', or '\$' for the sign "
                "itself",
                "suggestion": r"'$…$', or '\$' for the sign itself",
            },
        ],
    }


@pytest.mark.parametrize(
    ("message", "suggestion"),
    [
        ("unknown page 'a'; did you mean 'b'?", "'b'"),
        ("x; legal: one; two", "one; two"),
        ("x; better: less", "less"),
        ("nothing to be done", None),
        ("demo: k1: 9 is out of range; legal: -1 to 1", "-1 to 1"),
    ],
)
def test_what_a_message_proposes_is_told_apart(message: str, suggestion: str | None) -> None:
    assert suggestion_of(message) == suggestion


@pytest.mark.parametrize(
    ("message", "column"), [("'bc' is wrong", 2), ("'b' is twice there", None), ("nothing", None)]
)
def test_a_column_is_told_where_it_is_certain(
    tmp_path: Path, message: str, column: int | None
) -> None:
    (tmp_path / "a.md").write_text("\nabcb\n")
    assert column_of(Diagnostic("a.md", 2, message), tmp_path) == column
    assert column_of(Diagnostic("a.md", 9, message), tmp_path) is None
    assert column_of(Diagnostic("b.md", 2, message), tmp_path) is None


def test_of_many_legal_names_the_first_are_listed_and_the_rest_counted() -> None:
    names = [f"n{number}" for number in range(30)]
    expected = f"unknown name 'zzz'; legal: {', '.join(names[:20])} and 10 more"
    assert unknown("name", "zzz", names) == expected


def test_people_and_editors_read_file_line_and_message(
    run: Run, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run("check", body=TWO) == 1
    for line in capsys.readouterr().err.splitlines()[:-1]:
        assert re.fullmatch(r"[^:]+:\d+: .+", line)


BROWSER = "import simulations.scenes.orbit.scene\n"


def test_an_import_that_the_browser_lacks_is_found_as_the_build_finds_it(
    make_book: Callable[..., Options], monkeypatch: pytest.MonkeyPatch
) -> None:
    options = make_book(
        FIGURE,
        {
            "content/book.toml": OUTLINE,
            "simulations/__init__.py": "",
            "simulations/browser.py": BROWSER,
            "simulations/scenes/orbit/__init__.py": "",
            "simulations/scenes/orbit/scene.py": "import scipy\n\nSCENE = 1\n",
        },
    )

    def lacking(*given: Any) -> None:
        places = {**given[3], **given[4]}
        raise freeze.MissingModuleError("scipy", places["scipy"])

    monkeypatch.setattr(pack, "freeze_libraries", lacking)
    monkeypatch.setattr(pack, "page_modules", lambda imports, *_: frozenset(imports))
    options = replace(options, runtime=True)
    (found,) = find(options)
    assert str(found) == (
        "simulations/scenes/orbit/scene.py:1: imports scipy, which the browser's Python lacks; "
        "legal: its standard library, numpy, and 'packages' of [runtime] in content/book.toml"
    )
    with pytest.raises(BuildError) as raised:
        render_site(options)
    assert raised.value.diagnostics == (found,)


def test_a_module_that_is_no_python_is_found_where_no_chapter_shows_it(
    make_book: Callable[..., Options],
) -> None:
    files = {
        "content/book.toml": OUTLINE,
        "simulations/browser.py": BROWSER,
        "simulations/models/broken.py": "x = 1\ny = (\n",
    }
    (found,) = find(replace(make_book(FIGURE, files), runtime=True))
    assert str(found).startswith("simulations/models/broken.py:2: no Python: ")


@pytest.fixture
def hook() -> dict[str, Any]:
    (entry,) = yaml.safe_load((ROOT / ".pre-commit-hooks.yaml").read_text(encoding="utf-8"))
    return dict(entry)


def test_the_hook_runs_the_check_and_refuses_a_commit_with_a_mistake(
    run: Run, hook: dict[str, Any]
) -> None:
    python, dash, package, *words = shlex.split(hook["entry"])
    assert (python, dash, package) == (".venv/bin/python", "-m", "site_builder")
    assert hook["pass_filenames"] is False
    assert run(*words) == 0
    assert run(*words, body=TWO) == 1


def test_the_hook_is_asked_of_all_that_the_book_is_made_of(hook: dict[str, Any]) -> None:
    asked = re.compile(hook["files"])
    assert all(
        asked.search(path)
        for path in ("content/book.toml", "simulations/registry.py", "static/css/book.css")
    )
    assert not asked.search("README.md")
