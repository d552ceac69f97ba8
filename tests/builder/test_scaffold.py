"""Books and skeletons made by ``new`` work at once, and also after an upgrade of the engine."""

import re
import resource
import runpy
import shutil
import sys
from collections.abc import Callable, Mapping
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from typing import Any

import pytest
from filelock import FileLock
from support.engine import Engine, build_wheel, new_engine, run
from support.places import ROOT

from simulations.engine.controls import Action, Slider, Value
from simulations.engine.frame import Frame, content
from simulations.engine.scene import Scene
from simulations.engine.stages import StageCache
from site_builder.benchmarks.measurements import DATA
from site_builder.benchmarks.measuring import write
from site_builder.checks.whole_book import PLACEHOLDERS
from site_builder.document.book import OUTLINE
from site_builder.scaffold.pieces import (
    GALLERY,
    PIECES,
    ScaffoldError,
    make_book,
    make_new,
    read_name,
)
from site_builder.version import __version__

PIECES_MADE = (
    ("chapter", "second-fall"), ("scene", "two-balls"), ("model", "air-drag"),
    ("model", "mechanics/spring"), ("ladder", "exponential"),
)  # fmt: skip
MAKE_PIECES = """\
import sys
from site_builder.__main__ import main
sys.exit(any([main(["new", *piece.split()]) for piece in sys.argv[1:]]))
"""
"""A program that makes all skeletons in one process."""


