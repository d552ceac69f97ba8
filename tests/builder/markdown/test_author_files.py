"""What an author brings from other files: pictures, films, recordings, downloads."""

import re
from collections.abc import Callable
from pathlib import Path

import pytest
from PIL import Image
from support.little_book import rendered

from site_builder.build import Options, check_site
from site_builder.editions.compose import compose
from site_builder.editions.tree import elements
from site_builder.markdown.directives.download import size_words
from site_builder.markdown.files.content_files import picture_size
from site_builder.render.sections import chapter_sections

type MakeBook = Callable[..., Options]

FILM = """
:::{video} clips/pan.mp4
:alt: A camera that pans over a checkerboard
:poster: images/plan.svg
:captions: clips/pan.vtt
:language: en-GB
The board slides by.
:::
"""
RECORDING = """
:::{audio} clips/string.mp3
:title: The open string.
:licence: Ada Lovelace, CC BY 4.0
A *low* note that dies away.
:::
"""
FILES: dict[str, str | None] = {
    "content/clips/pan.mp4": "0000ftyp",
    "content/clips/string.mp3": "ID3",
    "content/clips/pan.vtt": "WEBVTT\n\n00:00.000 --> 00:01.000\nHello.\n",
    "content/images/plan.svg": '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 640 400"/>',
    "content/images/night.svg": '<svg xmlns="http://www.w3.org/2000/svg" width="32" height="20"/>',
    "content/data/points.csv": "x,y\n1,2\n",
}


def page(options: Options) -> str:
    html = rendered(options)["first/index.html"].decode()
    return html.partition("<article")[2].partition("</article>")[0]


def test_a_download_is_published_as_it_is(make_book: MakeBook) -> None:
    options = make_book(":::{download} data/points.csv\nAll *points*.\n:::\n", FILES)
    html = page(options)
    (link,) = re.findall(r'href="../(assets/[^"]+points\.csv)" download="points\.csv"', html)
    assert rendered(options)[link] == b"x,y\n1,2\n"
    assert "8 bytes" in html


def test_what_nobody_hands_out_is_not_published(make_book: MakeBook) -> None:
    assert not any(name.endswith(".csv") for name in rendered(make_book("Text.\n", FILES)))


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
    names = {name.partition("content/")[2] for name in rendered(options)}
    assert {"clips/pan.mp4", "clips/pan.vtt", "images/plan.svg"} <= names


def test_on_paper_a_film_is_its_still(make_book: MakeBook) -> None:
    article = compose(make_book(FILM, FILES)).sections[0].article
    (still,) = elements(article, "img")
    assert still.get("src", "").endswith("images/plan.svg")
    assert still.get("alt") == "A camera that pans over a checkerboard"
    assert not list(elements(article, "video"))


def test_a_recording_waits_and_has_its_words_below_it(make_book: MakeBook) -> None:
    options = make_book(RECORDING, FILES)
    html = page(options)
    (player,) = re.findall(r"<audio[^>]*>", html)
    assert "autoplay" not in player
    assert re.search(r'<source src="[^"]+string\.mp3" type="audio/mpeg">', html)
    assert "Ada Lovelace, CC BY 4.0" in html
    assert re.search(r"<details class=.transcript.>.*A <em>low</em> note", html, re.DOTALL)
    assert any(name.endswith("clips/string.mp3") for name in rendered(options))


def test_on_paper_a_recording_is_its_words(make_book: MakeBook) -> None:
    article = compose(make_book(RECORDING, FILES)).sections[0].article
    assert not list(elements(article, "audio"))
    (transcript,) = elements(article, kind="transcript")
    assert "A low note that dies away." in "".join(transcript.itertext())


def test_a_film_is_found_by_what_it_shows(make_book: MakeBook) -> None:
    book, *_ = check_site(make_book(FILM, FILES))
    sections = chapter_sections(book.chapters[0], lambda _figure: "")
    assert sum("pans over a checkerboard" in section.figures for section in sections) == 1


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
