"""What style sheet and scripts must know of the book: its words and its prefix."""

import json

from site_builder.languages.words import Words
from site_builder.settings.model import Settings
from site_builder.settings.reading import storage_prefix

STYLE = "style."
"""Begins the keys of the texts in the style sheet."""


def book_css(words: Words, selector: str = ":root") -> str:
    """Rules for the end of the style sheet, for pages that ``selector`` is true of."""
    texts = {key.removeprefix(STYLE): words(key) for key in words.texts if key.startswith(STYLE)}
    # CSS takes the strings of JSON but for escapes of control characters, which no text has.
    rules = (
        f"  --word-{name}: {json.dumps(text, ensure_ascii=False)};\n"
        for name, text in texts.items()
    )
    return f"\n{selector} {{\n{''.join(rules)}}}\n"


def script_words(words: Words) -> dict[str, object]:
    """The texts of scripts in one language; a page of a translation carries its own."""
    return {
        "DECIMAL": words("language.decimal"),
        "FIGURES": dict(words.figures),
        "WORDS": words.of_scripts,
    }


def book_script(settings: Settings, words: Words) -> bytes:
    """The module ``js/book.js``, which all scripts import; ``.ci/web/book.d.ts`` has its types."""
    exports = {
        "LANGUAGE": words.language,
        "STORAGE": f"{storage_prefix(settings)}:",
        **script_words(words),
    }
    lines = (
        f"export const {name} = {json.dumps(value, ensure_ascii=False)};\n"
        for name, value in exports.items()
    )
    return "".join(lines).encode()
