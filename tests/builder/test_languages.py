"""Texts of the interface in each language, their use, and languages that a book adds."""

import re
from collections.abc import Iterator, Mapping
from pathlib import Path

import pytest
from markupsafe import Markup
from support.html_outline import read_html
from support.little_book import OUTLINE, MakeBook, diagnostics, rendered
from support.places import ROOT

from site_builder.languages.words import ENGLISH, SCRIPT, Words, languages, load_words

GERMAN = load_words("de")
PLACEHOLDER = re.compile(r"\{(\w+)\}")
BLOCK_COMMENT = re.compile(r"/\*.*?\*/", re.DOTALL)
NAMES = {
    "CPython", "DOI", "Esc", "ISBN", "ORCID", "QTIv", "Package",
    "data", "doi", "embed", "feed", "https", "isbn", "orcid", "org", "urn", "uuid", "xml",
}  # fmt: skip
"""Names that are equal in all languages, parts of addresses, and names in QTI packages."""
OF_TEMPLATES = re.compile(r"""\bt\(\s*"([\w.-]+)("\s*~)?""")
OF_PYTHON = re.compile(r"""\bwords\(\s*(f?)"([\w.-]+)""")
OF_THE_ENGINE = re.compile(r"""\bMessage\(\s*"([\w.-]+)""")
OF_SCRIPTS = re.compile(r"""\bwords\(\s*(["`])([\w.-]+)""")
QUOTED = re.compile(r"""["'`]([a-z][\w-]*(?:\.[\w-]+)+)["'`]""")
COMPOSED = (
    "labels.", "style.", "callout.", "landing.count_", "script.theme.", "script.figure.",
    "script.predict.", "script.runtime.", "script.stage_report.", "script.tools.python_copied",
    "script.search.found", "script.search.near", "script.exercise.", "figure.within_",
)  # fmt: skip
"""Beginnings of keys that are composed where they are used."""


def sources() -> Iterator[tuple[Path, str]]:
    for folder, kinds in (
        ("site_builder", (".py", ".html", ".xml", ".ts")),
        ("static/js", (".ts",)),
        *((f"simulations/{part}", (".py", ".html", ".ts")) for part in ("engine", "editing")),
    ):
        for file in sorted((ROOT / folder).rglob("*")):
            if file.suffix in kinds:
                yield file, file.read_text(encoding="utf-8")


def used_keys() -> Iterator[tuple[str, bool]]:
    """Keys that are used, each with whether it is complete or only a beginning."""
    for file, text in sources():
        if file.suffix == ".ts":
            yield from ((SCRIPT + key, mark == '"') for mark, key in OF_SCRIPTS.findall(text))
        elif file.suffix == ".py":
            yield from ((key, not made) for made, key in OF_PYTHON.findall(text))
            yield from ((SCRIPT + key, True) for key in OF_THE_ENGINE.findall(text))
        else:
            yield from ((key, not joined) for key, joined in OF_TEMPLATES.findall(text))


def test_every_interface_text_exists_and_is_used() -> None:
    keys = ENGLISH.texts
    missing = [
        key
        for key, whole in used_keys()
        if not (key in keys if whole else any(k.startswith(key) for k in keys))
    ]
    assert missing == []
    used = {key for key, _ in used_keys()}
    for file, text in sources():
        named = QUOTED.findall(text)
        used |= {SCRIPT + key if file.suffix == ".ts" else key for key in named} | set(named)
    assert [key for key in keys if key not in used and not key.startswith(COMPOSED)] == []


def forms(text: str | Mapping[str, str]) -> list[str]:
    return [text] if isinstance(text, str) else list(text.values())


@pytest.mark.parametrize("language", languages())
def test_each_language_has_the_keys_and_placeholders_of_english(language: str) -> None:
    def named(words: Words) -> dict[str, tuple[set[str], int]]:
        return {
            key: ({name for form in forms(text) for name in PLACEHOLDER.findall(form)},
                  len(forms(text)))
            for key, text in words.texts.items()
        }  # fmt: skip

    words = load_words(language)
    assert list(words.texts) == list(ENGLISH.texts)
    assert named(words) == named(ENGLISH)
    assert not [
        key for key, text in words.texts.items() if any('"' in form for form in forms(text))
    ]


