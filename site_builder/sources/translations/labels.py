"""``content/LANGUAGE/labels.toml``: texts of figures, by the texts of the original; ``#`` is
each number. ``figureText`` and ``figureMarkup`` in ``static/js/page/words.ts`` do the same."""

import re
from collections.abc import Mapping
from pathlib import Path

from site_builder.diagnostics.diagnostic import Diagnostics
from site_builder.files.text import read_toml
from site_builder.languages.words import Words

NUMBER = re.compile(r"[−-]?\d+(?:\.\d+)?")
TEXT = re.compile(r"(?<=>)[^<>]+(?=<)")
UNFIT = re.compile(r'[<>&"\\]')
"""In a label: it becomes part of markup and of data."""
SPOKEN = re.compile(
    r'((?:aria-(?:label|description|valuetext)|alt|data-hint|"label"):?[= ]")([^"]+)(?=")'
)
"""Attributes of elements, and labels in the data of a figure."""


def read_labels(root: Path, language: str, problems: Diagnostics) -> Mapping[str, str]:
    path = f"content/{language}/labels.toml"
    toml = read_toml(root, path, problems) if (root / path).is_file() else None
    labels: dict[str, str] = {}
    for text, label in toml.table.items() if toml else ():
        if NUMBER.search(text):
            expected = f"{NUMBER.sub('#', text)!r}, '#' for each number"
        elif not isinstance(label, str) or label.count("#") != text.count("#"):
            expected = f"a text with {text.count('#')} '#'"
        elif UNFIT.search(label):
            expected = 'a text without < > & " \\'
        else:
            labels[text] = label
            continue
        problems.add(path, toml.line(text) if toml else 1, f"{text!r}; legal: {expected}")
    return labels


def figure_text(text: str, words: Words) -> str:
    """In the language of the page, where that has it."""
    label = words.figures.get(NUMBER.sub("#", text.strip()))
    if label is None:
        return text
    numbers = iter(NUMBER.findall(text))
    return re.sub("#", lambda _: words.numeral(next(numbers)), label)


def figure_markup(html: str, words: Words) -> str:
    """A figure with its texts and spoken names in the language of the page."""
    if not words.figures:
        return html
    html = TEXT.sub(lambda found: figure_text(found[0], words), html)
    return SPOKEN.sub(lambda found: found[1] + figure_text(found[2], words), html)
