"""Commands: their output for people and for programs, and their exit codes."""

import fcntl
import json
import os
import pty
import re
import shlex
import struct
import subprocess
import sys
import termios
import time
import zipfile
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from importlib import import_module
from io import BytesIO
from pathlib import Path
from typing import Any

import pytest
import yaml
from support.little_book import OUTLINE, PACKAGE, MakeBook, diagnostics, small_package
from support.places import ROOT

from site_builder.__main__ import find
from site_builder.build import Options, render_site
from site_builder.diagnostics.blame import at_settings
from site_builder.diagnostics.diagnostic import (
    BuildError,
    Diagnostic,
    Diagnostics,
    cause,
    column_of,
    suggestion_of,
)
from site_builder.diagnostics.progress import advance, counting, show_progress
from site_builder.pool.processes import KilledError, run_in_pool, using_pool
from site_builder.runtime import freeze, pack
from site_builder.runtime.imports import module_files
from site_builder.runtime.pack import chunk_archive

TWO = ":::{nott}\n:::\n\nA price of 5$ each.\n"
WARNED = ":::{{quiz}} q\nWhich?\n- [x] {}\n  : Yes.\n- [ ] That\n  : No.\n:::\n".format("long " * 9)
FIGURE = ":::{simulation} demo\n:::\n"
BROWSER = "import simulations.scenes.orbit.scene\n"
type Run = Callable[..., int]


@pytest.fixture
def run(run: Run) -> Run:
    """The command on a small book, without the browser's Python."""
    return lambda name, *more, **book: run(name, "--no-runtime", *more, **book)


def test_json_report_has_the_promised_fields(run: Run, capsys: pytest.CaptureFixture[str]) -> None:
    assert run("check", "--json", body="A price of 5$ each.\n") == 1
    output = capsys.readouterr()
    assert output.err == ""
    found = json.loads(output.out)
    assert (found["mistakes"], found["warnings"]) == (1, 0)
    (diagnostic,) = found["diagnostics"]
    message, suggestion = diagnostic.pop("message"), diagnostic.pop("suggestion")
    assert message == f"'$' opens or closes no formula; legal: {suggestion}"
    place = {"file": "content/00-first.md", "line": 5, "column": 13}
    assert diagnostic == {**place, "severity": "error"}


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
def test_suggestion_is_separated_from_the_message(message: str, suggestion: str | None) -> None:
    assert suggestion_of(message) == suggestion


@pytest.mark.parametrize(
    ("message", "column"), [("'bc' is wrong", 2), ("'b' is twice there", None), ("nothing", None)]
)
def test_column_is_given_only_if_it_is_unambiguous(
    tmp_path: Path, message: str, column: int | None
) -> None:
    (tmp_path / "a.md").write_text("\nabcb\n")
    assert column_of(Diagnostic(path="a.md", line=2, message=message), tmp_path) == column
    assert column_of(Diagnostic(path="a.md", line=9, message=message), tmp_path) is None
    assert column_of(Diagnostic(path="b.md", line=2, message=message), tmp_path) is None


@pytest.mark.parametrize(
    ("body", "mistakes", "warnings", "last"),
    [
        ("# A\n", 1, 0, "1 mistake; nothing was written"),
        (f"# A\n\n{TWO}", 3, 0, "3 mistakes; nothing was written"),
        ("# A\n\n" + WARNED, 1, 1, "1 mistake; nothing was written"),
        (WARNED, 0, 1, "no mistakes; 1 warning"),
    ],
)
def test_mistakes_and_warnings_are_listed_and_only_mistakes_fail(
    run: Run, capsys: pytest.CaptureFixture[str], body: str, mistakes: int, warnings: int, last: str
) -> None:
    assert run("check", body=body) == (mistakes > 0)
    output = capsys.readouterr()
    listed = [line for line in output.err.splitlines() if line and line != last]
    assert all(re.fullmatch(r"[^:]+:\d+: .+", line) for line in listed)
    assert len(listed) == mistakes + warnings
    assert sum("warning:" in line for line in listed) == warnings
    assert (output.err if mistakes else output.out).splitlines()[-1] == last


def test_site_is_built_in_the_given_folder_and_survives_a_mistake(run: Run, tmp_path: Path) -> None:
    out = tmp_path / "elsewhere"
    assert run("build", "--out", str(out), body="Good.\n") == 0
    assert (out / "second" / "index.html").is_file()
    before = {path: path.read_bytes() for path in out.rglob("*.html")}
    assert run("build", "--out", str(out), body=":::{note}\nNever closed.\n") == 1
    assert {path: path.read_bytes() for path in out.rglob("*.html")} == before


