"""What searches, from packages that ``package-lock.json`` here pins; fetched once and kept."""

import json
import tempfile
from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from platformdirs import user_cache_path

from site_builder.editor.bundle import Package
from site_builder.editor.npm import NodeError, install_packages
from site_builder.runtime.store import made_once, sha256

HERE = Path(__file__).parent
SEARCH = "minisearch/dist/es/index.js"
STEMMERS = {"en": "stemmer/index.js", "de": "@orama/stemmers/dist/de.js"}
"""By language; where the packages have what is shipped: modules that import nothing."""
LICENCES = {
    "minisearch": "LICENSE.txt",
    "stemmer": "license",
    "@orama/stemmers": "LICENSE.md",
}


class SearchLibraryError(RuntimeError):
    """The packages could not be had."""


@dataclass(frozen=True, slots=True)
class SearchLibrary:
    """The scripts of the library by name; none where they could not be had."""

    scripts: Mapping[str, Path]
    packages: tuple[Package, ...] = ()


def parts(language: str) -> dict[str, str]:
    """Files of the library, and where the packages have them."""
    return {"minisearch.js": SEARCH, "stemmer.js": STEMMERS[language]}


def fetch_library(language: str = "en", kept: Path | None = None) -> SearchLibrary:
    """The library for pages in ``language``, from the folder ``kept`` where it was had before.

    Raises
    ------
    SearchLibraryError
        Where it is not kept and the packages cannot be had. The message has npm's own words.
    """
    folder = kept or user_cache_path("image-formation", appauthor=False) / "search"
    shipped = parts(language)
    recipe = sha256((HERE / "package-lock.json").read_bytes() + repr(shipped).encode())
    files = made_once(folder, recipe, partial(_fetch, shipped))
    packages = json.loads(files["packages.json"].read_bytes())
    return SearchLibrary(
        {name: files[name] for name in shipped}, tuple(Package(**item) for item in packages)
    )


def _fetch(shipped: Mapping[str, str]) -> Mapping[str, bytes]:
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)
        try:
            install_packages(HERE, folder)
        except NodeError as error:
            raise SearchLibraryError(f"its packages could not be had from npm: {error}") from None
        packages = folder / "node_modules"
        told = [
            _described(packages / name, licence)
            for name, licence in LICENCES.items()
            if any(path.startswith(f"{name}/") for path in shipped.values())
        ]
        return {
            **{name: (packages / path).read_bytes() for name, path in shipped.items()},
            "packages.json": json.dumps(told).encode(),
        }


def _described(package: Path, licence: str) -> dict[str, str]:
    about = json.loads((package / "package.json").read_bytes())
    text = (package / licence).read_text(encoding="utf-8")
    return {key: about[key] for key in ("name", "version", "license")} | {"text": text}
