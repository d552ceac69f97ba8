"""Configuration of hosts: media types, caching and the content security policy."""

import re
from collections.abc import Iterable, Mapping
from urllib.parse import urlsplit

from site_builder.document.book import Book
from site_builder.output.assets import Content
from site_builder.pages.embeds import FOLDER as EMBED_FOLDER
from site_builder.pages.environment import render_template
from site_builder.pages.page import page_address

FILES: Mapping[str, str] = {"apache": ".htaccess", "netlify": "_headers", "nginx": "nginx.conf"}
"""What each of them reads; ``_headers`` is known to others too."""
POLICY = re.compile(rb'<meta http-equiv="Content-Security-Policy" content="([^"]*)">')


def host_files(files: Mapping[str, Content], book: Book) -> dict[str, bytes]:
    """The configuration of each host that the book names."""
    given = book.settings.publishing
    pages = [page for name, page in files.items() if name.endswith(".html")]
    policy = common_policy(page for page in pages if isinstance(page, bytes))
    place = urlsplit(book.address).path or "/"
    return {
        FILES[host]: render_template(
            f"publishing/{host}.txt",
            book,
            policy=f"{policy}; {frame_rule(given.frames)}",
            place=place,
            compressed=given.compressed,
        ).encode()
        for host in given.hosts
    }


def frame_rule(sites: Iterable[str]) -> str:
    """Sites that may frame pages: the book and these. Only a header can say so."""
    return " ".join(("frame-ancestors 'self'", *sites))


def common_policy(pages: Iterable[bytes]) -> str:
    """What the policies of all pages allow together: a header is one for all, and pages hold to
    their own besides. It holds workers too, which no page's policy reaches."""
    allowed: dict[str, dict[str, None]] = {}
    for policy in sorted({found[1].decode() for page in pages if (found := POLICY.search(page))}):
        for rule in policy.split("; "):
            name, *sources = rule.split()
            allowed.setdefault(name, {}).update(dict.fromkeys(sources))
    return "; ".join(f"{name} {' '.join(sources)}" for name, sources in allowed.items())


NOT_LISTED = ("404.html", EMBED_FOLDER)
"""Beginnings of the paths of pages that are not to be found by themselves."""


def make_listings(book: Book, pages: Iterable[str]) -> dict[str, bytes]:
    """Files by path; nothing where the book has no address. ``pages`` are paths of the site."""
    if not book.address:
        return {}
    listed = [page_address(path) for path in pages if not path.startswith(NOT_LISTED)]
    made = {"sitemap.xml": render_template("publishing/sitemap.xml", book, pages=listed)}
    if book.news:
        made["feed.xml"] = render_template("publishing/feed.xml", book)
    if urlsplit(book.address).path == "/":  # elsewhere on a host it is not looked for
        made["robots.txt"] = render_template("publishing/robots.txt", book)
    return {path: text.encode() for path, text in made.items()}
