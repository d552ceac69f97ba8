"""What a site's host is given: packed copies, and a configuration."""

import gzip
import json
import re
from collections.abc import Callable, Mapping
from pathlib import Path

import brotli
import pytest
from support.host import read_rules

from site_builder.build import Options, render_site
from site_builder.output.assets import content_bytes

type MakeBook = Callable[..., Options]

OUTLINE = """\
title = "Small"
subtitle = "A book"
prerequisites = "None."
address = "https://host.example/books/small/"
chapters = ["00-first", "01-second"]
[publishing]
"""
ALL = 'hosts = ["apache", "netlify", "nginx"]\ncompressed = true\n'
HASH = re.compile(r"'sha256-[^']+'")


@pytest.fixture
def site(make_book: MakeBook) -> Mapping[str, bytes]:
    files = render_site(make_book("Words. " * 200, {"content/book.toml": OUTLINE + ALL}))
    return {name: content_bytes(content) for name, content in files.items()}


def test_packed_copies_hold_the_same_and_are_no_part_of_the_release(
    site: Mapping[str, bytes],
) -> None:
    for ending, unpacked in ((".br", brotli.decompress), (".gz", gzip.decompress)):
        copies = {name for name in site if name.endswith(ending)}
        assert {"first/index.html" + ending, "offline.json" + ending} <= copies
        for name in copies:
            assert unpacked(site[name]) == site[name.removesuffix(ending)]
            assert len(site[name]) < len(site[name.removesuffix(ending)])
        assert not copies & json.loads(site["offline.json"]).keys()


@pytest.mark.parametrize("name", [".htaccess", "_headers", "nginx.conf"])
def test_the_policy_that_a_host_sends_allows_what_each_page_does(
    site: Mapping[str, bytes], name: str
) -> None:
    told = site[name].decode()
    pages = [page.decode() for path, page in site.items() if path.endswith(".html")]
    wanted = {found for page in pages for found in HASH.findall(page.partition("<script")[0])}
    assert len(wanted) > 3  # those of `404.html`, and of styles at each depth
    assert wanted <= set(HASH.findall(told))
    assert "/books/small/" in told


@pytest.mark.parametrize(
    ("frames", "rule"),
    [
        ("", "frame-ancestors 'self' *"),
        ("frames = []", "frame-ancestors 'self'"),
        (
            'frames = ["https://course.example:8080"]',
            "frame-ancestors 'self' https://course.example:8080",
        ),
    ],
)
def test_all_sites_may_frame_the_book_unless_it_says_which(
    make_book: MakeBook, frames: str, rule: str
) -> None:
    outline = f'{OUTLINE}hosts = ["netlify"]\n{frames}\n'
    told = content_bytes(
        render_site(make_book("Words.", {"content/book.toml": outline}))["_headers"]
    ).decode()
    assert f"; {rule}\n" in told


def test_only_what_is_named_by_what_is_in_it_is_kept_for_ever(
    site: Mapping[str, bytes], tmp_path: Path
) -> None:
    file = tmp_path / "_headers"
    file.write_bytes(site["_headers"])
    kept = {pattern for pattern, told in read_rules(file).items() if "Cache-Control" in told}
    assert kept == {"/books/small/assets/*", "/books/small/runtime/*"}
