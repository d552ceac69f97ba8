"""What searches, from packages that ``package-lock.json`` here pins; fetched once and kept."""

import json
import tempfile
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from platformdirs import user_cache_path

from site_builder.editor.bundle import Package
from site_builder.editor.npm import NodeError, install_packages
from site_builder.runtime.store import made_once, sha256

HERE = Path(__file__).parent
PARTS = {
    "minisearch.js": "minisearch/dist/es/index.js",
    "stemmer.js": "stemmer/index.js",
}
"""Files of the library, and where the packages have them: modules that import nothing."""
LICENCES = {"minisearch": "LICENSE.txt", "stemmer": "license"}


class SearchLibraryError(RuntimeError):
    """The packages could not be had."""


@dataclass(frozen=True, slots=True)
class SearchLibrary:
    """The scripts of the library by name; none where they could not be had."""

    scripts: Mapping[str, Path]
    packages: tuple[Package, ...] = ()


def fetch_library(kept: Path | None = None) -> SearchLibrary:
    """The library, from the folder ``kept`` where it was had before.

    Raises
    ------
    SearchLibraryError
        Where it is not kept and the packages cannot be had. The message has npm's own words.
    """
    folder = kept or user_cache_path("image-formation", appauthor=False) / "search"
    recipe = sha256((HERE / "package-lock.json").read_bytes() + repr(PARTS).encode())
    files = made_once(folder, recipe, _fetch)
    packages = json.loads(files["packages.json"].read_bytes())
    return SearchLibrary(
        {name: files[name] for name in PARTS}, tuple(Package(**item) for item in packages)
    )


def _fetch() -> Mapping[str, bytes]:
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)
        try:
            install_packages(HERE, folder)
        except NodeError as error:
            raise SearchLibraryError(f"its packages could not be had from npm: {error}") from None
        packages = folder / "node_modules"
        told = [_described(packages / name, licence) for name, licence in LICENCES.items()]
        return {
            **{name: (packages / path).read_bytes() for name, path in PARTS.items()},
            "packages.json": json.dumps(told).encode(),
        }


def _described(package: Path, licence: str) -> dict[str, str]:
    about = json.loads((package / "package.json").read_bytes())
    text = (package / licence).read_text(encoding="utf-8")
    return {key: about[key] for key in ("name", "version", "license")} | {"text": text}
