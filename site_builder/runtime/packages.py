"""Packages of Pyodide's release that a book declares, besides numpy."""

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from email.parser import BytesParser
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any
from zipfile import ZipFile

from site_builder.diagnostics.diagnostic import unknown
from site_builder.programs.node import Package
from site_builder.runtime.downloads import fetch_runtime
from site_builder.runtime.pinned import RELEASE_LOCK, RuntimeFile

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
