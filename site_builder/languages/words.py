"""Words of the interface in one language: ``LANGUAGE.toml`` in this folder, or in
``content/languages/`` of a book.

A key is the name of its table and its own: ``search.close``. A text has placeholders,
``{count} of {most}``; one that depends on a number is a table with the forms ``one`` and ``other``,
chosen by ``count``. Scripts use the texts below ``script``.
"""

import re
import tomllib
from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import cache
from hashlib import blake2b
from pathlib import Path
from string import Formatter
from typing import Any

from markupsafe import Markup

from site_builder.diagnostics.diagnostic import unknown

HERE = Path(__file__).parent
FORMS = frozenset({"one", "other"})
SCRIPT = "script."
"""Begins the keys of the texts for scripts."""
DECIMAL = re.compile(r"(?<=\d)\.(?=\d)")

type Text = str | Mapping[str, str]
"""One text, or its forms by number."""


@dataclass(frozen=True, slots=True)
class Words:
    """All texts of a language by their keys."""

    language: str
    """Its tag, as in ``lang``: ``de``."""
    texts: Mapping[str, Text]
    cache_key: bytes = field(init=False, repr=False, compare=False)
    """Hash of all texts; the cache uses it in place of the texts."""

    def __post_init__(self) -> None:
        texts = repr((self.language, [*self.texts.items()]))
        object.__setattr__(self, "cache_key", blake2b(texts.encode(), digest_size=20).digest())

    def __call__(self, key: str, **values: object) -> str:
        """The text with its placeholders filled. Raises `KeyError` where there is none."""
        return self._form(key, values).format(**values)

    def html(self, key: str, **values: object) -> Markup:
        """The same for a page: what is put in is escaped, unless it is markup."""
        text = self._form(key, values)
        escaped = text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")
        return Markup(escaped).format(**values)

    def label(self, kind: str) -> str:
        """What a numbered thing is called: ``Figure``."""
        return self(f"labels.{kind.lower()}")

    def numeral(self, text: str) -> str:
        """A number as the language writes it: its decimal sign, and words for what is none. As
        ``numeral`` of ``static/js/page/words.ts``."""
        if text == "undefined":
            return self("script.number.undefined")
        if text.startswith("under "):
            return self("script.number.under", limit=self.numeral(text.removeprefix("under ")))
        sign = self("language.decimal")
        return text if sign == "." else DECIMAL.sub(sign, text)

    def labelled(self, labels: Mapping[str, str]) -> "Words":
        """With other words for some numbered things."""
        own = {
            f"labels.{kind}": label.replace("{", "{{").replace("}", "}}")
            for kind, label in labels.items()
            if label
        }
        return replace(self, texts={**self.texts, **own})

    @property
    def of_scripts(self) -> dict[str, Text]:
        """The texts for scripts, by keys without ``script.``."""
        return {
            key.removeprefix(SCRIPT): text
            for key, text in self.texts.items()
            if key.startswith(SCRIPT)
        }

    def _form(self, key: str, values: Mapping[str, object]) -> str:
        text = self.texts[key]
        if isinstance(text, str):
            return text
        return text["one" if values["count"] == 1 else "other"]


@cache
def load_words(language: str) -> Words:
    """Raises `FileNotFoundError` where there is no such language."""
    file = HERE / f"{language}.toml"
    return Words(language, dict(_flat(tomllib.loads(file.read_text(encoding="utf-8")), "")))


FOLDER = "content/languages"
"""Of a book's own languages. What they leave out is the engine's, or else English."""


def languages(root: Path | None = None) -> tuple[str, ...]:
    """The engine's, and those of the book at ``root``."""
    folders = (HERE, root / FOLDER) if root else (HERE,)
    return tuple(sorted({file.stem for folder in folders for file in folder.glob("*.toml")}))


def book_words(language: str, table: Mapping[str, object]) -> tuple[Words, dict[str, str], int]:
    """The words of a book's own file, what is wrong with them by key, and how many are missing."""
    known = load_words(language if language in languages() else "en").texts
    given, faults = dict(_entries(table, "", known)), dict[str, str]()
    for key, text in given.items():
        if key not in known:
            faults[key] = unknown("text", key, known)
        elif isinstance(known[key], str) and not isinstance(text, str):
            faults[key] = f"{key!r}; legal: a text"
        elif not isinstance(text, str) and not _has_forms(text):
            faults[key] = f"{key!r}; legal: a text for 'one' and a text for 'other', no more"
        elif _named(text) != (named := _named(known[key])):
            legal = " ".join(f"{{{name}}}" for name in sorted(named)) or "none"
            faults[key] = f"{key!r} has other places in braces than English; legal: {legal}"
        elif '"' in "".join(_forms(text)):
            faults[key] = f"""{key!r} has '"', which ends attributes; legal: other quotes"""
    if len(str(given.get("language.decimal", "."))) != 1:
        faults["language.decimal"] = "'language.decimal'; legal: one sign"
    if given.get("language.direction", "ltr") not in DIRECTIONS:
        faults["language.direction"] = "'language.direction'; legal: 'ltr' or 'rtl'"
    sound = {key: text for key, text in given.items() if key not in faults}
    return Words(language, {**known, **sound}), faults, len(known) - len(sound)


DIRECTIONS = ("ltr", "rtl")


def _forms(text: Text) -> list[str]:
    return [text] if isinstance(text, str) else [*text.values()]


def _has_forms(text: object) -> bool:
    return (
        isinstance(text, dict)
        and set(text) == FORMS
        and all(isinstance(form, str) for form in text.values())
    )


def _named(text: Text) -> set[str]:
    """The placeholders of a text; where its braces do not match, one that no text has."""
    try:
        parts = [part for form in _forms(text) for part in Formatter().parse(form)]
    except ValueError:
        return {"{"}
    return {name for _, name, _, _ in parts if name is not None}


def _entries(
    table: Mapping[str, object], prefix: str, known: Collection[str]
) -> Iterator[tuple[str, Any]]:
    """All that a file has, down to the keys that are known."""
    for name, value in table.items():
        key = f"{prefix}{name}"
        if isinstance(value, dict) and key not in known:
            yield from _entries(value, f"{key}.", known)
        else:
            yield key, value


def _flat(table: Mapping[str, object], prefix: str) -> Iterator[tuple[str, Text]]:
    for name, value in table.items():
        if isinstance(value, dict) and set(value) != FORMS:
            yield from _flat(value, f"{prefix}{name}.")
        elif isinstance(value, str | dict):
            yield f"{prefix}{name}", value


ENGLISH = load_words("en")
