"""Web fonts: the book's faces, cut down to what it prints and packed as woff2.

Cutting takes seconds, hence a cache keyed by everything it depends on.
"""

import io
from collections.abc import Mapping, Sequence
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING

import fontTools
import platformdirs

from site_builder.output.font_faces import FACES, Face
from site_builder.runtime.store import made_once, sha256

if TYPE_CHECKING:
    from fontTools.ttLib import TTFont

RECIPE = 3
"""Counts changes of `cut`, so that a cache filled by an earlier version is not used."""


def subset_fonts(faces: Sequence[Face] = FACES, cache: Path | None = None) -> Mapping[str, bytes]:
    """The book's web fonts by file name, ready to be written beside the style sheet.

    Parameters
    ----------
    faces
        What is cut.
    cache
        Folder for cut faces; by default in the user's cache folder.

    Raises
    ------
    FileNotFoundError
        A package that should carry a face does not.
    """
    folder = cache or platformdirs.user_cache_path("image-formation") / "fonts"
    return {face.file: _cut_once(face, folder) for face in faces}


def _cut_once(face: Face, folder: Path) -> bytes:
    source = source_file(face).read_bytes()
    recipe = (RECIPE, face.family, face.style, sorted(face.characters), face.features)
    key = sha256(repr((*recipe, fontTools.version)).encode() + source)
    return made_once(folder, key, lambda: {face.file: cut(face, source)})[face.file].read_bytes()


def source_file(face: Face) -> Path:
    """What it is cut from. Its package is found but not run: some read all their fonts first."""
    found = find_spec(face.package)
    if not (found and found.origin):
        raise FileNotFoundError(f"{face.package} carries {face.source} and is not installed")
    return Path(found.origin).parent / face.source


def cut(face: Face, source: bytes) -> bytes:
    """The font file ``source`` reduced to the characters and features of ``face``, as woff2."""
    from fontTools import subset  # it is long to load, and needed once on each machine
    from fontTools.ttLib import TTFont

    options = subset.Options(
        flavor="woff2",
        layout_features=list(face.features),
        hinting=False,
        notdef_outline=True,
        name_IDs=[0, 1, 2, 3, 4, 5, 6, 13, 14],
        # A build must give the same bytes twice, and drop tables that only desktop tools read.
        recalc_timestamp=False,
        drop_tables=[*subset.Options().drop_tables, "DSIG"],
    )
    font = TTFont(io.BytesIO(source), recalcTimestamp=False)
    subsetter = subset.Subsetter(options)
    subsetter.populate(unicodes=face.characters)
    subsetter.subset(font)
    _rename(font, face.family, face.style)
    _offer_script_forms(font)
    _keep_own_widths(font)
    packed = io.BytesIO()
    subset.save_font(font, packed, options)
    return packed.getvalue()


def _rename(font: "TTFont", family: str, style: str) -> None:
    full = f"{family} {style}"
    names = {1: family, 2: style, 3: full, 4: full, 6: full.replace(" ", "-")}
    for record in font["name"].names:
        if record.nameID in names:
            record.string = names[record.nameID]


def _keep_own_widths(font: "TTFont") -> None:
    """Give each glyph the width that its metrics state.

    Some are marked to take the width of a part: a “ would be as narrow as a ‘ in browsers that
    draw with FreeType, and tabular figures uneven.
    """
    from fontTools.ttLib.tables._g_l_y_f import USE_MY_METRICS

    outlines = font.get("glyf")
    for name in font.getGlyphOrder() if outlines else ():
        for part in getattr(outlines[name], "components", ()):
            part.flags &= ~USE_MY_METRICS


def _offer_script_forms(font: "TTFont") -> None:
    """Let style sheets ask for ``ssty``, the forms of indices and primes, whatever the script.

    The font offers it to the script ``math`` alone, which browsers do not set for MathML.
    """
    if "GSUB" not in font:
        return
    substitutions = font["GSUB"].table
    features = substitutions.FeatureList.FeatureRecord
    forms = [index for index, record in enumerate(features) if record.FeatureTag == "ssty"]
    for record in substitutions.ScriptList.ScriptRecord:
        system = record.Script.DefaultLangSys
        if system is not None:
            system.FeatureIndex = sorted({*system.FeatureIndex, *forms[:1]})
            system.FeatureCount = len(system.FeatureIndex)