def test_plural_follows_the_number_and_texts_are_escaped() -> None:
    words = Words(
        "xx", {"a.b": {"one": "{count} thing", "other": "{count} things"}, "a.c": "{one} & {other}"}
    )
    assert [words("a.b", count=count) for count in (0, 1, 2)] == ["0 things", "1 thing", "2 things"]
    assert words.html("a.c", one="<", other=Markup("<b>x</b>")) == "&lt; &amp; <b>x</b>"
    labelled = GERMAN.labelled({"figure": "Bild", "table": ""})
    assert (labelled.label("Figure"), labelled.label("Table")) == ("Bild", "Tabelle")


@pytest.mark.parametrize(
    ("text", "german"),
    [
        ("1.5", "1,5"),
        ("−0.25 px", "−0,25 px"),
        ("f/2.8", "f/2,8"),
        ("none.", "none."),
        ("undefined", "nicht definiert"),
        ("under 0.1", "unter 0,1"),
    ],
)
def test_numbers_follow_the_language(text: str, german: str) -> None:
    assert GERMAN.numeral(text) == german
    assert ENGLISH.numeral(text) == text


def test_templates_and_scripts_contain_no_text() -> None:
    found_words = {
        word for file, text in sources() if "templates" in file.parts for word in bare(text)
    }
    assert found_words <= NAMES
    sentence = re.compile(r"""["`]([A-Z][a-z]+ [a-z][^"`]*)["`]""")
    texts = (BLOCK_COMMENT.sub("", text) for file, text in sources() if file.suffix == ".ts")
    assert [found for text in texts for found in sentence.findall(text)] == []


def bare(template: str) -> list[str]:
    """Words in a template itself, between its tags or in attributes that are read aloud."""
    for hidden in (
        r"\{% set (begin|find_home|looks) %\}.*?\{% endset %\}",
        r"\{#.*?#\}",
        r"<(script|style)\b.*?</\1>",
        r"<meta property=.*?</meta>",
        r"\{[{%].*?[%}]\}",
        r"&\w+;",
    ):
        template = re.sub(hidden, "", template, flags=re.DOTALL)
    read = re.findall(
        r'\b(?:aria-label|aria-description|title|alt|placeholder)="([^"#-]*)"', template
    )
    text = re.sub(r"<[^>]*>", " ", template)
    return [word for part in (text, *read) for word in re.findall(r"[A-Za-z]{2,}", part)]


def test_book_with_its_own_language_is_read_from_right_to_left(make_book: MakeBook) -> None:
    files = {
        "content/languages/he.toml": '[language]\ndirection = "rtl"\n[labels]\nfigure = "איור"\n',
        "content/book.toml": OUTLINE + 'language = "he"\n',
    }
    site = rendered(make_book(":::{simulation} demo\nLook.\n:::\n", files))
    for path in ("index.html", "first/index.html"):
        (page,) = read_html(site[path]).all("html")
        assert (page["lang"], page["dir"]) == ("he", "rtl")
    assert "איור 0.1" in site["first/index.html"].decode()


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ('[labels]\nfigur = "F"', "unknown text 'labels.figur'; did you mean 'labels.figure'"),
        (
            '[labels]\nsection = "{titel}"',
            "'labels.section' has other places in braces than English; legal: {title}",
        ),
        (
            '[chapter]\nminutes = { one = "{count} min" }',
            "'chapter.minutes'; legal: a text for 'one'",
        ),
        ("[labels]\nfigure = 3", "'labels.figure'; legal: a text"),
        ('[labels]\nfigure = "F {"', "'labels.figure' has other places in braces"),
        ('[language]\ndecimal = "comma"', "'language.decimal'; legal: one sign"),
        ('[language]\ndirection = "left"', "'language.direction'; legal: 'ltr' or 'rtl'"),
    ],
)
def test_invalid_text_of_a_book_language_is_reported_at_its_line(
    line: str, message: str, make_book: MakeBook
) -> None:
    outline = OUTLINE + 'language = "xx"\n'
    files = {"content/languages/xx.toml": f"{line}\n", "content/book.toml": outline}
    (found,) = diagnostics(make_book("Text.\n", files))
    assert (found.path, found.line) == ("content/languages/xx.toml", 2)
    assert found.message.startswith(message)
