"""The pages of a small book: links, catalogue, licences, title page, policy and reading times."""

import base64
import hashlib
import json
import posixpath
import re
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

import pytest
from PIL import Image
from support.html_outline import Page, read_html
from support.little_book import (
    FIXTURES,
    OUTLINE,
    OUTLINE_WITH_FIGURE,
    MakeBook,
    plain_scripts,
    rendered,
    write_book,
)

from site_builder.build import check_site, render_site
from site_builder.diagnostics.diagnostic import BuildError
from site_builder.markdown.content_files import picture_size
from site_builder.output.writer import Content, content_bytes
from site_builder.pages.licences import gather_licences
from site_builder.render.minutes import reading_minutes
from site_builder.runtime.store import VERSIONS

BOOK = "content/book.toml"
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


def test_book_has_no_empty_pages(pages: Mapping[str, Page]) -> None:
    folders = {path.removesuffix("index.html") for path in pages}
    module = "source/simulations/models/thing/"
    embeds = {"embed/first/figure-demo/", "embed/first/figure-demo-2/"}
    assert folders == {"", "404.html", "first/", "second/", "class/", "licences/", module, *embeds}


def test_every_relative_link_leads_to_a_file_or_an_element(
    site: Mapping[str, bytes], pages: Mapping[str, Page]
) -> None:
    def ids(path: str) -> set[str | None]:
        return {element.attributes.get("id") for element in pages[path].elements}

    for path in pages.keys() - {"404.html"}:
        for address in pages[path].addresses():
            if not address.startswith(("https://", "data:")):
                file, _, anchor = address.partition("#")
                target = resolved(path, file.partition("?")[0])
                assert target in site, f"{path}: {address}"
                assert not anchor or anchor in ids(target), f"{path}: {address}"


def resolved(page: str, file: str) -> str:
    if not file:
        return page
    target = posixpath.normpath(posixpath.join(posixpath.dirname(page), file)).lstrip("./")
    return target if "." in posixpath.basename(target) else f"{target}/index.html".lstrip("/")


def test_catalogue_has_controls_of_figures_and_options_of_questions(
    site: Mapping[str, bytes],
) -> None:
    book = json.loads(site["book.json"])
    assert [(one["number"], one["url"]) for one in book["chapters"]] == [
        (0, "first/"),
        (1, "second/"),
    ]
    (figure, *_), (quiz, *_) = book["simulations"], book["quizzes"]
    assert [control["name"] for control in figure["controls"]] == ["k1", "kind", "on", "play"]
    assert quiz["options"] == [{"text": "4", "correct": False}, {"text": "6", "correct": True}]


def test_licences_of_all_shipped_parts_are_complete(site: Mapping[str, bytes]) -> None:
    """Only a book with figures has the licences of the interpreter."""
    of_the_runtime = (
        "Mozilla Public License Version 2.0",
        "PYTHON SOFTWARE FOUNDATION LICENSE",
        "NumPy Developers",
    )
    page = site["licences/index.html"].decode()
    assert "SIL OPEN FONT LICENSE" in page
    assert not any(phrase in page for phrase in of_the_runtime)
    texts = "".join(licence.text for licence in gather_licences(Path(), VERSIONS))
    assert all(phrase in texts for phrase in of_the_runtime)


def test_title_page_has_starts_parts_and_the_first_figure_of_a_chapter(make_book: MakeBook) -> None:
    more = '[starts]\n"Begin" = "second"\n"Look" = "second#a-section"\n'
    more += '[path]\ntitle = "A path"\n[path.stops]\n"Why?" = "first"\n'
    outline = OUTLINE_WITH_FIGURE + more + '[parts]\nMotion = "second"\n'
    body = ":::{simulation} demo\nTry: it.\n:::\n"
    site = rendered(make_book(body, {BOOK: outline}))
    page = read_html(site["index.html"])
    assert {"./second/", "./second/#a-section", "#path", "./first/"} <= {*page.addresses()}
    assert [each.text for each in page.all("h3")] == ["Motion"]
    shown = [e for e in page.elements if "thumbnail" in e["class"]]
    assert len(shown) == 1, "of two chapters, one has a figure"
    contents = read_html(site["first/index.html"])
    assert "Motion" in [e.text for e in contents.elements if "nav" in e.inside]


def rules(site: Mapping[str, Content], path: str) -> dict[str, list[str]]:
    """The sources of each directive of the page's policy."""
    found = POLICY.search(content_bytes(site[path]).decode())
    assert found, path
    return {name: sources for name, *sources in map(str.split, found[1].split("; "))}


def hashed(text: str) -> str:
    return f"'sha256-{base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()}'"


OWN = {"'self'", "'wasm-unsafe-eval'"}
ANY = "'unsafe-inline'"
HOST = "https://host.example/"


@pytest.mark.parametrize(
    ("address", "trust", "scripts", "styles"),
    [
        (HOST, "", set(), set()),
        (HOST, "[trust]\nraw_html = true\n", {ANY}, {ANY}),
        ("", "", {"'unsafe-eval'"}, {ANY}),
    ],
    ids=["published", "with trusted HTML", "not published, for tools"],
)
def test_policy_allows_hashed_scripts_and_html_of_a_trusted_author(
    make_book: MakeBook, address: str, trust: str, scripts: set[str], styles: set[str]
) -> None:
    site = render_site(replace(make_book(files={BOOK: OUTLINE + trust}), address=address))
    for path in ("index.html", "first/index.html", "404.html"):
        page, allowed = content_bytes(site[path]).decode(), rules(site, path)
        for (name, inline), more in zip(INLINE.items(), (scripts, styles), strict=True):
            hashes = {hashed(text) for text in re.findall(inline, page, re.DOTALL)}
            assert hashes
            assert {*allowed[name]} - OWN == (more if ANY in more else more | hashes)
        assert allowed["default-src"] == ["'self'"]
        assert allowed["object-src"] == allowed["frame-src"] == ["'none'"]


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
def test_size_of_a_picture_file_is_read(
    tmp_path: Path, svg: str, size: tuple[int, int] | None
) -> None:
    drawing, photograph = tmp_path / "a.svg", tmp_path / "a.png"
    drawing.write_text(svg, encoding="utf-8")
    assert picture_size(drawing) == size
    Image.new("L", (5, 3)).save(photograph)
    assert picture_size(photograph) == (5, 3)


@pytest.mark.parametrize(
    ("text", "minutes"),
    [
        ("word " * 540, 3),
        ("$x$ " * 75, 3),
        ("$$x = 1$$\n\n" * 12, 3),
        (":::{simulation} demo\n:::\n\n" * 2, 3),
        (":::{predict} a\nNow?\n- [x] A\n  : So.\n- [ ] B\n  : No.\n:::\n\n" + "word " * 180, 2),
    ],
)
def test_reading_time_counts_words_formulae_figures_and_questions(
    make_book: MakeBook, text: str, minutes: int
) -> None:
    book, *_ = check_site(make_book(text))
    assert reading_minutes(book.chapters[0].body) == minutes


def test_first_pass_beyond_its_minutes_is_refused(make_book: MakeBook) -> None:
    text = "word " * 540
    outline = {"content/book.toml": f"first_pass = 2\n{OUTLINE}"}
    with pytest.raises(BuildError, match="a first pass of 3 minutes; legal: at most 2"):
        check_site(make_book(text, files=outline))
    check_site(make_book(f"## More {{.deeper}}\n\n{text}", files=outline))
