"""Web fonts: the book's faces, cut down to what it prints and packed as woff2.

Cutting takes seconds, hence a cache keyed by everything it depends on.
"""

import io
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import KW_ONLY, dataclass
from importlib.util import find_spec
from itertools import groupby
from pathlib import Path
from typing import TYPE_CHECKING

import fontTools

from site_builder.files.folders import cache_folder
from site_builder.runtime.store import made_once, sha256

if TYPE_CHECKING:
    from fontTools.ttLib import TTFont


def _span(*bounds: tuple[int, int]) -> frozenset[int]:
    return frozenset(code for first, last in bounds for code in range(first, last + 1))


def _chars(characters: str) -> frozenset[int]:
    return frozenset(map(ord, characters))


LATIN = _span((0x20, 0x7E), (0xA0, 0x17F))
GREEK = _span((0x391, 0x3A1), (0x3A3, 0x3C9)) | _chars("ϑϕϵ")
SPACES = _span((0x2002, 0x200A), (0x202F, 0x202F))
PUNCTUATION = SPACES | _chars("‐‑–—‘’‚“”„†‡•…‰′″‹›€№™")
INLINE_MATHS = _chars("←↑→↓↔⇒−×÷±·∙√∞≈≠≤≥∂∆∏∑∫∈∥⟂ℓ°⁻⁺ⁿ⁰¹²³⁴⁵⁶⁷⁸⁹₀₁₂₃₄₅₆₇₈₉½⅓⅔¼¾✓✗")
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
        (0x203E, 0x203E),  # overline
        (0x2061, 0x2064),  # invisible operators
        (0x20D7, 0x20D7),  # vector arrow
        (0x2190, 0x21FF),  # arrows
        (0x2200, 0x22FF),  # operators
        (0x2308, 0x230B),  # ceiling and floor
        (0x23B4, 0x23B5),
        (0x23DC, 0x23E1),  # braces over and under
        (0x27E6, 0x27EB),  # angle brackets
        (0x27F5, 0x27FC),  # long arrows
        (0x1D400, 0x1D56B),  # alphabets: bold, italic, bold italic, script, Fraktur, double-struck
        (0x1D5A0, 0x1D5D3),  # sans serif
        (0x1D6A4, 0x1D755),  # dotless; Greek bold, italic, bold italic
        (0x1D7CE, 0x1D7E1),  # bold and double-struck digits
    )
    | _chars("ℂℎℏℐℒℕℙℚℛℝℤ□◦⊤⊥⋅⋆⟨⟩⟵⟶⟷⦅⦆")
)

ALWAYS_WITH_FORMULAE = FORMULAE & (
    _span((0x20, 0x7E))
    | GREEK
    | SPACES
    | _span(
        (0x2C6, 0x2DD),  # accents
        (0x300, 0x308),
        (0x2061, 0x2064),
        (0x1D400, 0x1D467),  # Latin: bold, italic, the first of bold italic
        (0x1D6E2, 0x1D71B),  # Greek: italic
        (0x1D7CE, 0x1D7D7),  # bold digits
    )
    | _chars("()/[]\\_{}|‖√∣∥∏∐∑∫∬∭∮⋀⋁⋂⋃⌈⌉⌊⌋⟨⟩⏜⏝⏞⏟⎴⎵‾¯")  # what stretches
    | _chars("←→↔⟶⇒⇔↑↓∈∉⊂⊆∪∩∀∃∧∨¬⊕⊗⟂⊤⊥⋅∘∙·×÷±∓−≈≠≤≥≲≳≪≫∗≡≃≅∼∝∂∇∞∆…⋯⋮⋱°′″⁻⁺\u2011\xa0µϵℎℓℝ𝜹\u20d7")
)
"""What the face that formulae need first holds: letters, common signs, and every sign that
stretches. Browsers draw roots, fences, braces and big operators from the first face of a family
only, even where no character of the text names them. Text takes its rarer signs from it too."""

BASIC_FEATURES = ("ccmp", "kern", "liga", "lnum", "locl", "mark", "mkmk", "onum", "pnum", "tnum")
SMALL_CAPITALS = ("c2sc", "smcp")
FORMULA_FEATURES = ("ccmp", "dtls", "flac", "kern", "mark", "mkmk", "ssty")


@dataclass(frozen=True, slots=True)
class Face:
    """One web font: its source and its subset."""

    file: str
    """Name of the woff2 file, as the style sheet refers to it."""
    package: str
    """Installed package that carries the source."""
    source: str
    """Path of the source inside the package, or the folder."""
    _: KW_ONLY
    family: str
    """Family name written into the cut face."""
    style: str
    """Style name written into the cut face."""
    characters: frozenset[int] = TEXT
    """Code points of the subset, where the source has them."""
    features: tuple[str, ...] = BASIC_FEATURES
    """OpenType features of the subset."""


