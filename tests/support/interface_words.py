"""Words of the interface looked for in finished files."""

import ast
import html
import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path

from site_builder.files.engine import ENGINE, ENGINE_PARTS
from site_builder.languages.words import Words

NOT_OURS = re.compile(r"<(pre|code)\b.*?</\1>", re.DOTALL)
"""Code and the texts of licences keep their language."""
COMMENTS = re.compile(r"/\*.*?\*/|(?m:(?<![:\"'`])//.*$)", re.DOTALL)
PLACEHOLDER = re.compile(r"\{\w+\}")


def phrases(words: Words) -> Iterator[tuple[str, str]]:
    """Parts of each text between placeholders, where they are more than a word."""
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


SENTENCE = re.compile(r"[A-Za-z]{2,} [A-Za-z]{2,}")


@cache
def engine_sentences() -> frozenset[str]:
    """Whatever in the Python of the engine might be a sentence, or a part of one."""
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
