"""An author's colours, written over those of the style sheet."""

import re
from pathlib import Path

from site_builder.settings.model import Palette, Settings, Theme
from site_builder.settings.theme import TOKENS, contrast, theme_css

SHEET = Path(__file__).parents[3] / "static" / "css" / "tokens.css"
PLAIN = Settings("T", "S", "P", ())


def test_the_builders_own_colours_are_those_of_the_style_sheet() -> None:
    text = SHEET.read_text(encoding="utf-8")
    pairs = re.findall(r"--([\w-]+): light-dark\((#[0-9a-f]{6}), (#[0-9a-f]{6})\);", text)
    assert {name: (light, dark) for name, light, dark in pairs} == TOKENS


def test_contrast_is_that_of_wcag() -> None:
    assert contrast("#000000", "#ffffff") == 21
    assert round(contrast("#777777", "#ffffff"), 2) == 4.48


def test_a_book_without_colours_of_its_own_adds_none() -> None:
    assert theme_css(PLAIN) == ""


def test_one_colour_changes_and_the_other_theme_keeps_its_own() -> None:
    theme = Theme(light=Palette(accent="#112233"))
    css = theme_css(Settings("T", "S", "P", (), theme=theme))
    assert f"--accent: light-dark(#112233, {TOKENS['accent'][1]});" in css
    assert "--accent-wash: light-dark(#11223314," in css
    assert "--paper" not in css
