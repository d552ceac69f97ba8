"""A site with a declared address, and the files for its host and for offline use."""

import gzip
import io
import json
import re
import subprocess
from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree

import brotli
import pytest
from fontTools.ttLib import TTFont
from PIL import Image
from support.html_outline import Page, read_html
from support.little_book import OUTLINE, MakeBook, plain_scripts, rendered, write_book
from support.places import ROOT

from site_builder.diagnostics.diagnostic import BuildError
from site_builder.publishing.hosting import LIST, WORKER, no_release, release_files
from site_builder.publishing.vector import (
    ICON,
    ICONS,
    MOST_LINES,
    fit_title,
    make_icons,
    uncut_fonts,
)
from site_builder.settings.declared import site_address, source_address

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
HOSTED = f"""\
{OUTLINE}address = "{ADDRESS}"
[publishing]
hosts = ["apache", "netlify", "nginx"]
compressed = true
[imprint]
authors = ["Ada", "B 0000-0002-1825-0097"]
date = 2026-11-26
"""
BODY = ":::{simulation} demo\n:::\n\n:::{source} simulations.models.thing:double\n:::\n"
ATOM = "{http://www.w3.org/2005/Atom}"
LOCATION = "{http://www.sitemaps.org/schemas/sitemap/0.9}loc"
HASH = re.compile(r"'sha256-[^']+'")


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Mapping[str, bytes]:
    body = BODY + "Words. " * 200 + "\n"
    files = {"content/news.toml": NEWS, "content/book.toml": HOSTED}
    with plain_scripts():
        options = write_book(tmp_path_factory.mktemp("site"), body, files)
        return rendered(replace(options, source=SOURCE))


@pytest.fixture(scope="module")
def pages(site: Mapping[str, bytes]) -> Mapping[str, Page]:
    return {path: read_html(site[path]) for path in site if path.endswith(".html")}


def links(page: Page, rel: str) -> list[str]:
    return [link["href"] for link in page.all("link") if link["rel"] == rel]


def test_every_page_names_its_address_and_the_sitemap_lists_all_pages(
    site: Mapping[str, bytes], pages: Mapping[str, Page]
) -> None:
    addresses = {path: ADDRESS + path.removesuffix("index.html") for path in pages}
    for path in pages.keys() - {"404.html"}:
        assert links(pages[path], "canonical") == [addresses[path]]
    assert links(pages["404.html"], "canonical") == []
    listed = [each.text for each in ElementTree.fromstring(site["sitemap.xml"]).iter(LOCATION)]
    shown = [path for path in pages if not path.startswith(("embed/", "404"))]
    assert sorted(map(str, listed)) == sorted(addresses[path] for path in shown)


def test_feed_has_the_newest_news_first_and_the_authors(
    site: Mapping[str, bytes], pages: Mapping[str, Page]
) -> None:
    feed = ElementTree.fromstring(site["feed.xml"])
    entries = feed.findall(f"{ATOM}entry")
    titles = [entry.findtext(f"{ATOM}title") for entry in entries]
    assert titles == ["A <second> chapter", "The book"]
    assert feed.findtext(f"{ATOM}updated") == "2026-11-22T00:00:00Z"
    alternates = [entry.find(f"{ATOM}link") for entry in entries]
    led_to = [link.get("href") for link in alternates if link is not None]
    assert led_to == [f"{ADDRESS}second/", ADDRESS]
    assert links(pages["first/index.html"], "alternate") == ["../feed.xml"]
    authors = [[part.text for part in author] for author in feed.findall(f"{ATOM}author")]
    assert authors == [["Ada"], ["B", "https://orcid.org/0000-0002-1825-0097"]]


def test_every_card_of_a_page_exists_in_its_stated_size(
    site: Mapping[str, bytes], pages: Mapping[str, Page]
) -> None:
    for page in (page for path, page in pages.items() if path.endswith("index.html")):
        meta = {tag["property"]: tag["content"] for tag in page.all("meta")}
        card = site[meta["og:image"].removeprefix(ADDRESS)]
        size = Image.open(io.BytesIO(card)).size
        assert (meta["og:image:width"], meta["og:image:height"]) == tuple(map(str, size))
    chapter = Image.open(io.BytesIO(site["cards/first.png"])).convert("RGB")
    assert chapter.getpixel((850, 315)) == (255, 255, 255), "the scene's picture"


def test_every_page_links_to_its_source_file(pages: Mapping[str, Page]) -> None:
    expected = {
        "index.html": "content/book.toml",
        "first/index.html": "content/00-first.md",
        "source/simulations/models/thing/index.html": "simulations/models/thing.py",
        "licences/index.html": "LICENSE",
    }
    for path, file in expected.items():
        assert SOURCE.replace("{path}", file) in pages[path].addresses()


def test_pages_have_citation_metadata(pages: Mapping[str, Page]) -> None:
    found = [(item["name"], item["content"]) for item in pages["second/index.html"].all("meta")]
    assert [(name, text) for name, text in found if name.startswith("citation_")] == [
        ("citation_title", "Second"),
        ("citation_inbook_title", "T"),
        ("citation_author", "Ada"),
        ("citation_author", "B"),
        ("citation_author_orcid", "https://orcid.org/0000-0002-1825-0097"),
        ("citation_publication_date", "2026/11/26"),
    ]


@pytest.mark.parametrize("address", ["", "https://host.example/"])
def test_site_without_an_address_has_no_files_for_other_sites(
    make_book: MakeBook, address: str
) -> None:
    options = make_book("Text.\n", {"content/news.toml": NEWS})
    site = rendered(replace(options, address=address))
    outside = {"sitemap.xml", "feed.xml", "robots.txt", "card.png", "cards/first.png"}
    assert outside & set(site) == (outside if address else set())
    pages = [page for path, page in site.items() if path.endswith(".html") and path != "404.html"]
    assert all((b"canonical" in page) is (b"og:" in page) is bool(address) for page in pages)


def test_compressed_copies_are_equal_and_not_part_of_the_release(site: Mapping[str, bytes]) -> None:
    assert "robots.txt" not in site, "which belongs to the root of a host"
    for ending, unpacked in ((".br", brotli.decompress), (".gz", gzip.decompress)):
        copies = {name for name in site if name.endswith(ending)}
        assert {"first/index.html" + ending, "offline.json" + ending} <= copies
        for name in copies:
            assert unpacked(site[name]) == site[name.removesuffix(ending)]
            assert len(site[name]) < len(site[name.removesuffix(ending)])
        assert not copies & json.loads(site["offline.json"]).keys()


@pytest.mark.parametrize("name", [".htaccess", "_headers", "nginx.conf"])
def test_hosts_policy_allows_the_scripts_of_each_page(site: Mapping[str, bytes], name: str) -> None:
    text = site[name].decode()
    heads = [site[path].decode().partition("<script")[0] for path in site if path.endswith(".html")]
    wanted = {found for head in heads for found in HASH.findall(head)}
    assert len(wanted) > 3  # those of `404.html`, and of styles at each depth
    assert wanted <= set(HASH.findall(text))
    assert "/books/small/" in text


@pytest.mark.parametrize(
    ("frames", "rule"),
    [
        ("", "frame-ancestors 'self' *"),
        ("frames = []", "frame-ancestors 'self'"),
        ('frames = ["https://c.example:80"]', "frame-ancestors 'self' https://c.example:80"),
    ],
)
def test_any_site_may_frame_the_book_unless_it_lists_sites(
    make_book: MakeBook, frames: str, rule: str
) -> None:
    outline = f'{OUTLINE}address = "{ADDRESS}"\n[publishing]\nhosts = ["netlify"]\n{frames}\n'
    text = rendered(make_book("Words.", {"content/book.toml": outline}))["_headers"].decode()
    assert f"; {rule}\n" in text


def test_only_files_named_by_their_hash_are_cached_for_ever(site: Mapping[str, bytes]) -> None:
    rules = re.findall(r"^(/\S+)\n((?: .+\n)+)", site["_headers"].decode(), re.MULTILINE)
    kept = {pattern for pattern, text in rules if "Cache-Control" in text}
    assert kept == {"/books/small/assets/*", "/books/small/runtime/*"}


def test_address_ends_with_a_slash_and_may_be_empty() -> None:
    for given in ("https://host.example/book", "https://host.example/book/"):
        assert site_address(given) == "https://host.example/book/"
    assert (site_address(""), source_address("")) == ("", "")


@pytest.mark.parametrize(
    ("read", "given"),
    [
        *((site_address, f"https://host/{end}") for end in ("?a=1", '"><script>', "a b", "\n")),
        *((site_address, given) for given in ("host.example", "ftp://host.example/", 3, None)),
        *((site_address, given) for given in ("https:///book", "javascript://host/%0aalert(1)")),
        *((source_address, given) for given in ("https://host/", "{path}", "javascript:{path}", 1)),
        (source_address, "https://host/{path}/{path}"),
    ],
)
def test_invalid_address_is_refused(read: Callable[[object], str], given: object) -> None:
    with pytest.raises(
        ValueError, match="legal: 'https://host/'" if read == site_address else "once"
    ):
        read(given)


def test_each_icon_has_its_size_and_an_invalid_drawing_is_reported(tmp_path: Path) -> None:
    for name, data in make_icons(ROOT).items():
        assert Image.open(io.BytesIO(data)).size == (ICONS[name], ICONS[name])
    file = tmp_path / ICON
    file.parent.mkdir(parents=True)
    file.write_text("<p>", encoding="utf-8")
    with pytest.raises(BuildError, match=f"{ICON}:1: "):
        make_icons(tmp_path)


@pytest.mark.parametrize(
    "title", ["Connections", "2D Transformations", "Why Study Image Formation?", "Öl & <Licht>"]
)
def test_title_on_a_card_is_complete_and_fits_its_box(title: str) -> None:
    face = uncut_fonts().title
    size, lines = fit_title(title, 440, face)
    assert " ".join(lines) == title
    font = TTFont(face)
    names, widths = font.getBestCmap(), font["hmtx"]
    for line in lines:
        units = sum(widths[names[ord(letter)]][0] for letter in line)
        assert units * size / font["head"].unitsPerEm <= 1.05 * 440, "without kerning"


def test_very_long_title_is_cut() -> None:
    lines = fit_title("words " * 200, 440, uncut_fonts().title)[1]
    assert len(lines) == MOST_LINES
    assert lines[-1].endswith("…")


RELEASED = {"index.html": b"cover", "lens/index.html": b"lens", "assets/1/js/main.js": b"1"}


def test_release_lists_pages_by_address_with_openssls_hash() -> None:
    rarely_needed = {
        "assets/1/raw/libraw.wasm": b"decoder",
        "embed/lens/f/index.html": b"for a frame",
    }
    listed = json.loads(release_files(RELEASED | rarely_needed, "assets/1/")[LIST])
    assert set(listed) == {"", "lens/", "assets/1/js/main.js"}
    command = "openssl dgst -sha256 -binary | openssl base64"
    digest = subprocess.run(command, shell=True, input=b"lens", capture_output=True, check=True)
    assert listed["lens/"] == f"sha256-{digest.stdout.decode().strip()}"


def test_every_change_makes_a_new_release_and_offline_use_can_be_off() -> None:
    changed = [RELEASED | {name: b"other"} for name in [*RELEASED, "new"]]
    workers = {release_files(files, "assets/1/")[WORKER] for files in [RELEASED, *changed]}
    assert len(workers) == len(changed) + 1
    assert b'RELEASE = "";' in no_release("assets/1/")[WORKER]
