"""What machines read of a site that has an address: its pages, its changes, what to index."""

from collections.abc import Iterable
from urllib.parse import urlsplit

from site_builder.document.book import Book
from site_builder.pages.embeds import FOLDER as EMBED_FOLDER
from site_builder.pages.environment import render_template
from site_builder.pages.outside import page_address

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
