"""What searches, from packages that ``package-lock.json`` here pins."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from site_builder.programs.node import Package, installed_packages, read_package

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
    stemmers: Mapping[str, str] = field(default_factory=dict)
    """Names of scripts by language."""


def fetch_library(*languages: str) -> SearchLibrary:
    """The library for pages in these. Raises `NodeError` where it cannot be had."""
    packages = installed_packages(HERE) / "node_modules"
    stemmers = {language: f"stemmer-{language}.js" for language in languages}
    shipped = {
        "minisearch.js": SEARCH,
        **{name: STEMMERS[language] for language, name in stemmers.items()},
    }
    return SearchLibrary(
        {name: packages / path for name, path in shipped.items()},
        tuple(
            read_package(packages / name, licence)
            for name, licence in LICENCES.items()
            if any(path.startswith(f"{name}/") for path in shipped.values())
        ),
        stemmers,
    )