def _serif(file: str, cut: str, style: str, *extra_features: str) -> Face:
    package, source = "font_source_serif_pro", f"files/SourceSerifPro-{cut}.ttf"
    features = BASIC_FEATURES + extra_features
    return Face(file, package, source, family="Book Serif", style=style, features=features)


def _sans(file: str, cut: str, style: str) -> Face:
    source = f"files/SourceSansPro-{cut}.ttf"
    return Face(file, "font_source_sans_pro", source, family="Book Sans", style=style)


def _maths(file: str, characters: frozenset[int]) -> Face:
    return Face(
        file,
        "ziamath",
        "fonts/STIXTwoMath-Regular.ttf",
        family="Book Maths",
        style="Regular",
        characters=characters,
        features=FORMULA_FEATURES,
    )


FACES = (
    _serif("serif-regular.woff2", "Regular", "Regular", *SMALL_CAPITALS),
    _serif("serif-italic.woff2", "It", "Italic"),
    _serif("serif-semibold.woff2", "Semibold", "Semibold"),
    _serif("serif-semibold-italic.woff2", "SemiboldIt", "Semibold Italic"),
    _sans("sans-regular.woff2", "Regular", "Regular"),
    _sans("sans-italic.woff2", "It", "Italic"),
    _sans("sans-semibold.woff2", "Semibold", "Semibold"),
    _maths("maths.woff2", ALWAYS_WITH_FORMULAE),
    _maths("maths-rare.woff2", FORMULAE - ALWAYS_WITH_FORMULAE),
)

MATHS_FACES = FACES[-2:]
"""Formulae: common signs, and rare ones, which a browser fetches only for a page that shows one."""


TIMES, ARIAL = "Times New Roman, Liberation Serif, Tinos", "Arial, Liberation Sans, Arimo"
FALLBACKS = (
    ("Book Serif", "", TIMES, (109.5, 94.6, 30.6)),
    ("Book Serif", " Italic", TIMES, (102.5, 101.1, 32.7)),
    ("Book Serif", " Bold", TIMES, (105.8, 97.9, 31.7)),
    ("Book Sans", "", ARIAL, (92.9, 105.9, 29.3)),
    ("Book Sans", " Italic", ARIAL, (89.8, 109.5, 30.4)),
    ("Book Sans", " Bold", ARIAL, (89.3, 110.1, 30.6)),
)
"""Common system faces, shown until the real face arrives: stretched to the same ascent, descent and
average width of the book's text (in per cent: size, ascent, descent), so that few lines move."""


def face_rules() -> str:
    """Rules that have a browser fetch the faces; those of formulae for their characters alone."""
    return "".join(
        _rule(
            {"font-family": f'"{face.family}"'}
            | ({} if face in MATHS_FACES else _variant(face.style))
            | {"font-display": "swap", "src": f'url("../fonts/{face.file}") format("woff2")'}
            | ({"unicode-range": ", ".join(_spans(face.characters))} if face in MATHS_FACES else {})
        )
        for face in FACES
    )


def fallback_rules() -> str:
    """Rules that name and stretch the system's faces."""
    return "".join(
        _rule(
            {"font-family": f'"{family} Fallback"'}
            | _variant(style)
            | {
                "src": ", ".join(f'local("{name}{style}")' for name in names.split(", ")),
                "size-adjust": f"{size}%",
                "ascent-override": f"{ascent}%",
                "descent-override": f"{descent}%",
                "line-gap-override": "0%",
                "unicode-range": "U+20-24F, U+2010-2026",
            }
        )
        for family, style, names, (size, ascent, descent) in FALLBACKS
    )


def _variant(style: str) -> dict[str, str]:
    """Weight and slant of a face by the name of its style, such as "Semibold Italic"."""
    return {
        "font-weight": "600 700" if "bold" in style.lower() else "400",
        "font-style": "italic" if "Italic" in style else "normal",
    }


def _rule(said: Mapping[str, str]) -> str:
    lines = "".join(f"  {name}: {value};\n" for name, value in said.items())
    return f"@font-face {{\n{lines}}}\n"


def _spans(codes: Iterable[int]) -> Iterator[str]:
    """Each run of neighbours, by its first and last."""
    for _, run in groupby(enumerate(sorted(codes)), lambda item: item[1] - item[0]):
        found = [code for _, code in run]
        yield f"U+{found[0]:X}-{found[-1]:X}"


RECIPE = 3
"""Counts changes of `cut`, so that a cache filled by an earlier version is not used."""


def subset_fonts() -> Mapping[str, bytes]:
    """The book's web fonts by file name, ready to be written beside the style sheet.

    Raises
    ------
    FileNotFoundError
        A package that should carry a face does not.
    """
    return {face.file: _cut_once(face, cache_folder() / "fonts") for face in FACES}


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
