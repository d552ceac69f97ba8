"""The pages of a small book: well formed, complete without scripts, and as the contract says."""

import base64
import hashlib
import json
import posixpath
import re
from collections.abc import Mapping
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import pytest
from PIL import Image
from support.html_outline import Page, read_html
from support.little_book import (
    FIXTURES,
    OUTLINE,
    SHOWN,
    MakeBook,
    plain_scripts,
    rendered,
    write_book,
)

from site_builder.build import check_site, render_site
from site_builder.markdown.content_files import picture_size
from site_builder.markdown.directives.download import size_words
from site_builder.output.assets import Content, content_bytes
from site_builder.pages.licences import gather_licences
from site_builder.pages.page import reading_minutes
from site_builder.runtime.pinned import VERSIONS

ADDRESS = "https://host.example/"
POLICY = re.compile(r'<meta http-equiv="Content-Security-Policy" content="([^"]*)">')
INLINE = {"script-src": r"<script>(.*?)</script>", "style-src": r"<style>(.*?)</style>"}


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Mapping[str, bytes]:
    body = (FIXTURES / "pages.md").read_text(encoding="utf-8")
    with plain_scripts():
        return rendered(write_book(tmp_path_factory.mktemp("site"), body))


@pytest.fixture(scope="module")
def pages(site: Mapping[str, bytes]) -> Mapping[str, Page]:
    return {path: read_html(page) for path, page in site.items() if path.endswith(".html")}


@pytest.fixture
def chapter(pages: Mapping[str, Page]) -> Page:
    return pages["first/index.html"]


def test_a_book_has_no_page_that_it_has_nothing_for(pages: Mapping[str, Page]) -> None:
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


def test_a_page_loads_nothing_from_elsewhere(pages: Mapping[str, Page]) -> None:
    for path, page in pages.items():
        for element in page.elements:
            for name in ("src", "href") if element.tag != "a" else ():
                assert "//" not in element[name], path


def test_a_page_for_frames_has_its_figure_and_leads_to_the_book(pages: Mapping[str, Page]) -> None:
    page = pages["embed/first/figure-demo/index.html"]
    assert len(page.all("simulation-figure")) == 1
    assert not [item for tag in ("header", "nav", "footer", "dialog") for item in page.all(tag)]
    links = [link for link in page.all("a") if link["target"]]
    assert [(link["href"], link["target"]) for link in links] == [
        ("../../../first/../second/#a-section", "_blank"),
        ("../../../first/#figure-demo", "_blank"),
    ]


def test_headings_never_skip_a_level_and_sections_can_be_linked_to(
    pages: Mapping[str, Page],
) -> None:
    for path in pages.keys() - {"404.html"}:
        tags = [element.tag for element in pages[path].elements]
        levels = [int(tag[1]) for tag in tags if tag in ("h1", "h2", "h3", "h4")]
        assert (levels[0], levels.count(1)) == (1, 1), path
        assert all(b <= a + 1 for a, b in pairwise(levels)), path
    links = [(link["href"], link["aria-label"]) for link in pages["first/index.html"].all("a")]
    assert ("#start", "Link to Start") in links


def test_a_figure_shows_its_still_its_numbers_and_its_controls(
    chapter: Page, site: Mapping[str, bytes]
) -> None:
    figure = chapter.all("simulation-figure")[0].attributes
    assert figure == {"data-simulation": "demo", "data-state": "still", "data-frames": "0"}
    still = chapter.all("img", "still")[0]["src"]
    assert site[resolved("first/index.html", still)].startswith(b"RIFF")
    texts = [item.text for item in chapter.all("output")[:2]]
    assert texts == ["\u22120.25", "1.00 0.00\n0.00 1.00"]
    assert "Shows k1 of -0.25 in tier fast." in [each.text for each in chapter.all("p")]
    slider = next(element for element in chapter.all("input") if element["name"] == "k1")
    assert (slider["min"], slider["max"], slider["value"]) == ("-0.5", "0.5", "-0.25")
    inside = (e for e in chapter.elements if "form" in e.inside and e.tag != "output")
    fields = [element["name"] for element in inside if element["name"]]
    assert fields[:5] == ["k1", "kind", "on", "play", "tier"]


