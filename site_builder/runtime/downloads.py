"""Where the pinned files can be had from: independent places with the same bytes."""

import subprocess
import sys
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

from site_builder.programs.node import installed_packages
from site_builder.runtime.pinned import PYODIDE_VERSION, RuntimeFile

type Source = Callable[[Sequence[RuntimeFile]], Iterator[tuple[RuntimeFile, bytes]]]
"""Yields each file with its bytes, unverified; may raise any exception."""

RELEASE_URL = f"https://cdn.jsdelivr.net/pyodide/v{PYODIDE_VERSION}/full/"
CARRIER = "open-webui==0.12.4"
"""A wheel that carries the same files, for machines that reach a package index only."""
CARRIER_FOLDER = "open_webui/frontend/pyodide/"
TIMEOUT_SECONDS = 30


def official_release(wanted: Sequence[RuntimeFile]) -> Iterator[tuple[RuntimeFile, bytes]]:
    """The files of Pyodide's own release."""
    import urllib.request  # needed once on each machine

    for file in wanted:
        with urllib.request.urlopen(RELEASE_URL + file.name, timeout=TIMEOUT_SECONDS) as reply:
            yield file, reply.read()


def package_index(wanted: Sequence[RuntimeFile]) -> Iterator[tuple[RuntimeFile, bytes]]:
    """Members of a wheel in the index that pip is set up for, read by range requests.

    The wheel is never installed, so its own ``requires-python`` does not matter.
    """
    from remotezip import RemoteZip  # here and below: slow to import, and needed once

    with RemoteZip(_carrier_url(), timeout=TIMEOUT_SECONDS) as archive:
        for file in wanted:
            yield file, archive.read(CARRIER_FOLDER + file.name)


def npm_registry(wanted: Sequence[RuntimeFile]) -> Iterator[tuple[RuntimeFile, bytes]]:
    """Files of Pyodide's package for Node; it has no packages of Python."""
    folder = installed_packages(Path(__file__).parent) / "node_modules" / "pyodide"
    for file in wanted:
        if (folder / file.name).is_file():
            yield file, (folder / file.name).read_bytes()


def _carrier_url() -> str:
    from unearth import PackageFinder

    settings = _pip_settings()
    finder = PackageFinder(
        index_urls=settings.get("index-url", "").split(), ignore_compatibility=True
    )
    for url in settings.get("extra-index-url", "").split():
        finder.add_index_url(url)
    for match in finder.find_matches(CARRIER, allow_yanked=True):
        if match.link.is_wheel and not match.link.is_file:
            return match.link.url_without_fragment
    raise LookupError(f"{CARRIER} is not in the package index")


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
    ("the package index", package_index),
    ("npm", npm_registry),
)
