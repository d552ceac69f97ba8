"""A book in a second language: chapters fall back one by one, and places, figures and answers are
those of the original."""

import json
import re
from collections.abc import Callable, Mapping
from dataclasses import replace

import pytest
from support.html_outline import Page, read_html
from support.little_book import OUTLINE, diagnostics, rendered

from site_builder.build import Options
from site_builder.languages.words import load_words
from site_builder.sources.translations.labels import figure_markup

ORIGINAL = """\
## How far {#far}

A {term}`bend` of $\\calc{1/4}$, as {ref}`second` says.

$$x = 1$$

:::{simulation} demo
Look.
:::

:::{quiz} which
Which one?
- [x] This
  : Yes.
- [ ] That
  : No.
:::
"""
TRANSLATED = """\
---
title: Erstes
summary: Das erste Kapitel.
---

## Wie weit {#far}

Eine {term}`Biegung` von $\\calc{1/4}$, siehe {ref}`second`.

$$x = 1$$

:::{simulation} demo
Schauen Sie.
:::

:::{quiz} which
Welches?
- [x] Dieses
  : Ja.
- [ ] Jenes
  : Nein.
:::
"""
GLOSSARY = '["bend"]\nsays = "What bends."\nexplained = "first#far"\n'
GERMAN = {
    "content/de/00-first.md": TRANSLATED,
    "content/de/book.toml": 'title = "Kleines Buch"\n[starts]\n"Los" = "first"\n',
    "content/de/glossary.toml": '["bend"]\nname = "Biegung"\nsays = "Was sich biegt."\n',
}

type Translate = Callable[..., Options]


@pytest.fixture
def translate(make_book: Callable[..., Options]) -> Translate:
    """The book with its translation, other words in place of some of that."""

    def made(old: str = "", new: str = "", files: Mapping[str, str] | None = None) -> Options:
        chapter = {"content/de/00-first.md": TRANSLATED.replace(old, new, 1)} if old else {}
        glossary = {"content/glossary.toml": GLOSSARY}
        options = make_book(ORIGINAL, {**glossary, **GERMAN, **chapter, **(files or {})})
        return replace(options, warn=lambda _warning: None)

    return made


@pytest.fixture
def site(translate: Translate) -> Mapping[str, bytes]:
    return rendered(translate())


def hrefs(page: Page) -> dict[str, str | None]:
    """Of links to other pages, with the language that each is said to lead to."""
    links = [link.attributes for link in page.all("a")]
    return {str(link["href"]): link.get("hreflang") for link in links if "href" in link}


def test_a_chapter_that_is_not_translated_is_the_originals(site: Mapping[str, bytes]) -> None:
    pages = {name for name in site if name.startswith("de/")}
    assert pages == {"de/index.html", "de/first/index.html"}
    links = hrefs(read_html(site["de/first/index.html"]))
    assert links["../../second/"] == "en"
    assert links["../../glossary/#bend"] == "en"
    assert links["../../de/"] is None
    assert hrefs(read_html(site["de/index.html"]))["../de/first/"] is None
    assert "en" not in hrefs(read_html(site["first/index.html"])).values()
    titles = re.findall(r'class="contents-title"([^>]*)>', site["de/first/index.html"].decode())
    assert {*titles} == {"", ' lang="en"'}


def test_both_pages_of_a_chapter_lead_to_each_other(site: Mapping[str, bytes]) -> None:
    assert hrefs(read_html(site["first/index.html"]))["../de/first/"] == "de"
    assert hrefs(read_html(site["de/first/index.html"]))["../../first/"] == "en"
    assert "de" not in hrefs(read_html(site["second/index.html"])).values()
    for name, language in (("first/index.html", "en"), ("de/first/index.html", "de")):
        page = site[name].decode()
        assert f'<html lang="{language}"' in page
        alternates = re.findall(r'<link rel="alternate" hreflang="(\w+)"', page)
        assert alternates == ["en", "de"]


def test_a_translation_shares_ids_answers_and_stills(site: Mapping[str, bytes]) -> None:
    first, german = (site[name].decode() for name in ("first/index.html", "de/first/index.html"))
    for pattern in (
        r'<h2 id="([^"]+)"',
        r'class="equation" id="([^"]+)"',
        r'"edition": "(\w+)"',
        r'src="(?:\.\./)+assets/([^"]+stills/[^"]+)"',
    ):
        found = re.findall(pattern, first)
        assert found, pattern
        assert found == re.findall(pattern, german), pattern
    assert json.loads(site["book.json"])["chapters"][0]["title"] == "First"


def test_a_translation_speaks_its_language(site: Mapping[str, bytes]) -> None:
    page = site["de/first/index.html"].decode()
    words = re.search(r'<script type="application/json" id="words">(.*?)</script>', page)
    assert words
    assert json.loads(words[1])["DECIMAL"] == ","
    assert "0{,}25" in page or "0,25" in page
    assert "Was sich biegt." in page
    assert "What bends." not in page
    assert 'id="words"' not in site["first/index.html"].decode()
    css = next(site[name].decode() for name in site if name.endswith("css/book.css"))
    assert ":root:lang(de)" in css


