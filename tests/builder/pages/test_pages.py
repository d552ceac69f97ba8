"""The pages of a small book: well formed, complete without scripts, and as the contract says."""

import json
import posixpath
from collections.abc import Callable, Mapping
from itertools import pairwise
from pathlib import Path

import pytest
from support.html_outline import Page, read_html
from support.little_book import files_of, rendered

from site_builder.build import Options
from site_builder.pages.licences import gather_licences
from site_builder.runtime.pinned import VERSIONS


@pytest.fixture
def site(make_book: Callable[..., Options]) -> Mapping[str, bytes]:
    return rendered(make_book(files=files_of("pages")))


@pytest.fixture
def pages(site: Mapping[str, bytes]) -> Mapping[str, Page]:
    return {path: read_html(page) for path, page in site.items() if path.endswith(".html")}


@pytest.fixture
def chapter(pages: Mapping[str, Page]) -> Page:
    return pages["first/index.html"]


def test_all_pages_are_well_formed(pages: Mapping[str, Page]) -> None:
    folders = {path.removesuffix("index.html") for path in pages}
    module = "source/simulations/models/thing/"
    embeds = {"embed/first/figure-demo/", "embed/first/figure-demo-2/"}
    assert folders == {"", "404.html", "first/", "second/", "class/", "licences/", module, *embeds}


def test_every_relative_address_leads_to_a_file_or_an_element(
    site: Mapping[str, bytes], pages: Mapping[str, Page]
) -> None:
    def ids(path: str) -> set[str | None]:
        return {element.attributes.get("id") for element in pages[path].elements}

    for path in pages.keys() - {"404.html"}:
        for address in pages[path].addresses():
            if not address.startswith(("https://", "data:")):
                file, _, anchor = address.partition("#")
                target = resolved(path, file)
                assert target in site, f"{path}: {address}"
                assert not anchor or anchor in ids(target), f"{path}: {address}"


def resolved(page: str, file: str) -> str:
    if not file:
        return page
    target = posixpath.normpath(posixpath.join(posixpath.dirname(page), file)).lstrip("./")
    return target if "." in posixpath.basename(target) else f"{target}/index.html".lstrip("/")


def test_a_page_for_frames_has_its_figure_and_leads_to_the_book(pages: Mapping[str, Page]) -> None:
    page = pages["embed/first/figure-demo/index.html"]
    assert len(page.all("simulation-figure")) == 1
    assert not [item for tag in ("header", "nav", "footer", "dialog") for item in page.all(tag)]
    links = [link.attributes for link in page.all("a") if "target" in link.attributes]
    assert [link["href"] for link in links] == [
        "../../../first/../second/#a-section",
        "../../../first/#figure-demo",
    ]
    assert {link["target"] for link in links} == {"_blank"}


def test_headings_never_skip_a_level(pages: Mapping[str, Page]) -> None:
    for path in pages.keys() - {"404.html"}:
        tags = [element.tag for element in pages[path].elements]
        levels = [int(tag[1]) for tag in tags if tag in ("h1", "h2", "h3", "h4")]
        assert levels[0] == 1, path
        assert levels.count(1) == 1, path
        assert all(b <= a + 1 for a, b in pairwise(levels)), path


def test_a_figure_shows_its_still_its_numbers_and_its_controls(
    chapter: Page, site: Mapping[str, bytes]
) -> None:
    figure = chapter.all("simulation-figure")[0].attributes
    assert figure == {"data-simulation": "demo", "data-state": "still", "data-frames": "0"}
    still = chapter.all("img", "still")[0].attributes["src"] or ""
    assert site[resolved("first/index.html", still)].startswith(b"RIFF")
    texts = [item.text for item in chapter.all("output")[:2]]
    assert texts == ["\u22120.25", "1.00 0.00\n0.00 1.00"]
    assert chapter.all("p", "description")[0].text == "Shows k1 of -0.25 in tier fast."
    slider = next(e for e in chapter.all("input") if e.attributes["name"] == "k1").attributes
    assert (slider["min"], slider["max"], slider["value"]) == ("-0.5", "0.5", "-0.25")
    assert chapter.all("span", "control-value")[0].text == "\u22120.25\u00a0px"
    inside = (e for e in chapter.elements if "form" in e.inside and e.tag != "output")
    fields = [e.attributes.get("name") for e in inside]
    assert [name for name in fields if name][:5] == ["k1", "kind", "on", "play", "tier"]


