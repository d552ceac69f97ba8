"""What the command says and with which number it ends."""

from collections.abc import Callable
from pathlib import Path

import pytest

from site_builder.build import Options

type Run = Callable[..., int]


WARNED = ":::{{quiz}} q\nWhich?\n- [x] {}\n  : Yes.\n- [ ] That\n  : No.\n:::\n".format("long " * 9)


def test_warnings_are_listed_and_counted_and_fail_nothing(
    run: Run, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    assert run("check", "--no-runtime", body=WARNED) == 0
    said = capsys.readouterr()
    assert said.err.startswith("content/00-first.md:5: warning: the key of quiz 'q' stands out")
    assert said.out == "no mistakes; 1 warning\n"
    assert run("build", "--no-runtime", "--out", str(tmp_path / "site"), body=WARNED) == 0
    said = capsys.readouterr()
    assert said.err.count("warning:") == 1
    assert said.out.endswith(" files; 1 warning\n")


@pytest.mark.parametrize(
    ("body", "count", "warnings"),
    [
        ("# A\n", "1 mistake", 0),
        ("# A\n\n$b\n", "2 mistakes", 0),
        ("# A\n\n" + WARNED, "1 mistake", 1),
    ],
)
def test_mistakes_are_listed_and_counted_without_warnings(
    run: Run, capsys: pytest.CaptureFixture[str], body: str, count: str, warnings: int
) -> None:
    assert run("check", "--no-runtime", body=body) == 1
    said = capsys.readouterr().err
    assert "content/00-first.md:5: heading '# A'" in said
    assert said.count("warning:") == warnings
    assert said.endswith(f"\n{count}; nothing was written\n")


def test_a_site_is_built_where_it_is_wanted(run: Run, tmp_path: Path) -> None:
    out = tmp_path / "elsewhere"
    assert run("build", "--no-runtime", "--out", str(out)) == 0
    assert (out / "second" / "index.html").is_file()


def test_after_a_mistake_the_last_good_site_is_as_it_was(run: Run, tmp_path: Path) -> None:
    out = tmp_path / "elsewhere"
    words = ("build", "--no-runtime", "--out", str(out))
    run(*words, body="Good.\n")
    before = {path: path.read_bytes() for path in out.rglob("*.html")}
    assert run(*words, body=":::{note}\nNever closed.\n") == 1
    assert {path: path.read_bytes() for path in out.rglob("*.html")} == before


def test_a_folder_that_is_no_site_is_refused_in_words(
    run: Run, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "thesis.tex").write_text("years of work")
    assert run("build", "--no-runtime", "--out", str(tmp_path)) == 1
    assert "is not empty and holds no site" in capsys.readouterr().err


def test_an_interrupted_command_ends_without_a_traceback(
    run: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    def interrupted(_options: Options) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("site_builder.__main__.check_site", interrupted)
    assert run("check", "--no-runtime") == 130