@pytest.mark.parametrize("like", GALLERY)
def test_gallery_figure_works_under_a_new_name(
    like: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Each control changes the frame at one end of its range at least, and each handle follows a
    drag."""
    make_new(tmp_path, "scene", "my-figure", like)
    name, folder = "simulations.scenes.my_figure", tmp_path / "simulations" / "scenes"
    spec = spec_from_file_location(name, folder / "my_figure.py")
    assert spec
    assert spec.loader
    monkeypatch.setitem(sys.modules, name, module_from_spec(spec))
    spec.loader.exec_module(sys.modules[name])
    scene: Scene[Any] = vars(sys.modules[name])["SCENE"]
    assert (scene.id, scene.title) == ("my-figure", "My Figure")

    def frame_at(values: Mapping[str, Value]) -> Frame:
        return scene.render(scene.check(values), "", StageCache())

    for control in scene.controls:
        if not isinstance(control, Action):
            frames = [content(frame_at({control.name: end})) for end in control.extremes()]
            assert any(frame != content(frame_at({})) for frame in frames), control.name
    for handle in scene.handles:
        there = {
            c.name: c.nearest(0.4 * c.minimum + 0.6 * c.maximum)
            for c in scene.controls
            if isinstance(c, Slider) and c.name in handle.drives
        }
        (place,) = frame_at(there).handles
        assert scene.pull(scene.check({}), handle.name, (place.x, place.y)) == pytest.approx(there)


PARTS = (
    ".github", "CHANGELOG.md", "LICENSE", "pyproject.toml", "simulations", "site_builder", "static",
)  # fmt: skip
"""The parts of the repository in its wheel."""


@pytest.fixture(scope="session")
def first_book(engine: Engine, tmp_path_factory: pytest.TempPathFactory, worker_id: str) -> Path:
    """A new book with one skeleton of each kind, made by the command of the installed engine."""
    own = tmp_path_factory.getbasetemp()
    folder = (own if worker_id == "master" else own.parent) / "first-book"
    with FileLock(f"{folder}.lock"):
        if not folder.exists():
            done = engine.run(folder.parent, "-m", "site_builder", "new", "book", folder.name)
            assert done.returncode == 0, done.stderr
            made = (" ".join(piece) for piece in PIECES_MADE)
            done = engine.run(folder, "-c", MAKE_PIECES, *made)
            assert done.returncode == 0, done.stderr
    return folder


def test_tests_of_a_new_book_and_of_the_guide_pass(engine: Engine, first_book: Path) -> None:
    guide = ROOT / "site_builder" / "guide" / "book" / "content"
    shown = "".join(page.read_text(encoding="utf-8") for page in guide.glob("*.md"))
    samples = [
        code for code in re.findall(r"```python\n(.*?)```", shown, re.S) if "def test" in code
    ]
    assert samples
    of_the_guide = first_book / "tests" / "scenes" / "test_guide.py"
    of_the_guide.write_text("\n".join(samples), encoding="utf-8")
    done = engine.run(first_book, "-m", "pytest", "-q", "-p", "no:cacheprovider")
    of_the_guide.unlink()
    assert done.returncode == 0, done.stdout + done.stderr
    for name in ("two_balls_scene", "air_drag", "spring", "exponential_ladder"):
        assert len([*first_book.glob(f"tests/**/test_{name}.py")]) == 1


def test_site_of_a_new_book_has_its_figure_and_warns_of_placeholders(
    engine: Engine, first_book: Path, tmp_path: Path
) -> None:
    done = engine.run(
        first_book, "-m", "site_builder", "build", "--no-runtime", "--out", str(tmp_path / "site")
    )
    assert done.returncode == 0, done.stderr
    page = (tmp_path / "site" / "a-falling-ball" / "index.html").read_text("utf-8")
    assert 'data-simulation="falling-ball"' in page
    warned = re.findall(r"^(.+?):(\d+): warning: '(.+)' is still as", done.stderr, re.MULTILINE)
    assert {sentence for _, _, sentence in warned} == {each.strip(": ") for each in PLACEHOLDERS}
    for path, line, sentence in warned:
        text = (first_book / path).read_text("utf-8").splitlines()
        assert sentence in text[int(line) - 1]
    assert done.stderr.count("warning") == len(warned)


def test_code_of_a_new_book_passes_lint_and_contains_the_engine_wheel(
    engine: Engine, first_book: Path
) -> None:
    ours = "lint.isort.known-first-party = ['simulations', 'site_builder']"
    settings = ("--config", str(ROOT / "pyproject.toml"), "--config", ours, "simulations", "tests")
    for command in (["format", "--check"], ["check"]):
        done = run(first_book, sys.executable, "-m", "ruff", *command, *settings)
        assert done.returncode == 0, done.stdout
    assert [file.read_bytes() for file in first_book.glob("engine/*.whl")] == [
        engine.wheel.read_bytes()
    ]
    assert "file:" not in (first_book / "pyproject.toml").read_text("utf-8")


LOUD_WHEEL = """
import numpy as np

from simulations.engine.frame import Frame, Panel, Sound
from simulations.engine.scene import Scene
from simulations.engine.settings import slider
from dataclasses import dataclass

@dataclass(frozen=True, slots=True)
class Settings:
    angle: int = slider("Angle", 0, 0, 360, 1)
    loudness: float = slider("Loudness", 0.5, 0.0, 1.0, 0.1)
    idle: int = slider("Idle", 0, 0, 9, 1)

def draw(settings, _outputs):
    grey = int(100 + 100 * np.cos(np.radians(settings.angle)))
    panel = Panel("wheel", "Wheel", 400, 300, raster=np.full((3, 4, 4), grey, np.uint8))
    tone = Sound(np.full(9, settings.loudness, np.float32))
    return Frame((panel,), (), "A wheel.", sound=tone)

SCENE = Scene("two-balls", "Two Balls", Settings, draw)
"""


def test_tests_of_a_new_book_find_a_control_without_effect(
    engine: Engine, first_book: Path, tmp_path: Path
) -> None:
    book = shutil.copytree(first_book, tmp_path / "book", ignore=shutil.ignore_patterns("build"))
    (book / "simulations" / "scenes" / "two_balls.py").write_text(LOUD_WHEEL, encoding="utf-8")
    done = engine.run(book, "-m", "pytest", "-q", "-k", "two-balls or two_balls")
    failed = [line for line in done.stdout.splitlines() if line.startswith("FAILED")]
    assert [line.partition("[")[2].partition("]")[0] for line in failed] == ["idle"], done.stdout


def sources_of(book: Path) -> dict[Path, bytes]:
    """The book's sources without caches, which other tests of this book write meanwhile."""
    made = {"build", "__pycache__"}
    return {
        file: file.read_bytes()
        for file in book.rglob("*")
        if file.is_file()
        and not any(part in made or part.startswith(".") for part in file.relative_to(book).parts)
    }


def test_existing_file_is_never_overwritten(first_book: Path) -> None:
    before = sources_of(first_book)
    for kind, name in PIECES_MADE:
        with pytest.raises(ScaffoldError, match="is there already; legal: "):
            make_new(first_book, kind, name)
    assert sources_of(first_book) == before


WRITERS: Mapping[str, Callable[[Path], object]] = {
    "new chapter": lambda root: make_new(root, "chapter", "two-balls"),
    "bench": lambda root: write({"ladders": [*range(9000)]}, root / DATA),
}
"""Commands that change sources."""


@pytest.fixture
def sources(tmp_path: Path) -> Path:
    (tmp_path / "content").mkdir()
    outline = f"chapters = []\n{'# A comment.\n' * 1000}"
    (tmp_path / OUTLINE).write_text(outline, encoding="utf-8")
    (tmp_path / DATA).write_text("{}", encoding="utf-8")
    return tmp_path


@pytest.mark.parametrize("command", WRITERS)
def test_sources_stay_unchanged_when_the_disk_is_full(command: str, sources: Path) -> None:
    before = {file: file.read_bytes() for file in sources.rglob("*.*")}
    limits = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (9000, limits[1]))
    try:
        with pytest.raises(OSError, match="File too large"):
            WRITERS[command](sources)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limits)
    assert {file: file.read_bytes() for file in sources.rglob("*.*")} == before


