"""What searches, from packages that ``package-lock.json`` here pins."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from site_builder.npm import Package, installed_packages, read_package

HERE = Path(__file__).parent
SEARCH = "minisearch/dist/es/index.js"
STEMMERS = {"en": "stemmer/index.js", "de": "@orama/stemmers/dist/de.js"}
"""By language; where the packages have what is shipped: modules that import nothing."""
LICENCES = {
    "minisearch": "LICENSE.txt",
    "stemmer": "license",
    "@orama/stemmers": "LICENSE.md",
}


@dataclass(frozen=True, slots=True)
class SearchLibrary:
    """The scripts of the library by name; none where they could not be had."""

    scripts: Mapping[str, Path]
    packages: tuple[Package, ...] = ()


def fetch_library(language: str = "en") -> SearchLibrary:
    """The library for pages in ``language``. Raises `NodeError` where it cannot be had."""
    packages = installed_packages(HERE) / "node_modules"
    shipped = {"minisearch.js": SEARCH, "stemmer.js": STEMMERS[language]}
    return SearchLibrary(
        {name: packages / path for name, path in shipped.items()},
        tuple(
            read_package(packages / name, licence)
            for name, licence in LICENCES.items()
            if any(path.startswith(f"{name}/") for path in shipped.values())
        ),
    )
