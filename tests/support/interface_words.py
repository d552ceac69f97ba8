"""Words of the interface looked for in finished files."""

import html
import re
from collections.abc import Iterator
from pathlib import Path

from site_builder.languages.words import Words

NOT_OURS = re.compile(r"<(pre|code)\b.*?</\1>", re.DOTALL)
"""Code and the texts of licences keep their language."""
COMMENTS = re.compile(r"/\*.*?\*/|(?m:(?<![:\"'`])//.*$)", re.DOTALL)
PLACEHOLDER = re.compile(r"\{\w+\}")


def phrases(words: Words) -> Iterator[tuple[str, str]]:
    """What of each text stands between placeholders, where that is more than a word."""
    for key, text in words.texts.items():
        for form in [text] if isinstance(text, str) else text.values():
            for part in PLACEHOLDER.split(form):
                phrase = part.strip(" .,:;()…")
                if " " in phrase:
                    yield key, phrase


def said(file: Path) -> str:
    """What readers may come to see of a page, a script or a style sheet."""
    text = file.read_text(encoding="utf-8")
    if file.suffix == ".html":
        return html.unescape(NOT_OURS.sub("", text))
    return COMMENTS.sub("", text)
