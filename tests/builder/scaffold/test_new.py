"""What ``new`` makes works at once: a book, and in it one skeleton of each kind."""

import subprocess
import sys
from pathlib import Path

import pytest
from filelock import FileLock

from site_builder.scaffold.names import ScaffoldError, read_name
from site_builder.scaffold.new_book import make_book
from site_builder.scaffold.pieces import PIECES, make_new

PIECES_MADE = (
    ("chapter", "second-fall"),
    ("scene", "two-balls"),
    ("model", "air-drag"),
    ("model", "mechanics/spring"),
    ("ladder", "exponential"),
    ("directive", "aside"),
)
MAKE_PIECES = """\
import sys
from site_builder.__main__ import main
sys.exit(any([main(["new", *piece.split()]) for piece in sys.argv[1:]]))
"""
"""By the command, which is started once for all."""


def in_book(folder: Path, *words: str) -> "subprocess.CompletedProcess[str]":
    command = [sys.executable, *words]
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)


@pytest.fixture(scope="session")
def first_book(tmp_path_factory: pytest.TempPathFactory, worker_id: str) -> Path:
    """A new book with one more piece of each kind, which the copy's own command has made."""
    own = tmp_path_factory.getbasetemp()
    folder = (own if worker_id == "master" else own.parent) / "first-book"
    with FileLock(f"{folder}.lock"):
        if not folder.exists():
            make_book(folder)
            done = in_book(folder, "-c", MAKE_PIECES, *(" ".join(piece) for piece in PIECES_MADE))
            assert done.returncode == 0, done.stderr
    return folder


def test_the_sources_have_no_mistakes(first_book: Path) -> None:
    done = in_book(first_book, "-m", "site_builder", "check")
    assert (done.returncode, done.stdout, done.stderr) == (0, "no mistakes\n", "")


def test_all_its_tests_pass(first_book: Path) -> None:
    done = in_book(first_book, "-m", "pytest", "-q", "-p", "no:cacheprovider")
    assert done.returncode == 0, done.stdout + done.stderr
    for name in ("two_balls_scene", "air_drag", "spring", "exponential_ladder", "aside_directive"):
        assert len([*first_book.glob(f"tests/**/test_{name}.py")]) == 1


def test_its_code_is_formatted_and_free_of_lint(first_book: Path) -> None:
    own = ["simulations", "tests", "site_builder/markdown/directives"]
    for command in (["format", "--check"], ["check"]):
        done = in_book(first_book, "-m", "ruff", *command, *own)
        assert done.returncode == 0, done.stdout


def test_a_book_has_a_question_of_each_kind(first_book: Path) -> None:
    texts = "".join(file.read_text("utf-8") for file in first_book.glob("content/*.md"))
    for kind in (":kind: number", ":kind: order", ":kind: figure", ":kind: multiple", "{predict}"):
        assert kind in texts


def test_a_book_has_nothing_of_the_one_whose_engine_it_took(first_book: Path) -> None:
    scenes = {folder.name for folder in (first_book / "simulations" / "scenes").iterdir()}
    assert {name for name in scenes if not name.startswith("_")} == {"falling_ball", "two_balls"}
    assert not (first_book / "simulations" / "pictures").exists()


def what_an_author_wrote(book: Path) -> dict[Path, bytes]:
    """The book's sources; caches are left out, which other tests of this book write meanwhile."""
    made = {"build", "__pycache__"}
    return {
        file: file.read_bytes()
        for file in book.rglob("*")
        if file.is_file()
        and not any(part in made or part.startswith(".") for part in file.relative_to(book).parts)
    }


@pytest.mark.parametrize(("kind", "name"), PIECES_MADE)
def test_what_is_there_is_never_overwritten(first_book: Path, kind: str, name: str) -> None:
    before = what_an_author_wrote(first_book)
    with pytest.raises(ScaffoldError, match="is there already; legal: "):
        make_new(first_book, kind, name)
    assert what_an_author_wrote(first_book) == before


def test_a_ladder_in_a_package_is_not_shadowed(tmp_path: Path) -> None:
    (tmp_path / "simulations" / "ladders" / "sums").mkdir(parents=True)
    with pytest.raises(ScaffoldError, match="simulations/ladders/sums is there already"):
        make_new(tmp_path, "ladder", "sums")


def test_a_folder_with_something_in_it_gets_no_book(tmp_path: Path) -> None:
    folder = tmp_path / "full"
    folder.mkdir()
    (folder / "thesis.tex").write_text("years of work")
    with pytest.raises(ScaffoldError, match="is not empty; legal: a folder that is empty"):
        make_book(folder)
    assert [file.name for file in folder.iterdir()] == ["thesis.tex"]


@pytest.mark.parametrize("text", ["Falling", "falling_ball", "2-balls", "a b", "", "ball-", "../x"])
def test_a_name_that_makes_no_file_or_id_is_refused(text: str) -> None:
    with pytest.raises(ScaffoldError, match="legal: small letters and digits"):
        read_name("scene", text)


def test_a_word_of_python_is_no_name() -> None:
    with pytest.raises(ScaffoldError, match="'lambda' is a word of Python's own"):
        read_name("model", "lambda")


@pytest.mark.parametrize("kind", PIECES)
def test_every_kind_checks_its_names(tmp_path: Path, kind: str) -> None:
    (tmp_path / "content").mkdir()
    (tmp_path / "content" / "book.toml").write_text("chapters = []\n")
    with pytest.raises(ScaffoldError, match=f"{kind} 'No Name'; legal"):
        make_new(tmp_path, kind, "No Name")


def test_a_book_that_shares_its_engine_gets_no_directive(tmp_path: Path) -> None:
    with pytest.raises(ScaffoldError, match="has no builder of its own"):
        make_new(tmp_path, "directive", "aside")
