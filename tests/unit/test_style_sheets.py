"""Style sheets: readable contrasts in both themes, and no unused sheet or undefined property."""

import re
from itertools import combinations, product
from pathlib import Path

import pytest

from simulations.engine.frame import ROLES
from site_builder.checks.frames import Rgb, contrast, rgb
from site_builder.languages.words import ENGLISH
from site_builder.output.scripts import STYLE

STYLES = Path(__file__).parents[2] / "static" / "css"
SHEETS = {path.name: path.read_text(encoding="utf-8") for path in STYLES.glob("*.css")}
THEMES = ("paper", "ink")
GROUNDS = ("paper", "raised", "sunken")
IDEAS = tuple(role for role in ROLES if role)
READABLE = [
    *product(("ink", "ink-soft", "accent", *IDEAS), GROUNDS, [4.5]),
    ("on-accent", "accent", 4.5),
    *product(["rule-strong"], GROUNDS, [3.0]),  # WCAG 2.2, 1.4.11: outlines of controls
]
"""A colour, its background, and the least contrast."""


def token(name: str, theme: str) -> Rgb:
    """A token of tokens.css as sRGB in 0..1; the file writes light-dark(#paper, #ink)."""
    pair = re.search(
        rf"--{name}: light-dark\((#[0-9a-f]{{6}}), (#[0-9a-f]{{6}})\);", SHEETS["tokens.css"]
    )
    assert pair, f"tokens.css has no colour --{name}"
    return rgb(pair[1 + THEMES.index(theme)])


def lightness_and_opponents(colour: Rgb) -> tuple[float, float, float]:
    """Oklab coordinates (Ottosson 2020), in which equal distances look equally different."""
    r, g, b = (v / 12.92 if v <= 0.04045 else ((v + 0.055) / 1.055) ** 2.4 for v in colour)
    long = (0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b) ** (1 / 3)
    middle = (0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b) ** (1 / 3)
    short = (0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b) ** (1 / 3)
    return (
        0.2104542553 * long + 0.7936177850 * middle - 0.0040720468 * short,
        1.9779984951 * long - 2.4285922050 * middle + 0.4505937099 * short,
        0.0259040371 * long + 0.7827717662 * middle - 0.8086757660 * short,
    )


@pytest.mark.parametrize("theme", THEMES)
def test_colours_have_enough_contrast_with_their_background(theme: str) -> None:
    assert contrast((0.0, 0.0, 0.0), (1.0, 1.0, 1.0)) == pytest.approx(21)
    found = {(n, g): contrast(token(n, theme), token(g, theme)) - least for n, g, least in READABLE}
    assert {pair for pair, spare in found.items() if spare < 0} == set()


@pytest.mark.parametrize("theme", THEMES)
def test_role_colours_can_be_distinguished(theme: str) -> None:
    """A difference of 0.02 is just visible side by side; labels are far apart and thin."""
    places = {name: lightness_and_opponents(token(name, theme)) for name in (*IDEAS, "accent")}
    for one, other in combinations(places, 2):
        apart = sum((a - b) ** 2 for a, b in zip(places[one], places[other], strict=True)) ** 0.5
        assert apart >= 0.06, (one, other)


def test_every_style_sheet_is_imported_or_fetched_and_every_import_exists() -> None:
    imports = re.findall(r'@import "([^"]+)"', SHEETS["book.css"])
    scripts = (path.read_text(encoding="utf-8") for path in STYLES.parent.rglob("*.ts"))
    fetched = [name for text in scripts for name in re.findall(r'/css/([\w-]+\.css)"', text)]
    made = {"fonts.css", "roles.css", "control-kinds.css", "question-kinds.css"}
    own = [name for name in imports if name not in made]
    assert sorted([*own, *fetched, "book.css"]) == sorted(SHEETS)


def test_every_custom_property_is_defined() -> None:
    text = "\n".join(SHEETS.values())
    used, defined = (set(re.findall(it, text)) for it in (r"var\((--[\w-]+)", r"(--[\w-]+):"))
    words = {f"--word-{key.removeprefix(STYLE)}" for key in ENGLISH.texts if key.startswith(STYLE)}
    assert used - defined == words
    assert "//" not in text
