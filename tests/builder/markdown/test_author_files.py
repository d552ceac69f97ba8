"""What an author brings from other files: chapters' parts, pictures, films, downloads."""

import re
from collections.abc import Callable
from pathlib import Path

import pytest
from PIL import Image
from support.html_outline import read_html

from site_builder.build import Options, check_site, render_site
from site_builder.editions.compose import compose
from site_builder.editions.tree import elements
from site_builder.markdown.directives.download import size_words
from site_builder.markdown.files.content_files import picture_size
from site_builder.output.assets import content_bytes
from site_builder.render.sections import chapter_sections

type Find = Callable[..., list[str]]
type MakeBook = Callable[..., Options]

MP4 = "\0\0\0\x18ftypmp42"
FILM = """
:::{video} clips/pan.mp4
:alt: A camera that pans over a checkerboard
:poster: images/plan.svg
:captions: clips/pan.vtt
:language: en-GB
The board slides by.
:::
"""
FILES: dict[str, str | None] = {
    "content/clips/pan.mp4": MP4,
    "content/clips/pan.vtt": "WEBVTT\n\n00:00.000 --> 00:01.000\nHello.\n",
    "content/clips/tale.vtt": "1\nHello.\n",
    "content/images/plan.svg": '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 640 400"/>',
    "content/images/night.svg": '<svg xmlns="http://www.w3.org/2000/svg" width="32" height="20"/>',
    "content/images/tall.svg": '<svg xmlns="http://www.w3.org/2000/svg" width="10" height="20"/>',
    "content/data/points.csv": "x,y\n1,2\n",
}


def page(options: Options) -> str:
    html = content_bytes(render_site(options)["first/index.html"])
    read_html(html)
    return html.decode().partition("<article")[2].partition("</article>")[0]


def test_an_included_file_is_read_where_it_is_named(make_book: MakeBook) -> None:
    parts = {"content/parts/lens.md": "## Lenses\n\nA *lens* bends.\n\n:::{tip}\nLook.\n:::\n"}
    html = page(make_book("Before.\n:::{include} parts/lens.md\n:::\nAfter.\n", parts))
    before, lens, after = (html.index(word) for word in ("Before.", "<em>lens</em>", "After."))
    assert before < lens < after
    assert 'id="lenses"' in html
    assert "<aside" in html


def test_what_is_included_may_include(make_book: MakeBook) -> None:
    parts = {"content/a.md": ":::{include} parts/b.md\n:::\n", "content/parts/b.md": "Deep.\n"}
    assert "<p>Deep.</p>" in page(make_book(":::{include} a.md\n:::\n", parts))


def test_an_included_file_that_changes_is_read_anew(make_book: MakeBook) -> None:
    options = make_book(":::{include} a.md\n:::\n", {"content/a.md": "First words.\n"})
    assert "First words." in page(options)
    (options.root / "content" / "a.md").write_text("Second words.\n", encoding="utf-8")
    html = page(options)
    assert "Second words." in html
    assert "First words." not in html


def test_in_a_listing_an_include_is_code(make_book: MakeBook) -> None:
    html = page(make_book("````\n:::{include} none.md\n:::\n````\n"))
    assert "none.md" in html


def test_mistakes_are_reported_in_the_file_that_holds_them(mistakes: Find) -> None:
    parts: dict[str, str | None] = {"content/parts/lens.md": "One.\n\n:::{nope}\n:::\n\n[x](#no)\n"}
    found = mistakes("Text.\n\n:::{include} parts/lens.md\n:::\n\n[y](#missing)\n", files=parts)
    assert [line.split(": ")[0] for line in found] == [
        "content/00-first.md:10",
        "content/parts/lens.md:3",
        "content/parts/lens.md:6",
    ]


def test_an_id_of_an_included_file_is_found_there(mistakes: Find) -> None:
    parts: dict[str, str | None] = {"content/parts/lens.md": "Text.\n\n## Lens\n"}
    found = mistakes(":::{include} parts/lens.md\n:::\n\n## Lens\n", files=parts)
    assert found == [
        "content/00-first.md:8: duplicate heading id 'lens'; first used at content/parts/lens.md:3"
    ]