def test_the_schema_in_the_page_holds_controls_values_and_tiers(chapter: Page) -> None:
    schema = json.loads(chapter.all("script", "schema")[0].text)
    assert schema["values"] == {"k1": -0.25, "kind": "a", "on": False, "play": 0}
    assert schema["tiers"] == ["fast", "exact"]
    assert (schema["default_tier"], schema["draft_tier"]) == ("fast", "fast")
    kinds = [control["kind"] for control in schema["controls"]]
    assert kinds == ["slider", "choice", "toggle", "action"]


def test_a_quiz_can_be_answered_by_keyboard_and_read_by_its_script(chapter: Page) -> None:
    (form,) = (form for form in chapter.all("form") if form["data-quiz"])
    assert form["data-quiz"] == "first-quiz"
    answers = [element for element in chapter.all("input") if element["name"] == "answer"]
    assert [(each["type"], each["value"]) for each in answers] == [("radio", "0"), ("radio", "1")]
    assert [each for each in chapter.elements if each["role"] == "status"]
    data = json.loads(chapter.all("script", "quiz-data")[0].text)
    assert [option["correct"] for option in data["options"]] == [False, True]
    assert data["options"][1]["explanation_html"] == "Yes, for a reason."


def test_chapters_are_linked_in_order(pages: Mapping[str, Page]) -> None:
    def led_to(page: str, rel: str) -> list[str]:
        return [link["href"] for link in pages[f"{page}/index.html"].all("a") if link["rel"] == rel]

    assert (led_to("first", "next"), led_to("second", "prev")) == (["../second/"], ["../first/"])


def test_the_catalogue_lists_chapters_simulations_and_quizzes(site: Mapping[str, bytes]) -> None:
    book = json.loads(site["book.json"])
    chapters = [(c["number"], c["id"], c["title"], c["url"]) for c in book["chapters"]]
    assert chapters == [(0, "first", "First", "first/"), (1, "second", "Second", "second/")]
    first, (simulation, *_), (quiz, *_) = book["chapters"][0], book["simulations"], book["quizzes"]
    assert (first["simulations"], first["quizzes"]) == (["demo"], ["first-quiz"])
    assert (simulation["id"], simulation["tiers"]) == ("demo", ["fast", "exact"])
    assert [control["name"] for control in simulation["controls"]] == ["k1", "kind", "on", "play"]
    assert (quiz["id"], quiz["chapter"], quiz["kind"]) == ("first-quiz", "first", "single")
    assert quiz["options"] == [{"text": "4", "correct": False}, {"text": "6", "correct": True}]


def test_licences_of_all_that_is_shipped_are_given_in_full(site: Mapping[str, bytes]) -> None:
    """Licences of the interpreter are where it is."""
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


def test_the_title_page_has_starts_parts_and_the_first_figure_of_a_chapter(
    make_book: MakeBook,
) -> None:
    more = '[starts]\n"Begin" = "second"\n"Look" = "second#a-section"\n'
    outline = SHOWN + more + '[parts]\nMotion = "second"\n'
    body = ":::{simulation} demo\nTry: it.\n:::\n"
    site = rendered(make_book(body, {"content/book.toml": outline}))
    page = read_html(site["index.html"])
    assert {"./second/", "./second/#a-section"} <= {*page.addresses()}
    assert [each.text for each in page.all("h3")] == ["Motion"]
    shown = [e for e in page.elements if "thumbnail" in e["class"]]
    assert len(shown) == 1, "of two chapters, one has a figure"
    contents = read_html(site["first/index.html"])
    assert "Motion" in [e.text for e in contents.elements if "nav" in e.inside]


def test_the_contents_lead_to_the_lecture_plan_where_there_is_one(make_book: MakeBook) -> None:
    plan = 'intro = "I."\n[[section]]\nnumber = "2"\ntitle = "T"\nnote = "N."\n'
    plan += 'taught = ["second#a-section"]\n'
    for file, led in ((None, False), (plan, True)):
        site = rendered(make_book(files={"content/lecture-plan.toml": file}))
        addresses = read_html(site["first/index.html"]).addresses()
        assert ("../lecture-plan/" in addresses) is led


def rules(site: Mapping[str, Content], path: str) -> dict[str, list[str]]:
    """The sources of each directive of the page's policy."""
    found = POLICY.search(content_bytes(site[path]).decode())
    assert found, path
    return {name: sources for name, *sources in map(str.split, found[1].split("; "))}


