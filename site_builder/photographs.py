"""Photographs that a book shows: fetched out of packages, pinned, and packed for its simulations.

A book lists them in ``simulations/pictures/photographs/photographs.toml``; beside it each becomes
a module that is never committed.
"""

import base64
import tomllib
import zlib
from dataclasses import dataclass
from itertools import groupby
from pathlib import Path

from site_builder.files.folders import bytes_hash, replace_file
from site_builder.runtime.downloads import fetch_files, members
from site_builder.runtime.store import RuntimeFile

FOLDER = "simulations/pictures/photographs"
LIST = "photographs.toml"
MODULE = '''"""{title}, by {author}: {licence}."""

from functools import cache

import numpy as np
from numpy.typing import NDArray

from simulations.pictures.packed import unpack


@cache
def codes() -> NDArray[np.uint8]:
    """({height}, {width}, 3) sRGB. Read-only."""
    return unpack(PACKED, {width}, {height})


PACKED = "{packed}"
# {mark}
'''


@dataclass(frozen=True, slots=True, kw_only=True)
class Credit:
    """A photograph, where it comes from, and under which terms."""

    package: str
    """Requirement of the wheel that carries it."""
    file: str
    """Its path in the wheel."""
    sha256: str
    cut: tuple[float, float, float, float]
    """The part that is shown, in px of the file: left, top, right, bottom."""
    size: tuple[int, int]
    """Width and height to which that is scaled, px."""
    title: str
    author: str
    licence: str
    address: str

    @property
    def pinned(self) -> RuntimeFile:
        return RuntimeFile(Path(self.file).name, self.sha256)

    @property
    def mark(self) -> str:
        """Ends a module that is made of this entry."""
        return bytes_hash(f"{MODULE}{self}".encode()).hex()


def credits_of(root: Path) -> dict[str, Credit]:
    """The photographs of the book in ``root`` by the names of their modules."""
    listed = root / FOLDER / LIST
    if not listed.is_file():
        return {}
    found = tomllib.loads(listed.read_text(encoding="utf-8"))
    return {name: Credit(**fields) for name, fields in found.items()}


def prepare_photographs(root: Path) -> None:
    """Write the modules that are missing, or of other entries of the list than the present ones.

    Raises `RuntimeFetchError` where a photograph is neither cached nor to be had.
    """
    photographs = credits_of(root)
    places = {name: root / FOLDER / f"{name}.py" for name in photographs}
    stale = {
        name: photographs[name]
        for name, place in places.items()
        if not place.is_file() or photographs[name].mark not in place.read_text(encoding="utf-8")
    }
    for package, some in groupby(stale.items(), key=lambda item: item[1].package):
        wanted = dict(some)
        source = (package, members(package, {each.pinned: each.file for each in wanted.values()}))
        files = fetch_files([each.pinned for each in wanted.values()], [source])
        for name, each in wanted.items():
            text = module_of(each, files[each.pinned.name])
            replace_file(places[name], text.encode())


def module_of(photograph: Credit, file: Path) -> str:
    """The module of a photograph, given the file that was fetched."""
    import numpy as np  # here and below: slow to import, and needed once
    from PIL import Image

    with Image.open(file) as whole:
        shown = whole.convert("RGB").resize(
            photograph.size, Image.Resampling.LANCZOS, photograph.cut
        )
    red, green, blue = np.moveaxis(np.asarray(shown) >> 1, 2, 0)
    planes = np.stack((green, red - green, blue - green))
    steps = np.diff(np.diff(planes, axis=2, prepend=np.uint8(0)), axis=1, prepend=np.uint8(0))
    packed = base64.b64encode(zlib.compress(steps.tobytes(), 9)).decode()
    width, height = photograph.size
    about = {name: getattr(photograph, name) for name in ("title", "author", "licence")}
    return MODULE.format(**about, packed=packed, width=width, height=height, mark=photograph.mark)
