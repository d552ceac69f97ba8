"""Colours of the style sheet: text readable in both themes, and every figure's class drawn."""

import re
from collections.abc import Iterator
from itertools import combinations
from pathlib import Path

import pytest

from simulations.engine.frame import ROLES
from site_builder.checks.colours import Rgb, contrast, rgb
from site_builder.languages.words import ENGLISH
from site_builder.output.book_files import STYLE

STYLES = Path(__file__).parents[2] / "static" / "css"
TOKENS = (STYLES / "tokens.css").read_text(encoding="utf-8")
THEMES = ("paper", "ink")
GROUNDS = ("paper", "raised", "sunken")
IDEAS = tuple(role for role in ROLES if role)
TEXT_COLOURS = ("ink", "ink-soft", "accent", *IDEAS)


def token(name: str, theme: str) -> Rgb:
    """A token of tokens.css as sRGB in 0..1; the file writes light-dark(#paper, #ink)."""
    pair = re.search(rf"--{name}: light-dark\((#[0-9a-f]{{6}}), (#[0-9a-f]{{6}})\);", TOKENS)
    assert pair, f"tokens.css has no colour --{name}"
    return rgb(pair[1 + THEMES.index(theme)])


def lightness_and_opponents(colour: Rgb) -> tuple[float, float, float]:
    """Oklab (Ottosson 2020), in which equal distances look about equally different."""
    r, g, b = (v / 12.92 if v <= 0.04045 else ((v + 0.055) / 1.055) ** 2.4 for v in colour)
    long = (0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b) ** (1 / 3)
    middle = (0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b) ** (1 / 3)
    short = (0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b) ** (1 / 3)
    return (
        0.2104542553 * long + 0.7936177850 * middle - 0.0040720468 * short,
        1.9779984951 * long - 2.4285922050 * middle + 0.4505937099 * short,
        0.0259040371 * long + 0.7827717662 * middle - 0.8086757660 * short,
    )


def rules() -> Iterator[tuple[str, str]]:
    """Selectors and file names of all style sheets."""
    for path in STYLES.glob("*.css"):
        bare = re.sub(r"/\*.*?\*/", "", path.read_text(encoding="utf-8"), flags=re.DOTALL)
        for selector in re.findall(r"([^{}]+)\{", bare):
            yield selector.strip(), path.name


def test_contrast_of_black_on_white_is_21() -> None:
    assert contrast((0.0, 0.0, 0.0), (1.0, 1.0, 1.0)) == pytest.approx(21)


@pytest.mark.parametrize("theme", THEMES)
@pytest.mark.parametrize("ground", GROUNDS)
@pytest.mark.parametrize("name", TEXT_COLOURS)
def test_text_colours_stand_out_from_every_ground(name: str, ground: str, theme: str) -> None:
    assert contrast(token(name, theme), token(ground, theme)) >= 4.5


@pytest.mark.parametrize("theme", THEMES)
def test_text_on_an_accented_ground_is_readable(theme: str) -> None:
    assert contrast(token("on-accent", theme), token("accent", theme)) >= 4.5


@pytest.mark.parametrize("theme", THEMES)
@pytest.mark.parametrize("ground", GROUNDS)
def test_outlines_of_controls_stand_out(ground: str, theme: str) -> None:
    # WCAG 2.2, success criterion 1.4.11: 3:1 for what a control is recognised by.
    assert contrast(token("rule-strong", theme), token(ground, theme)) >= 3


@pytest.mark.parametrize("theme", THEMES)
@pytest.mark.parametrize("pair", list(combinations((*IDEAS, "accent"), 2)), ids=" and ".join)
def test_colours_of_ideas_are_told_apart(pair: tuple[str, str], theme: str) -> None:
    one, other = (lightness_and_opponents(token(name, theme)) for name in pair)
    distance = sum((a - b) ** 2 for a, b in zip(one, other, strict=True)) ** 0.5
    # 0.02 is about what is just seen when side by side; labels are far apart and thin.
    assert distance >= 0.06


@pytest.mark.parametrize("role", IDEAS)
def test_every_role_is_styled_in_drawings_readouts_and_prose(role: str) -> None:
    selectors = {(selector, file) for selector, file in rules()}
    assert (f".overlay .{role}", "overlay.css") in selectors
    assert (f".readout.role-{role}", "readouts.css") in selectors
    assert (f".role-{role}", "tokens.css") in selectors


def test_every_style_sheet_is_imported_or_fetched_and_every_import_exists() -> None:
    entry = (STYLES / "book.css").read_text(encoding="utf-8")
    imported = [name for name in re.findall(r'@import "([^"]+)"', entry) if "-kinds" not in name]
    scripts = (path.read_text(encoding="utf-8") for path in STYLES.parent.rglob("*.ts"))
    fetched = [name for text in scripts for name in re.findall(r'/css/([\w-]+\.css)"', text)]
    assert sorted([*imported, *fetched]) == sorted(
        path.name for path in STYLES.glob("*.css") if path.name != "book.css"
    )


def test_every_custom_property_that_is_used_is_defined() -> None:
    sheets = [path.read_text(encoding="utf-8") for path in STYLES.glob("*.css")]
    used = {name for sheet in sheets for name in re.findall(r"var\((--[\w-]+)", sheet)}
    defined = {name for sheet in sheets for name in re.findall(r"(--[\w-]+):", sheet)}
    words = {f"--word-{key.removeprefix(STYLE)}" for key in ENGLISH.texts if key.startswith(STYLE)}
    assert used - defined == words


def test_style_sheets_ask_nothing_of_other_origins() -> None:
    for path in STYLES.glob("*.css"):
        assert "//" not in path.read_text(encoding="utf-8"), path.name
