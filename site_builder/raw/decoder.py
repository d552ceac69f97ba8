"""LibRaw in WebAssembly, from a package that ``package-lock.json`` here pins."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path

from site_builder.programs.node import Package, installed_packages, read_package

HERE = Path(__file__).parent
PACKAGE = "libraw-wasm"
FOLDER = "raw/"
"""Below the assets; `static/js/raw/worker.ts` names it."""
FILES = ("libraw.js", "libraw.wasm")
LICENCE = "CDDL 1.0"
"""One of LibRaw's two licences. The bindings have the package's licence, ISC."""


@dataclass(frozen=True, slots=True)
class RawDecoder:
    """The files of the decoder by name; none where they could not be had."""

    files: Mapping[str, Path]
    packages: tuple[Package, ...] = ()


def fetch_decoder() -> RawDecoder:
    """Raises `NodeError` where the package cannot be had."""
    folder = installed_packages(HERE) / "node_modules" / PACKAGE
    package = read_package(folder, str(HERE / "licence.txt"))
    files = {name: folder / "dist" / name for name in FILES}
    return RawDecoder(files, (replace(package, license=LICENCE),))
