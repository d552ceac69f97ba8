"""The policy of pages allows what their templates hold, by hash, and nothing else inline."""

import base64
import hashlib
import re
from collections.abc import Callable, Mapping
from dataclasses import replace

import pytest
from support.little_book import rendered

from site_builder.build import Options, render_site
from site_builder.output.assets import Content, content_bytes

type MakeBook = Callable[..., Options]

ADDRESS = "https://host.example/"
POLICY = re.compile(r'<meta http-equiv="Content-Security-Policy" content="([^"]*)">')
SCRIPT = re.compile(r"<script>(.*?)</script>", re.DOTALL)
STYLE = re.compile(r"<style>(.*?)</style>", re.DOTALL)
TRUSTING = (
    'title = "Small"\nsubtitle = "A book"\nprerequisites = "None."\n'
    'chapters = ["00-first", "01-second"]\n'
    f'address = "{ADDRESS}"\n[trust]\nraw_html = true\n'
)


def rules(site: Mapping[str, Content], path: str) -> dict[str, list[str]]:
    """The sources of each directive."""
    found = POLICY.search(content_bytes(site[path]).decode())
    assert found, path
    return {name: sources for name, *sources in map(str.split, found[1].split("; "))}


def hashed(text: str) -> str:
    return f"'sha256-{base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()}'"


@pytest.mark.parametrize("path", ["index.html", "first/index.html", "404.html"])
def test_inline_scripts_and_styles_are_allowed_by_their_hash_alone(
    make_book: MakeBook, path: str
) -> None:
    site = render_site(replace(make_book(), address=ADDRESS))
    page, allowed = content_bytes(site[path]).decode(), rules(site, path)
    scripts, styles = SCRIPT.findall(page), STYLE.findall(page)
    assert scripts
    assert styles
    assert allowed["script-src"] == ["'self'", "'wasm-unsafe-eval'", *map(hashed, scripts)]
    assert allowed["style-src"] == ["'self'", *map(hashed, styles)]
    assert allowed["default-src"] == ["'self'"]
    assert allowed["object-src"] == allowed["frame-src"] == ["'none'"]


def test_html_that_the_author_is_trusted_with_runs(make_book: MakeBook) -> None:
    site = render_site(make_book("<b>Text</b>\n", {"content/book.toml": TRUSTING}))
    allowed = rules(site, "first/index.html")
    assert allowed["script-src"] == ["'self'", "'wasm-unsafe-eval'", "'unsafe-inline'"]
    assert allowed["style-src"] == ["'self'", "'unsafe-inline'"]


def test_while_the_book_is_written_pages_link_to_their_styles(make_book: MakeBook) -> None:
    page = rendered(replace(make_book(), reload=True))["first/index.html"]
    assert b"<style>" not in page
    assert b'<link rel="stylesheet"' in page
    assert b" integrity=" not in page


def test_tools_may_evaluate_text_only_where_the_book_is_not_published(make_book: MakeBook) -> None:
    for address, may in (("", True), (ADDRESS, False)):
        site = render_site(replace(make_book(), address=address))
        assert ("'unsafe-eval'" in rules(site, "first/index.html")["script-src"]) is may
