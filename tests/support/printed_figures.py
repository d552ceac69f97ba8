"""On which pages of a tagged PDF each figure stands."""

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any, cast

from pypdf import PdfReader
from pypdf.generic import DictionaryObject

LONG = {"/Table", "/Code"}
"""What ladders, tables and listings hold, which run on."""


def pages_of_figures(pdf: Path) -> list[set[int]]:
    """For each figure that does not run on: the pages of its picture, its numbers and its caption,
    as numbers of objects."""
    found, root = [], cast(Any, PdfReader(pdf).trailer["/Root"])
    for element, _ in _walk(root["/StructTreeRoot"]):
        if _kind(element) != "/Figure":
            continue
        parts = _parts(element)
        kinds = [{_kind(each) for each, _ in _walk(part)} for part in parts]
        captions = [place for place, each in enumerate(kinds) if "/Caption" in each]
        if captions and LONG.isdisjoint(set().union(*kinds[: captions[0]])):
            found.append(_pages(parts[: captions[0] + 1]))
    return found


def _kind(element: Any) -> str:
    return str(element.get("/S", "")) if isinstance(element, dict) else ""


def _parts(element: Any) -> list[Any]:
    held = element.get("/K", []) if isinstance(element, dict) else []
    held = held.get_object() if hasattr(held, "get_object") else held
    each = held if isinstance(held, list) else [held]
    return [part.get_object() if hasattr(part, "get_object") else part for part in each]


def _walk(element: Any, page: int = 0) -> Iterator[tuple[Any, int]]:
    """The element and all that it holds, each with its page."""
    if isinstance(element, DictionaryObject) and "/Pg" in element:
        page = element.raw_get("/Pg").idnum
    yield element, page
    for part in _parts(element):
        yield from _walk(part, page)


def _pages(elements: Sequence[Any]) -> set[int]:
    """Content is a number, or an object that has one."""
    return {
        page
        for element in elements
        for part, page in _walk(element)
        if isinstance(part, int) or (isinstance(part, dict) and "/MCID" in part)
    }
