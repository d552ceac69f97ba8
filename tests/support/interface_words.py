"""Search finished files for words of the interface."""

import ast
import html
import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path

from site_builder.files.engine import ENGINE, ENGINE_PARTS
from site_builder.languages.words import Words

UNTRANSLATED = re.compile(r"<(pre|code)\b.*?</\1>", re.DOTALL)
"""Code and licence texts, which are not translated."""
COMMENTS = re.compile(r"/\*.*?\*/|(?m:(?<![:\"'`])//.*$)", re.DOTALL)
PLACEHOLDER = re.compile(r"\{\w+\}")


def phrases(words: Words) -> Iterator[tuple[str, str]]:
    """The parts of each text between placeholders that are longer than a word."""
    for key, text in words.texts.items():
        for form in [text] if isinstance(text, str) else text.values():
            for part in PLACEHOLDER.split(form):
                phrase = part.strip(" .,:;()…")
                if " " in phrase:
                    yield key, phrase


def visible_text(file: Path) -> str:
    """The text of a page, a script or a style sheet that readers may see."""
    text = file.read_text(encoding="utf-8")
    if file.suffix == ".html":
        return html.unescape(UNTRANSLATED.sub("", text))
    return COMMENTS.sub("", text)


SENTENCE = re.compile(r"[A-Za-z]{2,} [A-Za-z]{2,}")


@cache
def engine_sentences() -> frozenset[str]:
    """String constants in the Python of the engine that may be sentences, or parts of one."""
    parts = [ENGINE / "simulations" / part for part in ENGINE_PARTS]
    files = [file for part in parts for file in (*part.rglob("*.py"), part.with_suffix(".py"))]
    texts = (
        node.value.strip(" .,:;()")
        for file in files
        if file.is_file()
        for node in ast.walk(ast.parse(file.read_text(encoding="utf-8")))
        if isinstance(node, ast.Constant) and isinstance(node.value, str)
    )
    return frozenset(text for text in texts if SENTENCE.search(text))
