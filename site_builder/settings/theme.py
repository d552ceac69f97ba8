"""The colours of a book: readable in both themes, and written over those of the style sheet."""

from collections.abc import Iterator, Mapping

from site_builder.settings.declared import Reader
from site_builder.settings.model import Settings

THEMES = ("light", "dark")
TOKENS: Mapping[str, tuple[str, str]] = {
    "paper": ("#faf6ed", "#14171d"),
    "raised": ("#fffdf7", "#1b1f27"),
    "sunken": ("#f1ebdd", "#0f1216"),
    "ink": ("#26221b", "#e9e3d7"),
    "ink-soft": ("#5f5749", "#aea798"),
    "rule-strong": ("#8b8171", "#7d776b"),
    "rule": ("#dcd2be", "#343a45"),
    "accent": ("#1b5d66", "#84c6c6"),
    "on-accent": ("#fffdf7", "#10151a"),
    "world": ("#3a6a1d", "#9ccb7c"),
    "camera": ("#663a9e", "#c5a9f2"),
    "ray": ("#ad4209", "#f79c63"),
    "image": ("#125b9c", "#7fbaf2"),
    "light": ("#7c5a00", "#e9c554"),
    "error": ("#ae1350", "#ff86a4"),
    "muted": ("#675f52", "#a39c8f"),
}
"""The builder's own, light and dark, as ``static/css/tokens.css`` has them."""
GROUNDS = ("paper", "raised", "sunken")
NO_TEXT = (*GROUNDS, "rule", "rule-strong", "on-accent")
READABLE, RECOGNISED = 4.5, 3.0
"""Least contrast of text, and of what a control is recognised by: WCAG 2.2, 1.4.3 and 1.4.11."""
WASH = {"light": "14", "dark": "1f"}
"""How much of the accent a ground takes on, as the alpha of a colour."""


def colours(settings: Settings, theme: str) -> dict[str, str]:
    """Every colour of one theme, by its name in the style sheet."""
    own = {name: pair[THEMES.index(theme)] for name, pair in TOKENS.items()}
    chosen = settings.theme.light if theme == "light" else settings.theme.dark
    return {**own, **chosen.chosen()}


def theme_css(settings: Settings) -> str:
    """What the style sheet must say to have the author's colours; nothing where there are none."""
    light, dark = (colours(settings, theme) for theme in THEMES)
    changed = [name for name, pair in TOKENS.items() if (light[name], dark[name]) != pair]
    rules = [f"  --{name}: light-dark({light[name]}, {dark[name]});\n" for name in changed]
    if "accent" in changed:
        washes = (light["accent"] + WASH["light"], dark["accent"] + WASH["dark"])
        rules.append(f"  --accent-wash: light-dark({', '.join(washes)});\n")
    return f"\n:root {{\n{''.join(rules)}}}\n" if rules else ""


def check_theme(settings: Settings, reader: Reader) -> None:
    """Report what nobody could read, where the author chose one of the two colours."""
    for theme in THEMES:
        found = colours(settings, theme)
        palette = settings.theme.light if theme == "light" else settings.theme.dark
        chosen = palette.chosen()
        for name, ground, least in _pairs():
            ratio = contrast(found[name], found[ground])
            if ratio >= least or not {name, ground} & set(chosen):
                continue
            guilty, other = (name, ground) if name in chosen else (ground, name)
            at = ("theme", theme, guilty.replace("-", "_"))
            reader.report(
                at,
                f'{".".join(at)} "{found[guilty]}" has a contrast of {ratio:.2f}:1 to {other} '
                f'"{found[other]}"; legal: {least:g}:1 or more',
            )


def _pairs() -> Iterator[tuple[str, str, float]]:
    """A colour, what it lies on, and how far they must be apart."""
    for ground in GROUNDS:
        yield from ((name, ground, READABLE) for name in TOKENS if name not in NO_TEXT)
        yield "rule-strong", ground, RECOGNISED
    yield "on-accent", "accent", READABLE


def contrast(one: str, other: str) -> float:
    """Contrast ratio of two colours ``#rrggbb``, WCAG 2.2: from 1 to 21."""
    low, high = sorted((_luminance(one), _luminance(other)))
    return (high + 0.05) / (low + 0.05)


def _luminance(colour: str) -> float:
    channels = [int(colour[start : start + 2], 16) / 255 for start in (1, 3, 5)]
    red, green, blue = (
        value / 12.92 if value <= 0.04045 else ((value + 0.055) / 1.055) ** 2.4
        for value in channels
    )
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue
