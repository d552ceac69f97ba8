"""A site that knows where it will be: canonical links, sitemap, feed, cards, sources."""

import io
from collections.abc import Callable, Mapping
from dataclasses import replace
from xml.etree import ElementTree

import pytest
from PIL import Image
from support.html_outline import read_html
from support.little_book import rendered

from site_builder.build import Options

type MakeBook = Callable[..., Options]

ADDRESS = "https://host.example/books/small/"
SOURCE = "https://host.example/sources/{path}"
NEWS = """\
[[entry]]
date = 2026-11-22
title = "A <second> chapter"
says = "There is more & more."
chapter = "second"

[[entry]]
date = 2026-11-20
title = "The book"
says = "It begins."
"""
ATOM = "{http://www.w3.org/2005/Atom}"
PAGES = {"sitemap": "{http://www.sitemaps.org/schemas/sitemap/0.9}"}


@pytest.fixture
def addressed(make_book: MakeBook) -> Mapping[str, bytes]:
    body = ":::{simulation} demo\n:::\n\n:::{source} simulations.models.thing:double\n:::\n"
    options = make_book(body, {"content/news.toml": NEWS})
    return rendered(replace(options, address=ADDRESS, source=SOURCE))


def links(page: bytes, rel: str) -> list[str | None]:
    heads = read_html(page).all("link")
    return [link.attributes["href"] for link in heads if link.attributes["rel"] == rel]


def test_every_page_names_its_own_address(addressed: Mapping[str, bytes]) -> None:
    pages = [path for path in addressed if path.endswith("/index.html")]
    for path in pages:
        assert links(addressed[path], "canonical") == [ADDRESS + path.removesuffix("index.html")]
    assert links(addressed["index.html"], "canonical") == [ADDRESS]
    assert links(addressed["404.html"], "canonical") == []


def test_the_sitemap_lists_every_page_once_but_those_for_frames(
    addressed: Mapping[str, bytes],
) -> None:
    tree = ElementTree.fromstring(addressed["sitemap.xml"])
    listed = [entry.text or "" for entry in tree.iter(f"{PAGES['sitemap']}loc")]
    made = [path for path in addressed if path.endswith("index.html")]
    pages = [path for path in made if not path.startswith("embed/")]
    assert len(pages) < len(made)
    assert sorted(listed) == sorted(ADDRESS + path.removesuffix("index.html") for path in pages)


def test_the_feed_tells_the_news_newest_first(addressed: Mapping[str, bytes]) -> None:
    feed = ElementTree.fromstring(addressed["feed.xml"])
    entries = feed.findall(f"{ATOM}entry")
    assert [entry.findtext(f"{ATOM}title") for entry in entries] == [
        "A <second> chapter",
        "The book",
    ]
    assert feed.findtext(f"{ATOM}updated") == "2026-11-22T00:00:00Z"
    alternates = [entry.find(f"{ATOM}link") for entry in entries]
    assert [link.get("href") for link in alternates if link is not None] == [
        f"{ADDRESS}second/",
        ADDRESS,
    ]
    assert links(addressed["first/index.html"], "alternate") == ["../feed.xml"]


def test_every_card_that_a_page_names_is_there_in_the_size_it_says(
    addressed: Mapping[str, bytes],
) -> None:
    for path, page in addressed.items():
        if not path.endswith("index.html"):
            continue
        tags = read_html(page).all("meta")
        told = {tag.attributes.get("property"): tag.attributes.get("content") for tag in tags}
        card = addressed[str(told["og:image"]).removeprefix(ADDRESS)]
        size = Image.open(io.BytesIO(card)).size
        assert (told["og:image:width"], told["og:image:height"]) == tuple(map(str, size))


def test_a_chapter_s_card_shows_its_figure(addressed: Mapping[str, bytes]) -> None:
    card = Image.open(io.BytesIO(addressed["cards/first.png"])).convert("RGB")
    assert card.getpixel((850, 315)) == (255, 255, 255)  # as the scene's picture is


def test_every_page_leads_to_the_file_it_is_made_from(addressed: Mapping[str, bytes]) -> None:
    expected = {
        "index.html": "content/book.toml",
        "first/index.html": "content/00-first.md",
        "source/simulations/models/thing/index.html": "simulations/models/thing.py",
        "licences/index.html": "LICENSE",
    }
    for path, file in expected.items():
        anchors = read_html(addressed[path]).all("a")
        assert SOURCE.replace("{path}", file) in [link.attributes.get("href") for link in anchors]


def test_robots_are_told_only_at_the_root_of_a_host(make_book: MakeBook) -> None:
    at_root = rendered(replace(make_book(), address="https://host.example/"))
    told = at_root["robots.txt"].decode().splitlines()
    assert told[-1] == "Sitemap: https://host.example/sitemap.xml"
    assert "robots.txt" not in rendered(replace(make_book(), address=ADDRESS))


def test_without_an_address_nothing_is_told_outside(make_book: MakeBook) -> None:
    site = rendered(make_book("Text.\n", {"content/news.toml": NEWS}))
    outside = {"sitemap.xml", "feed.xml", "robots.txt", "card.png", "cards/first.png"}
    assert not outside & set(site)
    for path in (path for path in site if path.endswith(".html")):
        assert b"canonical" not in site[path]
        assert b"og:" not in site[path]
    assert b"://" not in site["first/index.html"]


def test_pages_and_the_feed_say_by_what_and_whom_they_are_cited(make_book: MakeBook) -> None:
    outline = (
        'title = "T"\nsubtitle = "S"\nprerequisites = "P"\nchapters = ["00-first", "01-second"]\n'
        f'address = "{ADDRESS}"\n[imprint]\nauthors = ["Ada", "B 0000-0002-1825-0097"]\n'
        "date = 2026-11-26\n"
    )
    site = rendered(make_book(files={"content/book.toml": outline, "content/news.toml": NEWS}))
    found = [item.attributes for item in read_html(site["second/index.html"]).all("meta")]
    cited = [
        (str(item["name"]).removeprefix("citation_"), item["content"])
        for item in found
        if str(item.get("name")).startswith("citation_")
    ]
    assert cited == [
        ("title", "Second"),
        ("inbook_title", "T"),
        ("author", "Ada"),
        ("author", "B"),
        ("author_orcid", "https://orcid.org/0000-0002-1825-0097"),
        ("publication_date", "2026/11/26"),
    ]
    authors = ElementTree.fromstring(site["feed.xml"]).findall(f"{ATOM}author")
    assert [[part.text for part in author] for author in authors] == [
        ["Ada"],
        ["B", "https://orcid.org/0000-0002-1825-0097"],
    ]
