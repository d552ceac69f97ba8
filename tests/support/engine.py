"""The engine as authors have it: a wheel of this repository, installed."""

import subprocess
import sys
import sysconfig
import venv
from dataclasses import dataclass
from pathlib import Path
from subprocess import CompletedProcess

QUIETLY = ("-m", "pip", "--disable-pip-version-check", "--quiet")


@dataclass(frozen=True, slots=True)
class Engine:
    """An environment that has the engine, and the packages of the suite beside it."""

    folder: Path

    @property
    def python(self) -> str:
        return str(self.folder / "bin" / "python")

    @property
    def wheel(self) -> Path:
        """The wheel that it was made from."""
        (wheel,) = (self.folder / "wheels").glob("*.whl")
        return wheel

    def run(self, book: Path, *words: str) -> CompletedProcess[str]:
        """Run ``python …`` in the book's folder."""
        return run(book, self.python, *words)

    def install(self, wheel: Path) -> CompletedProcess[str]:
        into = ("--python", self.python, "install", "--no-index", "--no-deps", "--no-compile")
        return run(wheel.parent, sys.executable, *QUIETLY, *into, str(wheel))


def make_engine(source: Path, folder: Path) -> CompletedProcess[str]:
    """A new environment in ``folder`` with the engine of the repository ``source``; the outcome of
    the last step."""
    return new_engine(folder).install(build_wheel(source, folder / "wheels"))


def new_engine(folder: Path) -> Engine:
    """Without an engine yet."""
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