def test_figures_say_what_is_translated_with_the_decimal_sign(translate: Translate) -> None:
    labels = '"Distortion" = "Verzeichnung"\n"# px" = "# Pixel"\n"Plan" = 1\n"# m" = "m"\n'
    path = "content/de/labels.toml"
    assert len(diagnostics(translate(files={path: labels}))) == 2
    sound = labels.partition('"Plan"')[0]
    page = rendered(translate(files={path: sound}))["de/first/index.html"].decode()
    assert ">Verzeichnung</label>" in page
    assert '"label": "Verzeichnung"' in page
    assert ">Distortion<" not in page
    words = replace(load_words("de"), figures={"(#, #) px": "(#; #) px", "#": "#"})
    assert figure_markup("<text>(0.5, −2) px</text>", words) == "<text>(0,5; −2) px</text>"
    slider = '<div aria-label="1.5" aria-valuenow="1.5"></div>'
    assert figure_markup(slider, words) == '<div aria-label="1,5" aria-valuenow="1.5"></div>'


def test_a_title_page_alone_is_a_translation(make_book: Callable[..., Options]) -> None:
    site = rendered(make_book(files={"content/de/book.toml": 'subtitle = "Ein Buch."\n'}))
    page = site["de/index.html"].decode()
    assert "Ein Buch." in page
    assert "Small Book" in page


@pytest.mark.parametrize(
    ("old", "new", "line", "told"),
    [
        ("{#far}", "", 6, "'wie-weit'"),
        ("{#far}", "{#Far!}", 6, "heading id"),
        ("$$x = 1$$", "$$x = 2$$", 10, "equation"),
        ("$$x = 1$$\n", "", 6, "no equation"),
        ("demo\n", "demo\n:k1: 0.1\n", 12, "not set as in content/00-first.md:"),
        ("- [x] Dieses", "- [ ] Dieses", 16, "no right answer"),
        ("{quiz} which", "{quiz} whom", 16, "'quiz-whom'"),
        ("{term}`Biegung`", "{term}`bend`", 8, "unknown term"),
        ("- [ ] Jenes\n  : Nein.\n", "- [ ] Jenes\n  : Nein.\n- [ ] Keines\n  : Nein.\n", 16,
         "other answers than content/00-first.md:"),
    ],
)  # fmt: skip
def test_what_differs_from_the_original_is_reported(
    translate: Translate, old: str, new: str, line: int, told: str
) -> None:
    found = [
        (item.line, item.message)
        for item in diagnostics(translate(old, new))
        if item.path == "content/de/00-first.md"
    ]
    assert any(at == line and told in message for at, message in found), found


@pytest.mark.parametrize(
    ("path", "text", "told"),
    [
        ("content/de/00-frist.md", TRANSLATED, "not in content/book.toml"),
        ("content/de/book.toml", 'titel = "B"\n', "unknown key 'titel'"),
        (
            "content/de/labels.toml",
            '"after 2 s" = "nach 2 s"\n',
            "'after # s', '#' for each number",
        ),
        (
            "content/de/00-first.md",
            TRANSLATED.replace("Das erste Kapitel.", "The first chapter."),
            "is that of",
        ),
        ("content/de/book.toml", 'hero_caption = "[Hier](00-first.md)"\n', "link '00-first.md' in"),
        ("content/de/labels.toml", '"Plan" = "<b>Plan"\n', "a text without"),
        ("content/de/book.toml", '[parts]\n"Teil" = "second"\n', "unknown chapter 'second'"),
        ("content/de/glossary.toml", '["bent"]\nname = "B"\nsays = "S."\n', "unknown term 'bent'"),
    ],
)
def test_files_of_a_translation_are_checked(
    translate: Translate, path: str, text: str, told: str
) -> None:
    found = [item for item in diagnostics(translate(files={path: text})) if item.path == path]
    assert [told in item.message for item in found] == [True]


def test_mistakes_of_what_is_not_translated_are_told_once(translate: Translate) -> None:
    outline = OUTLINE + '[starts]\n"Begin" = "nowhere"\n'
    files = {"content/book.toml": outline, "content/de/book.toml": 'title = "Kleines Buch"\n'}
    found = [item for item in diagnostics(translate(files=files)) if item.fails]
    assert [(item.path, item.line) for item in found] == [("content/book.toml", 6)]


def test_numbers_are_drawn_with_a_decimal_point_in_every_language(translate: Translate) -> None:
    drawn = "\n:::{quiz} drawn\n:draw: t = 1.5, 2.5\nHow many?\n"
    drawn += "- [x] {calc}`t`\n  : Yes.\n- [ ] {calc}`2 * t`\n  : No.\n:::\n"
    original = "---\ntitle: First\nsummary: The first.\n---\n\n" + ORIGINAL + drawn
    files = {"content/00-first.md": original, "content/de/00-first.md": TRANSLATED + drawn}
    options = translate(files=files)
    assert [item for item in diagnostics(options) if item.fails] == []
    assert "2,5" in rendered(options)["de/first/index.html"].decode()


def test_parts_of_a_translation_are_the_originals(
    make_book: Callable[..., Options],
) -> None:
    parts = '[parts]\n"One" = "first"\n"Two" = "second"\n'
    german = {"content/de/book.toml": '[parts]\n"Eins" = "first"\n'}
    found = diagnostics(make_book(files={"content/book.toml": OUTLINE + parts, **german}))
    assert [item.message.partition(";")[0] for item in found] == ["no part begins with 'second'"]


def test_a_translation_as_it_should_be_has_no_mistake(translate: Translate) -> None:
    assert [item for item in diagnostics(translate()) if item.fails] == []