@pytest.mark.parametrize("command", WRITERS)
def test_linked_source_stays_a_link_and_keeps_its_permissions(command: str, sources: Path) -> None:
    elsewhere = (sources / "content").rename(sources / "elsewhere")
    (sources / "content").mkdir()
    for file in elsewhere.iterdir():
        file.chmod(0o640)
        (sources / "content" / file.name).symlink_to(file)
    before = {file: file.read_bytes() for file in elsewhere.iterdir()}
    WRITERS[command](sources)
    assert {file: file.read_bytes() for file in before} != before
    assert {file.stat().st_mode & 0o777 for file in before} == {0o640}
    assert all((sources / "content" / file.name).is_symlink() for file in before)


def test_new_book_in_a_non_empty_folder_is_refused(tmp_path: Path) -> None:
    folder = tmp_path / "full"
    folder.mkdir()
    (folder / "thesis.tex").write_text("years of work")
    with pytest.raises(ScaffoldError, match="is not empty; legal: a folder that is empty"):
        make_book(folder)
    assert [file.name for file in folder.iterdir()] == ["thesis.tex"]


@pytest.mark.parametrize("text", ["Falling", "falling_ball", "2-balls", "a b", "", "ball-", "../x"])
def test_name_unfit_for_a_file_or_id_is_refused(text: str) -> None:
    with pytest.raises(ScaffoldError, match="legal: small letters and digits"):
        read_name("scene", text)


@pytest.mark.parametrize(
    ("kind", "name", "message"),
    [
        *((kind, "No Name", f"{kind} 'No Name'; legal") for kind in PIECES),
        ("model", "lambda", "'lambda' is a word of Python's own"),
        ("ladder", "sums", "simulations/ladders/sums is there already"),
    ],
)
def test_piece_with_an_invalid_or_existing_name_is_refused(
    tmp_path: Path, kind: str, name: str, message: str
) -> None:
    (tmp_path / "content").mkdir()
    (tmp_path / "content" / "book.toml").write_text("chapters = []\n")
    (tmp_path / "content" / "01-a-fall.md").write_text("Text.\n")
    (tmp_path / "simulations" / "ladders" / "sums").mkdir(parents=True)
    with pytest.raises(ScaffoldError, match=message):
        make_new(tmp_path, kind, name)


def test_version_of_a_wheel_names_the_commit_of_its_own_repository(tmp_path: Path) -> None:
    file = tmp_path / "engine" / "site_builder" / "version.py"
    file.parent.mkdir(parents=True)
    file.write_text((ROOT / "site_builder" / "version.py").read_text("utf-8"), encoding="utf-8")

    def git(folder: Path, *words: str) -> str:
        who = ("-c", "user.name=a", "-c", "user.email=a@b")
        return run(folder, "git", *who, *words).stdout.strip()

    def version() -> str:
        return str(runpy.run_path(str(file))["with_commit"]())

    git(tmp_path, "init")
    git(tmp_path, "commit", "--allow-empty", "-m", "Another repository around it")
    assert version() == __version__
    git(tmp_path / "engine", "init")
    git(tmp_path / "engine", "add", ".")
    git(tmp_path / "engine", "commit", "-m", "Begin")
    commit = git(tmp_path / "engine", "rev-parse", "--short=8", "HEAD")
    assert version() == f"{__version__}+g{commit}"
    file.write_text(f"{file.read_text('utf-8')}\n", encoding="utf-8")
    assert version() == f"{__version__}+g{commit}.dirty"


@pytest.mark.deep
def test_upgrade_of_the_engine_takes_effect_in_a_book(engine: Engine, tmp_path: Path) -> None:
    folder, own = tmp_path / "engine", new_engine(tmp_path / "environment")
    folder.mkdir()
    for part in PARTS:
        copy = shutil.copytree if (ROOT / part).is_dir() else shutil.copy2
        copy(ROOT / part, folder / part)
    version = folder / "site_builder" / "version.py"
    changed = re.sub(r'__version__ = ".*"', '__version__ = "99.0"', version.read_text("utf-8"))
    version.write_text(changed, encoding="utf-8")
    assert own.install(engine.wheel).returncode == 0
    assert engine.run(tmp_path, "-m", "site_builder", "new", "book", "book").returncode == 0
    assert own.install(build_wheel(folder, tmp_path / "wheels")).returncode == 0
    assert own.run(tmp_path, "-m", "site_builder", "--version").stdout == "site_builder 99.0\n"
    done = own.run(tmp_path / "book", "-m", "site_builder", "check")
    assert done.returncode == 0, done.stderr


@pytest.mark.deep
def test_new_book_needs_only_python_and_make(engine: Engine, tmp_path: Path) -> None:
    """All packages come from the package index, as for an author."""
    assert engine.run(tmp_path, "-m", "site_builder", "new", "book", "book").returncode == 0
    for target in ("test", "site", "pdf", "epub", "notebooks", "questions"):
        done = run(tmp_path / "book", "make", target)
        assert done.returncode == 0, done.stdout + done.stderr
    assert (tmp_path / "book" / "build" / "site" / "a-falling-ball" / "index.html").is_file()
