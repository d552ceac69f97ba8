"""Web fonts: the book's faces, cut down to what it prints and packed as woff2.

The faces come from installed packages: Source Serif and Source Sans (Adobe) for text and
controls, STIX Two Math for formulae; all under the SIL Open Font License. A subset is a modified
version, and ``Source`` is a reserved name, so the cut faces are renamed ``Book …`` while copyright
and licence stay in them. Cutting takes seconds, hence a cache keyed by everything it depends on.
"""

import hashlib
import io
from collections.abc import Mapping
from dataclasses import dataclass
from importlib.resources import files
from pathlib import Path

import fontTools
import platformdirs
from fontTools import subset
from fontTools.ttLib import TTFont
from fontTools.ttLib.tables._g_l_y_f import USE_MY_METRICS


def _span(*bounds: tuple[int, int]) -> frozenset[int]:
    return frozenset(code for first, last in bounds for code in range(first, last + 1))


def _each(characters: str) -> frozenset[int]:
    return frozenset(map(ord, characters))


LATIN = _span((0x20, 0x7E), (0xA0, 0x17F))
GREEK = _span((0x391, 0x3A1), (0x3A3, 0x3C9)) | _each("ϑϕϵ")
PUNCTUATION = _span((0x2002, 0x200A), (0x202F, 0x202F)) | _each("‐‑–—‘’‚“”„†‡•…‰′″‹›€№™")
INLINE_MATHS = _each("←↑→↓↔⇒−×÷±·∙√∞≈≠≤≥∂∆∏∑∫∈∥⟂ℓ°⁻⁺ⁿ⁰¹²³⁴⁵⁶⁷⁸⁹₀₁₂₃₄₅₆₇₈₉½⅓⅔¼¾✓✗")
TEXT = LATIN | GREEK | PUNCTUATION | INLINE_MATHS
FORMULAE = (
    _span((0x20, 0x7E), (0xA0, 0xFF))
    | GREEK
    | PUNCTUATION
    | INLINE_MATHS
    | _span(
        (0x2C6, 0x2DD),  # accents: hat, caron, breve, dot, ring, tilde
        (0x300, 0x308),  # the same, combining
        (0x2016, 0x2016),  # ‖
        (0x2032, 0x2037),  # primes
        (0x2061, 0x2064),  # invisible operators
        (0x20D7, 0x20D7),  # vector arrow
        (0x2190, 0x21FF),  # arrows
        (0x2200, 0x22FF),  # operators
        (0x2308, 0x230B),  # ceiling and floor
        (0x23B4, 0x23B5),
        (0x23DC, 0x23E1),  # braces over and under
        (0x27E6, 0x27EB),  # angle brackets
        (0x27F5, 0x27FC),  # long arrows
        (0x1D400, 0x1D503),  # alphabets: bold, italic, bold italic, script
        (0x1D538, 0x1D56B),  # double-struck
        (0x1D6A4, 0x1D755),  # dotless; Greek bold, italic, bold italic
        (0x1D7CE, 0x1D7D7),  # bold digits
    )
    | _each("ℂℎℏℐℒℕℙℚℛℝℤ□◦⊤⊥⋅⋆⟨⟩⟵⟶⟷⦅⦆")
)

RECIPE = 3
"""Counts changes of `cut`, so that a cache filled by an earlier version is not used."""

BASIC_FEATURES = ("ccmp", "kern", "liga", "lnum", "locl", "mark", "mkmk", "onum", "pnum", "tnum")
SMALL_CAPITALS = ("c2sc", "smcp")
FORMULA_FEATURES = ("ccmp", "dtls", "flac", "kern", "mark", "mkmk", "ssty")


@dataclass(frozen=True, slots=True)
class Face:
    """One web font: where its outlines come from and what is kept of them."""

    file: str
    """Name of the woff2 file, as the style sheet refers to it."""
    package: str
    """Installed package that carries the source."""
    source: str
    """Path of the source inside the package."""
    family: str
    """Family name written into the cut face."""
    style: str
    """Style name written into the cut face."""
    characters: frozenset[int] = TEXT
    """Code points to keep, where the source has them."""
    features: tuple[str, ...] = BASIC_FEATURES
    """OpenType features to keep."""


