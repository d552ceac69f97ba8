"""Colours of ideas that a book names besides the engine's: their names, and how well they are read
on the page."""

import re
from collections.abc import Iterator, Mapping

from site_builder.checks.frames import known_classes
from site_builder.files.engine import own_or_engine, static_files
from site_builder.files.text import Sources, Toml
from site_builder.markdown.roles import ROLES
from site_builder.settings.model import FILE_NAME

NAME = re.compile(r"[a-z]+")
PAIR = re.compile(r"(#[0-9a-f]{6}) (#[0-9a-f]{6})")
GROUND = re.compile(r"--(?:paper|raised|sunken): light-dark\((#[0-9a-f]{6}), (#[0-9a-f]{6})\)")
LEAST_CONTRAST = 4.5
"""Least contrast of text (WCAG 2.2, success criterion 1.4.3)."""

type Rgb = tuple[float, float, float]


def check_colours(colours: Mapping[str, str], sources: Sources, toml: Toml) -> None:
    """Report names that are taken, values that are no pairs, and pairs that are hard to read."""
    if not colours:
        return
    taken = known_classes(static_files(sources.root)) | {role.name for role in ROLES} | {"muted"}
    tokens = own_or_engine(sources.root, "static/css/tokens.css").read_text(encoding="utf-8")
    grounds = GROUND.findall(tokens)
    for name, text in colours.items():
        pair = PAIR.fullmatch(text)
        if not NAME.fullmatch(name) or name in taken:
            message = f"colour {name!r}; legal: small letters, not the name of a role or of a class"
        elif not pair:
            message = f"colour {name!r} is {text!r}; legal: two in small digits, '#125b9c #7fbaf2'"
        elif (least := min(_contrasts(pair.groups(), grounds))) < LEAST_CONTRAST:
            legal = f"{LEAST_CONTRAST} with the light paper and with the dark"
            message = f"colour {name!r} has a contrast of {least:.2f}; legal: {legal}"
        else:
            continue
        sources.problems.add(FILE_NAME, toml.line("colours", name), message)


def contrast(one: Rgb, other: Rgb) -> float:
    """Contrast ratio, WCAG 2.2: 1 for equal colours, 21 for black on white; sRGB from 0 to 1."""
    low, high = sorted((_luminance(one), _luminance(other)))
    return (high + 0.05) / (low + 0.05)


def rgb(digits: str) -> Rgb:
    """sRGB from 0 to 1 of ``#rrggbb``."""
    red, green, blue = (int(digits[start : start + 2], 16) / 255 for start in (1, 3, 5))
    return red, green, blue


def _contrasts(pair: tuple[str, ...], grounds: list[tuple[str, str]]) -> Iterator[float]:
    """With each ground of both themes; 21 where there is none."""
    yield 21.0
    for ground in grounds:
        yield from (contrast(rgb(a), rgb(b)) for a, b in zip(pair, ground, strict=True))


def _luminance(colour: Rgb) -> float:
    """Relative luminance, WCAG 2.2."""
    linear = [v / 12.92 if v <= 0.04045 else ((v + 0.055) / 1.055) ** 2.4 for v in colour]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]
