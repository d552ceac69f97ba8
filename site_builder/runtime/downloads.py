"""Where the pinned files, and packages of Pyodide's release that a book declares, can be had from:
independent places with the same bytes."""

import json
import subprocess
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from email.parser import BytesParser
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any
from zipfile import ZipFile

from site_builder.diagnostics.diagnostic import announce, unknown
from site_builder.programs.node import Package, installed_packages
from site_builder.runtime import store as stores
from site_builder.runtime.store import PYODIDE_VERSION, RELEASE_LOCK, RUNTIME_FILES, RuntimeFile

type Source = Callable[[Sequence[RuntimeFile]], Iterator[tuple[RuntimeFile, bytes]]]
"""Yields each file with its bytes, unverified; may raise any exception."""

RELEASE_URL = f"https://cdn.jsdelivr.net/pyodide/v{PYODIDE_VERSION}/full/"
CARRIER = "open-webui==0.12.4"
"""A wheel that carries the same files, for machines that reach a package index only."""
CARRIED = {file: f"open_webui/frontend/pyodide/{file.name}" for file in RUNTIME_FILES}
TIMEOUT_SECONDS = 30


def official_release(wanted: Sequence[RuntimeFile]) -> Iterator[tuple[RuntimeFile, bytes]]:
    """The files of Pyodide's own release."""
    import urllib.request  # needed once on each machine

    for file in wanted:
        with urllib.request.urlopen(RELEASE_URL + file.name, timeout=TIMEOUT_SECONDS) as reply:
            yield file, reply.read()


def members(package: str, paths: Mapping[RuntimeFile, str]) -> Source:
    """Members of a wheel in the index that pip is set up for, read by range requests.

    The wheel is never installed, so its own ``requires-python`` does not matter.
    """

    def read(wanted: Sequence[RuntimeFile]) -> Iterator[tuple[RuntimeFile, bytes]]:
        from remotezip import RemoteZip  # here and below: slow to import, and needed once

        with RemoteZip(_wheel_url(package), timeout=TIMEOUT_SECONDS) as archive:
            for file in wanted:
                yield file, archive.read(paths[file])

    return read


def npm_registry(wanted: Sequence[RuntimeFile]) -> Iterator[tuple[RuntimeFile, bytes]]:
    """Files of Pyodide's package for Node; it has no packages of Python."""
    folder = installed_packages(Path(__file__).parent) / "node_modules" / "pyodide"
    for file in wanted:
        if (folder / file.name).is_file():
            yield file, (folder / file.name).read_bytes()


def _wheel_url(package: str) -> str:
    from unearth import PackageFinder

    settings = _pip_settings()
    finder = PackageFinder(
        index_urls=settings.get("index-url", "").split(), ignore_compatibility=True
    )
    for url in settings.get("extra-index-url", "").split():
        finder.add_index_url(url)
    for match in finder.find_matches(package, allow_yanked=True):
        if match.link.is_wheel and not match.link.is_file:
            return match.link.url_without_fragment
    raise LookupError(f"{package} is not in the package index")


def _pip_settings() -> dict[str, str]:
    """pip's own settings by short name; the environment wins over the files."""
    command = [sys.executable, "-m", "pip", "config", "list"]
    listing = subprocess.run(command, capture_output=True, text=True, check=False).stdout
    settings: dict[str, str] = {}
    for line in sorted(listing.splitlines(), key=lambda line: line.startswith(":env:")):
        key, _, value = line.partition("=")
        settings[key.rpartition(".")[2]] = value.strip("'\"")
    return settings


SOURCES: tuple[tuple[str, Source], ...] = (
    ("Pyodide's release", official_release),
    ("the package index", members(CARRIER, CARRIED)),
    ("npm", npm_registry),
)


class RuntimeFetchError(RuntimeError):
    """No source gave the pinned bytes. The message names each attempt and the ways out."""


def fetch_runtime(
    store: Path | None = None,
    sources: Sequence[tuple[str, Source]] = SOURCES,
    files: Sequence[RuntimeFile] = RUNTIME_FILES,
) -> Mapping[str, Path]:
    """All runtime files by name. Raises `RuntimeFetchError`: see `fetch_files`."""
    return fetch_files(files, sources, store)


def fetch_files(
    files: Sequence[RuntimeFile], sources: Sequence[tuple[str, Source]], store: Path | None = None
) -> Mapping[str, Path]:
    """Files by name, each verified against its SHA-256.

    Nothing is requested for files whose cached copy is intact; a damaged copy is fetched again.
    Sources are tried in order, the next one only for what is still missing.

    Raises
    ------
    RuntimeFetchError
        Where some file is neither cached nor to be had.
    """
    folder = store or stores.default_store()
    missing = [file for file in files if not stores.is_intact(folder, file)]
    problems: list[str] = []
    if missing:
        announce(f"fetching {', '.join(file.name for file in missing)}")
    for label, source in sources:
        if not missing:
            break
        problems += _take(source, label, missing, folder)
        missing = [file for file in missing if not stores.is_intact(folder, file)]
    if missing:
        raise RuntimeFetchError(_explain(missing, problems, folder))
    return {file.name: stores.location(folder, file) for file in files}


def _take(source: Source, label: str, missing: Sequence[RuntimeFile], folder: Path) -> list[str]:
    """Store what ``source`` gives correctly; return what went wrong, one line each."""
    problems = []
    try:
        for file, content in source(missing):
            received = stores.sha256(content)
            if received == file.sha256:
                stores.put(folder, file.name, content)
            else:
                problems.append(
                    f"{label}: {file.name} has SHA-256 {received[:12]}… ({len(content)} bytes), "
                    f"expected {file.sha256[:12]}…"
                )
    except Exception as error:  # any library below may fail in its own way; the next source may not
        problems.append(f"{label}: {type(error).__name__}: {error}")
    return problems


def _explain(missing: Sequence[RuntimeFile], problems: Sequence[str], folder: Path) -> str:
    lines = [
        f"cannot get {', '.join(file.name for file in missing)}",
        *(f"  tried {problem}" for problem in problems),
        "Connect to the internet once: the files are cached and never requested again.",
        "Or put each file where it is looked for:",
        *(f"  {stores.location(folder, file)}" for file in missing),
    ]
    return "\n".join(lines)


NUMPY = "numpy"


class PackageError(ValueError):
    """The release has no such package, or it cannot be packed."""


@dataclass(frozen=True, slots=True)
class Wheel:
    """A package of the release, fetched."""

    path: Path
    package: Package


def fetch_packages(names: Sequence[str], store: Path) -> tuple[Wheel, ...]:
    """The packages of these names and all that they need, without numpy.

    Raises
    ------
    PackageError
        Where the release has none of a name, or it needs more than Python.
    RuntimeFetchError
        Where a file is neither cached nor to be had.
    """
    if not names:
        return ()
    lock = fetch_runtime(store, files=[RELEASE_LOCK])[RELEASE_LOCK.name]
    listed: Mapping[str, Any] = json.loads(lock.read_text(encoding="utf-8"))["packages"]
    files = [
        RuntimeFile(listed[name]["file_name"], listed[name]["sha256"])
        for name in needed(names, listed)
    ]
    fetched = fetch_runtime(store, files=files)
    return tuple(Wheel(fetched[file.name], read_package(fetched[file.name])) for file in files)


def needed(names: Sequence[str], listed: Mapping[str, Any]) -> list[str]:
    """``names`` and all that they need, without numpy, in alphabetical order. Raises
    `PackageError`."""
    found: set[str] = set()
    waiting = [*names]
    while waiting:
        name = waiting.pop()
        if name not in listed:
            raise PackageError(unknown("package", name, listed))
        if listed[name]["package_type"] != "package":
            expected = "packages that need none"
            raise PackageError(f"package {name!r} is a shared library; legal: {expected}")
        if name not in found:
            found.add(name)
            waiting += listed[name]["depends"]
    return sorted(found - {NUMPY})


def read_package(wheel: Path) -> Package:
    """What a wheel says of itself, with its licences."""
    with ZipFile(wheel) as archive:
        about = {name: name.split("/") for name in archive.namelist() if ".dist-info/" in name}
        (told,) = (name for name, path in about.items() if path[1:] == ["METADATA"])
        fields = BytesParser().parsebytes(archive.read(told), headersonly=True)
        texts = [
            archive.read(name).decode("utf-8", errors="replace")
            for name, path in about.items()
            if path[-1] and any(word in name.lower() for word in ("licen", "copying", "notice"))
        ]
    terms = fields.get("License-Expression") or fields.get("License") or ""
    pages = [fields.get("Home-page"), *fields.get_all("Project-URL", [])]
    home = next((page.rpartition(" ")[2] for page in pages if page), "")
    licence = terms.partition("\n")[0]
    return Package(fields["Name"], fields["Version"], licence, "\n\n".join(texts), home)


def differing(packages: Sequence[Package]) -> list[str]:
    """What to say of each package that is installed here in another version than in the browser."""
    said = []
    for name, there in ((package.name, package.version) for package in packages):
        try:
            here = version(name)
        except PackageNotFoundError:  # what a scene imports of it, the build reports
            continue
        if here != there:
            legal = f"the same on both sides, '{name}=={there}' in pyproject.toml"
            said.append(f"{name} is {here} here and {there} in the browser; better: {legal}")
    return said
