"""The words of the interface: each language has all, each is asked for, none is lost."""

import re
from collections.abc import Iterator, Mapping
from pathlib import Path

import pytest
from markupsafe import Markup

from site_builder.languages.words import ENGLISH, SCRIPT, Words, languages, load_words

ROOT = Path(__file__).parents[3]
OTHERS = [language for language in languages() if language != "en"]
PLACEHOLDER = re.compile(r"\{(\w+)\}")
BLOCK_COMMENT = re.compile(r"/\*.*?\*/", re.DOTALL)
NAMES = {
    "CPython", "DOI", "Esc", "ISBN", "ORCID", "QTIv", "Package",
    "data", "doi", "embed", "feed", "https", "isbn", "orcid", "org", "urn", "uuid", "xml",
}  # fmt: skip
"""What is called the same in all languages, parts of addresses, and the name of QTI's packages."""
OF_TEMPLATES = re.compile(r"""\bt\(\s*"([\w.-]+)("\s*~)?""")
OF_PYTHON = re.compile(r"""\bwords\(\s*(f?)"([\w.-]+)""")
OF_THE_ENGINE = re.compile(r"""\bMessage\(\s*"([\w.-]+)""")
OF_SCRIPTS = re.compile(r"""\bwords\(\s*(["`])([\w.-]+)""")
QUOTED = re.compile(r"""["'`]([a-z][\w-]*(?:\.[\w-]+)+)["'`]""")
MADE = (
    "labels.", "style.", "callout.", "landing.count_", "script.theme.", "script.figure.",
    "script.predict.", "script.runtime.", "script.stage_report.", "script.tools.python_copied",
    "script.search.found", "script.search.near",
)  # fmt: skip
"""Begin the keys that are put together where they are asked for."""


def sources() -> Iterator[tuple[Path, str]]:
    for folder, kinds in (
        ("site_builder", (".py", ".html", ".xml", ".ts")),
        ("static/js", (".ts",)),
        *((f"simulations/{part}", (".py", ".html", ".ts")) for part in ("engine", "editing")),
    ):
        for file in sorted((ROOT / folder).rglob("*")):
            if file.suffix in kinds:
                yield file, file.read_text(encoding="utf-8")


def asked() -> Iterator[tuple[str, bool]]:
    """Keys that something asks for, and whether each is whole or only its beginning."""
    for file, text in sources():
        if file.suffix == ".ts":
            yield from ((SCRIPT + key, mark == '"') for mark, key in OF_SCRIPTS.findall(text))
        elif file.suffix == ".py":
            yield from ((key, not made) for made, key in OF_PYTHON.findall(text))
            yield from ((SCRIPT + key, True) for key in OF_THE_ENGINE.findall(text))
        else:
            yield from ((key, not joined) for key, joined in OF_TEMPLATES.findall(text))


def forms(text: str | Mapping[str, str]) -> list[str]:
    return [text] if isinstance(text, str) else list(text.values())


def test_every_word_that_is_asked_for_is_there() -> None:
    missing = [
        key
        for key, whole in asked()
        if not (key in ENGLISH.texts if whole else any(k.startswith(key) for k in ENGLISH.texts))
    ]
    assert missing == []


def test_every_word_is_asked_for() -> None:
    whole = {key for key, _ in asked()}
    for file, text in sources():
        named = QUOTED.findall(text)
        whole |= {SCRIPT + key if file.suffix == ".ts" else key for key in named} | set(named)
    unused = [
        key
        for key in ENGLISH.texts
        if key not in whole and not key.startswith((*MADE, "language.name"))
    ]
    assert unused == []


@pytest.mark.parametrize("language", OTHERS)
def test_a_language_has_the_keys_of_english(language: str) -> None:
    assert list(load_words(language).texts) == list(ENGLISH.texts)


@pytest.mark.parametrize("language", OTHERS)
def test_a_text_has_the_placeholders_of_the_english_one(language: str) -> None:
    def named(words: Words) -> dict[str, tuple[set[str], int]]:
        return {
            key: (
                {name for form in forms(text) for name in PLACEHOLDER.findall(form)},
                len(forms(text)),
            )
            for key, text in words.texts.items()
        }

    assert named(load_words(language)) == named(ENGLISH)


@pytest.mark.parametrize("language", languages())
def test_a_text_can_stand_in_an_attribute(language: str) -> None:
    texts = load_words(language).texts
    assert [key for key, text in texts.items() if any('"' in form for form in forms(text))] == []


def test_the_form_follows_the_number() -> None:
    words = Words("xx", {"a.b": {"one": "{count} thing", "other": "{count} things"}})
    assert [words("a.b", count=count) for count in (0, 1, 2)] == ["0 things", "1 thing", "2 things"]


def test_what_is_put_into_a_page_is_escaped_unless_it_is_markup() -> None:
    words = Words("xx", {"a.b": "{one} & {other}"})
    assert words.html("a.b", one="<", other=Markup("<b>x</b>")) == "&lt; &amp; <b>x</b>"


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
def test_numbers_are_written_as_the_language_does(text: str, german: str) -> None:
    assert load_words("de").numeral(text) == german
    assert ENGLISH.numeral(text) == text


def test_an_authors_label_takes_the_place_of_the_languages() -> None:
    words = load_words("de").labelled({"figure": "Bild", "table": ""})
    assert (words.label("Figure"), words.label("Table")) == ("Bild", "Tabelle")


def test_templates_say_nothing_of_their_own() -> None:
    said = {word for file, text in sources() if "templates" in file.parts for word in bare(text)}
    assert said <= NAMES


def test_scripts_say_nothing_of_their_own() -> None:
    sentence = re.compile(r"""["`]([A-Z][a-z]+ [a-z][^"`]*)["`]""")
    texts = (BLOCK_COMMENT.sub("", text) for file, text in sources() if file.suffix == ".ts")
    assert [found for text in texts for found in sentence.findall(text)] == []


def bare(template: str) -> list[str]:
    """Words that stand in a template itself, between its tags or in what is read out."""
    scripts = r"\{% set (begin|find_home|looks) %\}.*?\{% endset %\}"
    for hidden in (
        scripts,
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
