"""The engine as authors have it, an installed wheel, and sites shared by all workers."""

import subprocess
import sys
import sysconfig
import venv
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from subprocess import CompletedProcess

import pytest
from filelock import FileLock

QUIETLY = ("-m", "pip", "--disable-pip-version-check", "--quiet")


@dataclass(frozen=True, slots=True)
class Engine:
    """A virtual environment with the engine and the packages of the test suite."""

    folder: Path

    @property
    def python(self) -> str:
        return str(self.folder / "bin" / "python")

    @property
    def wheel(self) -> Path:
        """The wheel that was installed."""
        (wheel,) = (self.folder / "wheels").glob("*.whl")
        return wheel

    def run(self, book: Path, *words: str) -> CompletedProcess[str]:
        """Run ``python …`` in the book's folder."""
        return run(book, self.python, *words)

    def install(self, wheel: Path) -> CompletedProcess[str]:
        into = ("--python", self.python, "install", "--no-index", "--no-deps", "--no-compile")
        return run(wheel.parent, sys.executable, *QUIETLY, *into, str(wheel))


def make_engine(source: Path, folder: Path) -> CompletedProcess[str]:
    """Create an environment in ``folder`` with the engine of the repository ``source``; returns the
    result of the installation."""
    return new_engine(folder).install(build_wheel(source, folder / "wheels"))


def new_engine(folder: Path) -> Engine:
    """An environment in which the engine is not installed yet."""
    venv.create(folder, symlinks=True)
    own = sysconfig.get_path("purelib", vars={"base": str(folder), "platbase": str(folder)})
    suite = f"import site; site.addsitedir({sysconfig.get_path('purelib')!r})"
    (Path(own) / "suite.pth").write_text(suite, encoding="utf-8")
    return Engine(folder)


def build_wheel(source: Path, out: Path) -> Path:
    how = ("-m", "build", "--wheel", "--no-isolation", "--outdir", str(out))
    done = run(source, sys.executable, *how)
    assert done.returncode == 0, done.stdout + done.stderr
    (wheel,) = out.glob("*.whl")
    return wheel


def run(folder: Path, *command: str) -> CompletedProcess[str]:
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)


def built_once(
    folders: pytest.TempPathFactory,
    worker_id: str,
    name: str,
    build: Callable[[Path], CompletedProcess[str]],
) -> Path:
    """The folder that ``build`` writes, built by the first worker that needs it; a failed build
    fails the test with its message."""
    base = folders.getbasetemp()
    out = (base if worker_id == "master" else base.parent) / name / "site"
    with FileLock(f"{out.parent}.lock"):
        if not out.exists():
            done = build(out)
            assert done.returncode == 0, done.stderr
    return out