@pytest.mark.parametrize("closed", [1, 2])
def test_exit_code_is_kept_when_an_output_stream_is_closed(closed: int, tmp_path: Path) -> None:
    """The command fails with 1 in a folder without a book; its output is lost."""
    command = f"{shlex.quote(sys.executable)} -m site_builder check {closed}>&-"
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    done = subprocess.run(
        command, shell=True, cwd=tmp_path, env=environment, capture_output=True, text=True,
        check=False,
    )  # fmt: skip
    assert done.returncode == 1
    assert done.stdout == ""
    assert "Traceback" not in done.stderr


def test_interrupted_command_exits_without_a_traceback(
    run: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    def interrupted(_options: Options) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("site_builder.__main__.check_site", interrupted)
    assert run("check") == 130


def test_check_and_build_report_an_import_missing_in_the_browser(
    make_book: MakeBook, monkeypatch: pytest.MonkeyPatch
) -> None:
    files = {
        "content/book.toml": OUTLINE,
        "simulations/__init__.py": "",
        "simulations/browser.py": BROWSER,
        "simulations/scenes/orbit/__init__.py": "",
        "simulations/scenes/orbit/scene.py": "import scipy\n\nSCENE = 1\n",
    }

    def lacking(*given: Any) -> None:
        places = {**given[3], **given[4]}
        raise freeze.MissingModuleError("scipy", places["scipy"])

    monkeypatch.setattr(pack, "freeze_libraries", lacking)
    monkeypatch.setattr(pack, "page_modules", lambda imports, *_: frozenset(imports))
    options = replace(make_book(FIGURE, files), runtime=True)
    (found,) = find(options)
    place = "simulations/scenes/orbit/scene.py:1: imports scipy, which the browser's Python lacks; "
    assert str(found).startswith(place)
    with pytest.raises(BuildError) as raised:
        render_site(options)
    assert raised.value.diagnostics == (found,)


def test_syntax_error_in_an_unused_module_is_reported(make_book: MakeBook) -> None:
    files = {
        "content/book.toml": OUTLINE,
        "simulations/browser.py": BROWSER,
        "simulations/models/broken.py": "x = 1\ny = (\n",
    }
    (found,) = find(replace(make_book(FIGURE, files), runtime=True))
    assert str(found).startswith("simulations/models/broken.py:2: no Python: ")


def test_pre_commit_hook_rejects_a_book_with_a_mistake(run: Run) -> None:
    (hook,) = yaml.safe_load((ROOT / ".pre-commit-hooks.yaml").read_text(encoding="utf-8"))
    python, dash, package, *words = shlex.split(hook["entry"])
    assert (python, dash, package) == (".venv/bin/python", "-m", "site_builder")
    assert hook["pass_filenames"] is False
    assert [run(*words), run(*words, body=TWO)] == [0, 1]
    of_the_book = ("content/book.toml", "simulations/registry.py", "static/css/book.css")
    assert all(re.search(hook["files"], path) for path in of_the_book)
    assert not re.search(hook["files"], "README.md")


@pytest.mark.parametrize(
    ("line", "says"),
    [
        ("return {'curve': 1}['curves']", "KeyError: 'curves'"),
        ("return math.sinn(1)", "AttributeError: module 'math' has no attribute 'sinn'. Did you "
         "mean: 'sin'?"),
        ("return heigth", "NameError: name 'heigth' is not defined. Did you mean: 'height'?"),
        ("return 1 / 0", "ZeroDivisionError: division by zero"),
        ("raise ValueError('height -1; legal: 0')", "ValueError: height -1; legal: 0"),
        ("assert height < 0", "AssertionError"),
    ],
)  # fmt: skip
def test_exception_is_reported_with_its_message_and_place(
    line: str, says: str, tmp_path: Path
) -> None:
    source = f"import math\nheight = 3\n\ndef draw():\n    {line}\n"
    with small_package(tmp_path, {"scene": source}):
        draw = import_module(f"{PACKAGE}.scene").draw
        with pytest.raises(Exception) as raised:  # noqa: PT011
            draw()
        assert cause(raised.value) == f"{says}, at simulations/small/scene.py:5"


def test_module_that_cannot_be_imported_is_reported_with_its_line(tmp_path: Path) -> None:
    sources = {
        "unread": "def draw(:\n    pass\n",
        "ended": "import os\nos._exit(3)\n",
        "drawn": "from simulations.engine.drawing import polyline\n"
        "polyline([(0, 0)] * 1_000_000)\n",
    }
    causes: dict[str, str] = {}
    with small_package(tmp_path, sources), using_pool():
        for name, error in (("unread", SyntaxError), ("ended", KilledError), ("drawn", ValueError)):
            with pytest.raises(error) as raised:
                run_in_pool(partial(import_module, f"{PACKAGE}.{name}"))
            causes[name] = cause(raised.value)
    assert causes["unread"] == "SyntaxError: invalid syntax, at simulations/small/unread.py:1"
    assert causes["ended"].startswith("KilledError: ends its process, exit code 3")
    assert causes["ended"].endswith(", at simulations/small/ended.py:2")
    assert causes["drawn"].endswith(", at simulations/small/drawn.py:2")


def test_exception_of_a_scene_is_reported_once_at_its_line_and_figure(tmp_path: Path) -> None:
    problems = Diagnostics()
    with small_package(tmp_path, {"scene": "def draw():\n    return 1 / 0\n"}):
        draw = import_module(f"{PACKAGE}.scene").draw
        for line in (7, 9):
            with pytest.raises(ZeroDivisionError) as raised, at_settings({"k1": line / 10}):
                draw()
            problems.add("content/a.md", line, "simulation 'a' cannot be drawn", raised.value)
    (only,) = BuildError(problems.found).diagnostics
    assert str(only) == (
        "simulations/small/scene.py:2: ZeroDivisionError: division by zero "
        "(met at content/a.md:7, k1 = 0.7)"
    )


@pytest.mark.parametrize(
    ("message", "line"),
    [
        ("handle 'ball': panel 'sped'; legal: 'speed'", 5),
        ("stage 'fall' reads 'termnal'; legal: terminal", 1),
        ("panel 'speed': unknown class 'rayy'", 3),
        ("no description", 6),
        ("depth: default 5 outside 0 to 3", 8),
        ("setting 'depth': a slider is float or int, not str", 8),
    ],
)
def test_mistake_of_a_scene_is_at_the_line_that_it_quotes(
    message: str, line: int, tmp_path: Path
) -> None:
    source = """def fall(termnal):
    pass
STYLE = "rayy bold"
ball = 3
BALL = Handle("ball", "sped")
SCENE = Scene()
def read(depth): pass
def draw(size=1, depth: float = slider("Depth", 5, 0, 3)): pass
"""
    with small_package(tmp_path, {"ball": source}):
        found = Diagnostics()
        for met in (7, 9):
            found.add_of(f"{PACKAGE}.ball", "content/a.md", met, message)
        (only,) = BuildError(found.found).diagnostics
        assert (only.path, only.line) == ("simulations/small/ball.py", line)
        assert only.raised_at == "content/a.md:7"


LOOP = "def loop():\n    while True: pass\n"


def test_endless_function_is_reported_in_the_text_that_calls_it(
    tmp_path: Path, make_book: MakeBook
) -> None:
    body = f"```calc\nfrom {PACKAGE}.odd import loop\n```\n\n{{calc}}`loop()`"
    options = make_book(body, {"content/book.toml": OUTLINE})
    with small_package(tmp_path / "odd", {"odd": LOOP}), using_pool(seconds=2.0):
        (found,) = diagnostics(options)
    assert str(found) == "content/00-first.md:9: 'loop()': KilledError: takes more than 2 s"


def test_data_files_named_by_a_module_are_packed_with_it(tmp_path: Path) -> None:
    source = "from pathlib import Path\nTEXT = Path(__file__).with_name('heights.csv')\n"
    with small_package(tmp_path, {"named": source}):
        for name in ("heights", "speeds"):
            (tmp_path / "simulations" / "small" / f"{name}.csv").write_text("1,2")
    files = module_files(tmp_path / "simulations")
    with zipfile.ZipFile(BytesIO(chunk_archive(files, [f"{PACKAGE}.named"]))) as archive:
        assert archive.namelist() == ["simulations/small/named.py", "simulations/small/heights.csv"]


def test_long_step_shows_its_bar_on_a_terminal_alone(capsys: pytest.CaptureFixture[str]) -> None:
    reader, writer = pty.openpty()
    fcntl.ioctl(writer, termios.TIOCSWINSZ, struct.pack("HHHH", 24, 80, 0, 0))
    with os.fdopen(writer, "w", encoding="utf-8") as terminal:
        try:
            for stream in (sys.stderr, terminal):
                show_progress(stream)
                with counting("figures", 4):
                    time.sleep(1.1)
                    advance()
        finally:
            show_progress(None)
        shown = os.read(reader, 4096).decode()
    os.close(reader)
    assert re.search(r"figures: +25%.*1/4", shown)
    assert capsys.readouterr() == ("", "")
