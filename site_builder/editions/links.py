"""The targets of a page's links: in the book, out of it, or missing on paper."""

import re
from collections.abc import Collection
from dataclasses import dataclass
from urllib.parse import unquote, urljoin

ABSOLUTE = re.compile(r"[a-z][a-z0-9+.-]*:", re.IGNORECASE)


@dataclass(frozen=True, slots=True)
class Place:
    """A page of the book, or an element in it."""

    page: str
    """Its id: a chapter's, or ``references``."""
    id: str
    """Element id; nothing for the page as a whole."""


def is_external(address: str) -> bool:
    return ABSOLUTE.match(address) is not None


def place_of(address: str, page: str, pages: Collection[str]) -> Place | None:
    """The target of ``address`` on ``page``; None where that is none of ``pages``.

    The settings in a link to a figure are left out.
    """
    path, _, fragment = address.partition("#")
    target = urljoin(f"{page}/", path.partition("?")[0]).strip("/")
    return Place(target, unquote(fragment)) if target in pages else None