@pytest.mark.parametrize(
    ("body", "files", "report"),
    [
        (":::{include} lost.md\n:::\n", {}, "00-first.md:5: unknown Markdown file 'lost.md'"),
        (":::{include} ../a.md\n:::\n", {}, "00-first.md:5: unknown Markdown file '../a.md'"),
        (":::{include}\n:::\n", {}, "00-first.md:5: {include} names no file"),
        (
            ":::{include} a.md\nText.\n:::\n",
            {"a.md": "A.\n"},
            "00-first.md:5: {include} with a body",
        ),
        ("- item\n  :::{include} a.md\n  :::\n", {"a.md": "A.\n"}, "inside a list or quotation"),
        (":::{include} a.md\n:::\n", {"a.md": "---\ntitle: A\n---\n"}, "a.md:1: front matter"),
        (
            ":::{include} a.md\n:::\n",
            {"a.md": ":::{include} b.md\n:::\n", "b.md": "\n:::{include} a.md\n:::\n"},
            "b.md:2: {include} goes round in a circle: 00-first.md → a.md → b.md → a.md",
        ),
    ],
)
def test_an_include_that_cannot_be_is_refused(
    mistakes: Find, body: str, files: dict[str, str], report: str
) -> None:
    found = mistakes(body, files={f"content/{name}": text for name, text in files.items()})
    assert any(report in line for line in found), found


def test_alternatives_stand_one_below_the_other(make_book: MakeBook) -> None:
    body = ":::::{tabs}\n::::{tab} By *hand*\nOne.\n::::\n::::{tab} By code\nTwo.\n::::\n:::::\n"
    html = page(make_book(body))
    assert re.findall(r'class="tab" id="([\w-]+)"', html) == ["tab-by-hand", "tab-by-code"]
    assert html.index("By <em>hand</em>") < html.index("One.") < html.index("By code")
    assert "hidden" not in html


@pytest.mark.parametrize(
    ("body", "report"),
    [
        (":::{tab} Alone\nText.\n:::\n", "5: {tab} outside of {tabs}"),
        (":::{tabs}\n:::\n", "5: {tabs} with no tab"),
        (":::::{tabs}\n::::{tab} One\nText.\n::::\n:::::\n", "5: {tabs} with one tab"),
        (
            ":::::{tabs}\nWords.\n\n::::{tab} A\nText.\n::::\n::::{tab} B\nText.\n::::\n:::::\n",
            "6: text between the tabs",
        ),
        (
            ":::::{tabs}\n::::{tip}\nT.\n::::\n::::{tab} A\nT.\n::::\n:::::\n",
            "6: directive {tip} between the tabs",
        ),
        (":::::{tabs}\n::::{tab}\nText.\n::::\n::::{tab} B\nT.\n::::\n:::::\n", "has no title"),
    ],
)
def test_tabs_that_are_none_are_refused(mistakes: Find, body: str, report: str) -> None:
    found = mistakes(body)
    assert any(report in line for line in found), found


def test_a_download_is_published_as_it_is(make_book: MakeBook) -> None:
    options = make_book(":::{download} data/points.csv\nAll *points*.\n:::\n", FILES)
    site = render_site(options)
    (link,) = re.findall(
        r'href="../(assets/[^"]+points\.csv)" download="points\.csv"', page(options)
    )
    assert content_bytes(site[link]) == b"x,y\n1,2\n"
    assert "8 bytes" in page(options)


def test_what_nobody_hands_out_is_not_published(make_book: MakeBook) -> None:
    assert not any(name.endswith(".csv") for name in render_site(make_book("Text.\n", FILES)))


def test_a_download_that_is_not_there_is_refused(mistakes: Find) -> None:
    (found,) = mistakes(":::{download} data/point.csv\n:::\n", FILES)
    assert "unknown file 'data/point.csv'; did you mean 'data/points.csv'?" in found


@pytest.mark.parametrize(
    ("size", "words"),
    [(0, "0 bytes"), (999, "999 bytes"), (1000, "1.0 kB"), (9960, "10 kB"), (3.5e7, "35 MB")],
)
def test_sizes_are_told_in_two_digits(size: float, words: str) -> None:
    assert size_words(int(size)) == words


def test_a_film_has_controls_captions_and_a_still_and_waits(make_book: MakeBook) -> None:
    options = make_book(FILM, FILES)
    html = page(options)
    (film,) = re.findall(r"<video[^>]*>", html)
    assert "autoplay" not in film
    assert {'width="640"', 'height="400"', "controls"} <= set(film.strip("<>").split())
    assert re.search(r'<track kind="captions" src="[^"]+pan\.vtt" srclang="en-GB"', html)
    names = {name.partition("content/")[2] for name in render_site(options)}
    assert {"clips/pan.mp4", "clips/pan.vtt", "images/plan.svg"} <= names


def test_on_paper_a_film_is_its_still(make_book: MakeBook) -> None:
    article = compose(make_book(FILM, FILES)).sections[0].article
    (still,) = elements(article, "img")
    assert still.get("src", "").endswith("images/plan.svg")
    assert still.get("alt") == "A camera that pans over a checkerboard"
    assert not list(elements(article, "video"))