def _serif(file: str, source: str, style: str, *extra_features: str) -> Face:
    source_path = f"files/SourceSerifPro-{source}.ttf"
    features = BASIC_FEATURES + extra_features
    return Face(file, "font_source_serif_pro", source_path, "Book Serif", style, TEXT, features)


def _sans(file: str, source: str, style: str) -> Face:
    source_path = f"files/SourceSansPro-{source}.ttf"
    return Face(file, "font_source_sans_pro", source_path, "Book Sans", style)


FACES = (
    _serif("serif-regular.woff2", "Regular", "Regular", *SMALL_CAPITALS),
    _serif("serif-italic.woff2", "It", "Italic"),
    _serif("serif-semibold.woff2", "Semibold", "Semibold"),
    _serif("serif-semibold-italic.woff2", "SemiboldIt", "Semibold Italic"),
    _sans("sans-regular.woff2", "Regular", "Regular"),
    _sans("sans-italic.woff2", "It", "Italic"),
    _sans("sans-semibold.woff2", "Semibold", "Semibold"),
    Face(
        "maths.woff2",
        "ziamath",
        "fonts/STIXTwoMath-Regular.ttf",
        "Book Maths",
        "Regular",
        FORMULAE,
        FORMULA_FEATURES,
    ),
)


def subset_fonts(cache: Path | None = None) -> Mapping[str, bytes]:
    """The book's web fonts by file name, ready to be written beside the style sheet.

    Parameters
    ----------
    cache
        Folder that keeps cut faces between builds; the user's cache folder unless given.

    Raises
    ------
    FileNotFoundError
        A package that should carry a face does not.
    """
    folder = cache or platformdirs.user_cache_path("image-formation") / "fonts"
    return {face.file: _cut_once(face, folder) for face in FACES}


def _cut_once(face: Face, cache: Path) -> bytes:
    source = files(face.package).joinpath(face.source).read_bytes()
    kept = cache / f"{_fingerprint(face, source)}.woff2"
    if kept.is_file():
        return kept.read_bytes()
    packed = cut(face, source)
    cache.mkdir(parents=True, exist_ok=True)
    unfinished = kept.with_suffix(".part")
    unfinished.write_bytes(packed)
    unfinished.replace(kept)
    return packed


def _fingerprint(face: Face, source: bytes) -> str:
    recipe = (
        RECIPE,
        face.family,
        face.style,
        sorted(face.characters),
        face.features,
        fontTools.version,
    )
    return hashlib.sha256(repr(recipe).encode() + source).hexdigest()[:32]


def cut(face: Face, source: bytes) -> bytes:
    """The font file ``source`` reduced to what ``face`` keeps, as woff2."""
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


def _rename(font: TTFont, family: str, style: str) -> None:
    full = f"{family} {style}"
    names = {1: family, 2: style, 3: full, 4: full, 6: full.replace(" ", "-")}
    for record in font["name"].names:
        if record.nameID in names:
            record.string = names[record.nameID]


def _keep_own_widths(font: TTFont) -> None:
    """Give each glyph the width that its metrics state.

    Some are marked to take the width of a part: a “ would be as narrow as a ‘ in browsers that
    draw with FreeType, and tabular figures uneven.
    """
    outlines = font.get("glyf")
    for name in font.getGlyphOrder() if outlines else ():
        for part in getattr(outlines[name], "components", ()):
            part.flags &= ~USE_MY_METRICS


def _offer_script_forms(font: TTFont) -> None:
    """Let style sheets ask for ``ssty``, the forms of indices and primes, whatever the script.

    The font offers it to the script ``math`` alone, which browsers do not set for MathML.
    """
    substitutions = font["GSUB"].table
    features = substitutions.FeatureList.FeatureRecord
    forms = [index for index, record in enumerate(features) if record.FeatureTag == "ssty"]
    for record in substitutions.ScriptList.ScriptRecord:
        system = record.Script.DefaultLangSys
        if system is not None:
            system.FeatureIndex = sorted({*system.FeatureIndex, *forms[:1]})
            system.FeatureCount = len(system.FeatureIndex)