def test_the_schema_in_the_page_holds_controls_values_and_tiers(chapter: Page) -> None:
    schema = json.loads(chapter.all("script", "schema")[0].text)
    assert schema["values"] == {"k1": -0.25, "kind": "a", "on": False, "play": 0}
    assert schema["tiers"] == ["fast", "exact"]
    assert (schema["default_tier"], schema["draft_tier"]) == ("fast", "fast")
    kinds = [control["kind"] for control in schema["controls"]]
    assert kinds == ["slider", "choice", "toggle", "action"]


def test_a_quiz_can_be_answered_by_keyboard_and_read_by_its_script(chapter: Page) -> None:
    assert chapter.all("form", "quiz")[0].attributes["data-quiz"] == "first-quiz"
    answers = [e.attributes for e in chapter.all("input") if e.attributes["name"] == "answer"]
    assert [(a["type"], a["value"]) for a in answers] == [("radio", "0"), ("radio", "1")]
    data = json.loads(chapter.all("script", "quiz-data")[0].text)
    assert [option["correct"] for option in data["options"]] == [False, True]
    assert data["options"][1]["explanation_html"] == "Yes."


def test_chapters_are_linked_in_order(pages: Mapping[str, Page]) -> None:
    def led_to(page: str, rel: str) -> list[str | None]:
        links = pages[f"{page}/index.html"].all("a")
        return [a.attributes["href"] for a in links if a.attributes.get("rel") == rel]

    assert (led_to("first", "next"), led_to("second", "prev")) == (["../second/"], ["../first/"])


def test_the_catalogue_lists_chapters_simulations_and_quizzes(site: Mapping[str, bytes]) -> None:
    book = json.loads(site["book.json"])
    chapters = [(c["number"], c["id"], c["url"]) for c in book["chapters"]]
    assert chapters == [(0, "first", "first/"), (1, "second", "second/")]
    first, (simulation, *_), (quiz, *_) = book["chapters"][0], book["simulations"], book["quizzes"]
    assert (first["simulations"], first["quizzes"]) == (["demo"], ["first-quiz"])
    assert [control["name"] for control in simulation["controls"]] == ["k1", "kind", "on", "play"]
    assert (quiz["id"], quiz["chapter"], quiz["kind"]) == ("first-quiz", "first", "single")
    assert quiz["options"] == [{"text": "4", "correct": False}, {"text": "6", "correct": True}]


def test_a_page_loads_nothing_from_elsewhere(pages: Mapping[str, Page]) -> None:
    for path, page in pages.items():
        for element in page.elements:
            for name in ("src", "href") if element.tag != "a" else ():
                assert "//" not in (element.attributes.get(name) or ""), path


def test_licences_of_what_is_shipped_are_given_in_full(site: Mapping[str, bytes]) -> None:
    """Those of the interpreter where it is."""
    of_the_runtime = (
        "Mozilla Public License Version 2.0",
        "PYTHON SOFTWARE FOUNDATION LICENSE",
        "NumPy Developers",
    )
    page = site["licences/index.html"].decode()
    assert "SIL OPEN FONT LICENSE" in page
    assert not any(phrase in page for phrase in of_the_runtime)
    told = "".join(licence.text for licence in gather_licences(Path(), VERSIONS))
    assert all(phrase in told for phrase in of_the_runtime)


def test_the_title_page_starts_where_the_outline_says(make_book: Callable[..., Options]) -> None:
    options = make_book()
    outline = options.root / "content" / "book.toml"
    starts = '[starts]\n"Begin" = "second"\n"Look" = "second#a-section"\n'
    outline.write_text(f"{outline.read_text(encoding='utf-8')}{starts}", encoding="utf-8")
    page = read_html(rendered(options)["index.html"])
    addresses = page.addresses()
    assert {"./second/", "./second/#a-section"} <= {*addresses}


def test_a_chapter_s_card_shows_its_first_figure(make_book: Callable[..., Options]) -> None:
    options = make_book(":::{simulation} demo\nTry: it.\n:::\n")
    page = read_html(rendered(options)["index.html"])
    shown = [e for e in page.elements if "thumbnail" in (e.attributes.get("class") or "")]
    assert len(shown) == 1, "of two chapters, one has a figure"