def test_a_film_is_found_by_what_it_shows(make_book: MakeBook) -> None:
    book, *_ = check_site(make_book(FILM, FILES))
    sections = chapter_sections(book.chapters[0], lambda _figure: "")
    assert sum("pans over a checkerboard" in section.figures for section in sections) == 1


@pytest.mark.parametrize(
    ("change", "report"),
    [
        (("pan.mp4", "pam.mp4"), "5: unknown film 'clips/pam.mp4'; did you mean 'clips/pan.mp4'?"),
        ((":poster: images/plan.svg\n", ""), "5: {video} has no ':poster:'"),
        (("pan.vtt", "tale.vtt"), "8: captions 'clips/tale.vtt'; legal: WebVTT"),
        ((":captions: clips/pan.vtt", ":captions: no"), "8: unknown captions 'no'"),
        (("clips/pan.mp4", "data/points.csv"), "5: film 'data/points.csv'; legal"),
    ],
)
def test_a_film_that_cannot_be_shown_is_refused(
    mistakes: Find, change: tuple[str, str], report: str
) -> None:
    found = mistakes(FILM.lstrip().replace(*change), FILES)
    assert any(report in line for line in found), found


def test_a_file_that_is_no_film_is_refused(mistakes: Find) -> None:
    (found,) = mistakes(FILM, {**FILES, "content/clips/pan.mp4": "not a film at all"})
    assert "film 'clips/pan.mp4' is none inside; legal: a whole .mp4 file" in found


def test_a_film_without_words_says_so(make_book: MakeBook) -> None:
    html = page(make_book(FILM.replace("clips/pan.vtt", "none"), FILES))
    assert "<track" not in html


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
def test_a_drawing_tells_its_size(tmp_path: Path, svg: str, size: tuple[int, int] | None) -> None:
    file = tmp_path / "a.svg"
    file.write_text(svg, encoding="utf-8")
    assert picture_size(file) == size


def test_a_photograph_tells_its_size(tmp_path: Path) -> None:
    file = tmp_path / "a.png"
    Image.new("L", (5, 3)).save(file)
    assert picture_size(file) == (5, 3)
    file.write_bytes(b"no picture")
    assert picture_size(file) is None


def test_a_picture_keeps_its_room_and_has_its_width(make_book: MakeBook) -> None:
    html = page(make_book(":::{figure} images/plan.svg\n:alt: A plan\n:width: 60%\n:::\n", FILES))
    (image,) = re.findall(r"<img[^>]*>", html)
    assert 'width="640" height="400" style="width: 60%"' in image


def test_on_paper_the_dark_variant_is_left_out(make_book: MakeBook) -> None:
    body = ":::{figure} images/plan.svg\n:alt: A plan\n:dark: images/night.svg\n:::\n"
    assert len(re.findall(r'<img class="on-(?:light|dark)"', page(make_book(body, FILES)))) == 2
    (shown,) = elements(compose(make_book(body, FILES)).sections[0].article, "img")
    assert shown.get("src", "").endswith("plan.svg")


@pytest.mark.parametrize(
    ("option", "report"),
    [
        (":width: wide", "7: width 'wide'; legal: '60%' of the text, or '320px'"),
        (":width: 0%", "7: width '0%'; legal"),
        (":width: 101%", "7: width '101%'; legal"),
        (":dark: images/nigth.svg", "7: unknown picture file 'images/nigth.svg'; did you mean"),
        (":dark: images/tall.svg", "7: dark variant of 10 × 20 for a picture of 640 × 400"),
    ],
)
def test_a_picture_s_options_are_checked(mistakes: Find, option: str, report: str) -> None:
    (found,) = mistakes(f":::{{figure}} images/plan.svg\n:alt: A plan\n{option}\n:::\n", FILES)
    assert report in found


@pytest.mark.parametrize("name", ["hint", "attention", "caution", "danger", "error", "seealso"])
def test_the_asides_of_myst_have_their_titles(make_book: MakeBook, name: str) -> None:
    title = {"seealso": "See also"}.get(name, name.capitalize())
    assert f'<p class="callout-title">{title}</p>' in page(
        make_book(f":::{{{name}}}\nText.\n:::\n")
    )


def test_an_aside_of_another_kind_looks_as_its_class_says(make_book: MakeBook) -> None:
    html = page(make_book(":::{admonition} On *lenses*\n:class: tip\nText.\n:::\n"))
    assert '<aside class="callout tip">' in html
    assert "On <em>lenses</em>" in html
