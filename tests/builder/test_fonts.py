"""The subset web fonts: they cover the book's characters and formulae, and stay small."""

import io
import re
from collections.abc import Mapping

import pytest
from fontTools.ttLib import TTFont
from fontTools.ttLib.tables._g_l_y_f import USE_MY_METRICS

from site_builder.output.fonts import (
    FACES,
    FORMULAE,
    MATHS_FACES,
    TEXT,
    Face,
    fallback_rules,
    subset_fonts,
)

TEXT_FACES = [face.file for face in FACES if face not in MATHS_FACES]


@pytest.fixture(scope="module")
def fonts() -> Mapping[str, bytes]:
    return subset_fonts()


def open_font(fonts: Mapping[str, bytes], file: str) -> TTFont:
    return TTFont(io.BytesIO(fonts[file]))


def features(font: TTFont) -> set[str]:
    tables = [font[tag].table for tag in ("GSUB", "GPOS") if tag in font]
    return {record.FeatureTag for table in tables for record in table.FeatureList.FeatureRecord}


UPRIGHT = ["serif-regular.woff2", "sans-regular.woff2"]
CHARACTERS = [
    *((file, "AÀÉÎÕÜßæçéñøœšž 0123456789 “‘–—…’” −×±°·²≈≠≤≥") for file in TEXT_FACES),
    *((file, "αβγδεθκλμνπρστφψω ΔΣΩ ∞∂∑√→←↑↓ ½ ₀₁₂ ⁰¹²³") for file in UPRIGHT),
    ("maths.woff2", "𝑥𝐱𝜃𝛼𝐀𝐑ℝℓ⊤⋅∥⟨⟩∑∫√∂∇∞≤≥≈≠→⇒⋯⋮⋱′ˆ"),
    ("maths-rare.woff2", "𝒪𝔰𝔬𝖲𝖤𝟙𝔸"),
]


@pytest.mark.parametrize(("file", "text"), CHARACTERS)
def test_face_covers_its_characters(fonts: Mapping[str, bytes], file: str, text: str) -> None:
    covered = open_font(fonts, file).getBestCmap()
    assert {character for character in text if ord(character) not in covered} == set()


def test_font_files_are_small(fonts: Mapping[str, bytes]) -> None:
    assert max(len(fonts[file]) for file in TEXT_FACES) < 40_000
    assert len(fonts["maths.woff2"]) < 100_000


def test_maths_face_stretches_brackets_and_has_small_forms_of_indices(
    fonts: Mapping[str, bytes],
) -> None:
    font = open_font(fonts, "maths.woff2")
    vertical = font["MATH"].table.MathVariants.VertGlyphCoverage.glyphs
    names = font.getBestCmap()
    assert {names[ord(sign)] for sign in "()[]{}|√∫"} <= set(vertical)
    assert font["MATH"].table.MathConstants.AxisHeight.Value > 0
    table = font["GSUB"].table
    for record in table.ScriptList.ScriptRecord:
        offered = record.Script.DefaultLangSys.FeatureIndex
        assert "ssty" in {table.FeatureList.FeatureRecord[index].FeatureTag for index in offered}


@pytest.mark.parametrize("file", TEXT_FACES)
def test_text_faces_keep_figures_and_glyph_widths(fonts: Mapping[str, bytes], file: str) -> None:
    font = open_font(fonts, file)
    if file.startswith("serif"):
        assert {"tnum", "onum", "lnum", "kern", "liga"} <= features(font)
    else:
        names, widths = font.getBestCmap(), font["hmtx"]
        assert len({widths[names[ord(sign)]][0] for sign in "0123456789−\u2007"}) == 1
    for name in font.getGlyphOrder():
        for part in getattr(font["glyf"][name], "components", ()):
            assert not part.flags & USE_MY_METRICS


@pytest.mark.parametrize("face", FACES, ids=lambda face: face.file)
def test_subset_faces_are_renamed_and_keep_their_licence(
    fonts: Mapping[str, bytes], face: Face
) -> None:
    name = open_font(fonts, face.file)["name"]
    assert name.getDebugName(1) == face.family
    assert "Source" not in name.getDebugName(4)  # reserved by the licence for whole fonts
    assert "SIL Open Font License" in name.getDebugName(13)
    assert name.getDebugName(0)


def test_maths_faces_share_no_character_and_text_needs_the_common_one(
    fonts: Mapping[str, bytes],
) -> None:
    common, rare = (face.characters for face in MATHS_FACES)
    assert common | rare == FORMULAE
    assert not common & rare
    of_text = set().union(*(open_font(fonts, file).getBestCmap() for file in TEXT_FACES))
    of_maths = set().union(*(open_font(fonts, face.file).getBestCmap() for face in MATHS_FACES))
    assert (TEXT & of_maths) - of_text <= common


@pytest.mark.parametrize("family", ["Serif", "Sans"])
def test_fallback_fonts_have_the_same_line_height(fonts: Mapping[str, bytes], family: str) -> None:
    header = open_font(fonts, f"{family.lower()}-regular.woff2")["hhea"]
    faces = re.findall(r"@font-face \{(.*?)\}", fallback_rules(), re.DOTALL)
    parsed = [dict(re.findall(r"([\w-]+): ([^;]+);", face)) for face in faces]
    fallbacks = [face for face in parsed if face["font-family"] == f'"Book {family} Fallback"']
    assert fallbacks
    for face in fallbacks:
        scale, ascent, descent = (
            float(face[name].rstrip("%")) / 100
            for name in ("size-adjust", "ascent-override", "descent-override")
        )
        # Per mille of an em; the percentages have one decimal.
        assert scale * ascent * 1000 == pytest.approx(header.ascent, abs=1.5)
        assert scale * descent * 1000 == pytest.approx(-header.descent, abs=1.5)