def hashed(text: str) -> str:
    return f"'sha256-{base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()}'"


def test_inline_scripts_and_styles_are_allowed_by_their_hash_alone(make_book: MakeBook) -> None:
    site = render_site(replace(make_book(), address=ADDRESS))
    for path in ("index.html", "first/index.html", "404.html"):
        page, allowed = content_bytes(site[path]).decode(), rules(site, path)
        scripts, styles = (
            [hashed(text) for text in re.findall(pattern, page, re.DOTALL)]
            for pattern in INLINE.values()
        )
        assert scripts
        assert styles
        assert allowed["script-src"] == ["'self'", "'wasm-unsafe-eval'", *scripts]
        assert allowed["style-src"] == ["'self'", *styles]
        assert allowed["default-src"] == ["'self'"]
        assert allowed["object-src"] == allowed["frame-src"] == ["'none'"]


def test_html_that_the_author_is_trusted_with_runs(make_book: MakeBook) -> None:
    outline = f'{OUTLINE}address = "{ADDRESS}"\n[trust]\nraw_html = true\n'
    site = render_site(make_book("<b>Text</b>\n", {"content/book.toml": outline}))
    allowed = rules(site, "first/index.html")
    assert allowed["script-src"] == ["'self'", "'wasm-unsafe-eval'", "'unsafe-inline'"]
    assert allowed["style-src"] == ["'self'", "'unsafe-inline'"]


def test_while_the_book_is_written_pages_link_to_their_styles_and_listen(
    make_book: MakeBook,
) -> None:
    assert b"/.reload/" not in rendered(make_book())["first/index.html"]
    page = rendered(replace(make_book(), reload=True))["first/index.html"]
    assert b"/.reload/" in page
    assert b"<style>" not in page
    assert b'<link rel="stylesheet"' in page
    assert b" integrity=" not in page


def test_tools_may_evaluate_text_only_where_the_book_is_not_published(make_book: MakeBook) -> None:
    for address, may in (("", True), (ADDRESS, False)):
        site = render_site(replace(make_book(), address=address))
        assert ("'unsafe-eval'" in rules(site, "first/index.html")["script-src"]) is may


def test_a_download_is_published_as_it_is_and_other_files_are_not(make_book: MakeBook) -> None:
    files: dict[str, str | None] = {f"content/data/{name}.csv": "x,y\n1,2\n" for name in "ab"}
    site = rendered(make_book(":::{download} data/a.csv\nAll.\n:::\n", files))
    (published,) = (path for path in site if path.endswith(".csv"))
    assert published.endswith("a.csv")
    assert site[published] == b"x,y\n1,2\n"


@pytest.mark.parametrize(
    ("size", "words"),
    [(0, "0 bytes"), (999, "999 bytes"), (1000, "1.0 kB"), (9960, "10 kB"), (3.5e7, "35 MB")],
)
def test_sizes_are_given_in_two_digits(size: float, words: str) -> None:
    assert size_words(int(size)) == words


@pytest.mark.parametrize(
    ("svg", "size"),
    [
        ('<?xml version="1.0"?>\n<svg viewBox="0 0 64.4 32"/>', (64, 32)),
        ("<svg width='12' height='7.6px' viewBox='0 0 1 1'/>", (12, 8)),
        ('<svg width="100%" height="100%" viewBox="0,0,30,20"/>', (30, 20)),
        ("<svg/>", None),
        ('<svg viewBox="0 0 a b"/>', None),
        ("no picture", None),
    ],
)
def test_a_picture_file_has_its_size(
    tmp_path: Path, svg: str, size: tuple[int, int] | None
) -> None:
    drawing, photograph = tmp_path / "a.svg", tmp_path / "a.png"
    drawing.write_text(svg, encoding="utf-8")
    assert picture_size(drawing) == size
    Image.new("L", (5, 3)).save(photograph)
    assert picture_size(photograph) == (5, 3)


def test_540_words_are_read_in_three_minutes(make_book: MakeBook) -> None:
    book, *_ = check_site(make_book("word " * 540))
    assert reading_minutes(book.chapters[0], lambda _figure: "") == 3
