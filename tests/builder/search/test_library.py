"""What searches: pinned, fetched once, and done without where it cannot be had."""

from collections.abc import Callable
from dataclasses import replace

import pytest

from site_builder import build
from site_builder.assets import browser_parts
from site_builder.build import render_site
from site_builder.diagnostics.diagnostic import Diagnostic
from site_builder.languages.words import languages
from site_builder.output.assets import content_bytes
from site_builder.programs.node import NodeError
from site_builder.search import library
from site_builder.search.library import SearchLibrary


def test_without_the_library_the_book_is_built_without_search_and_says_so(
    make_book: Callable[..., build.Options], monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuse(_language: str) -> SearchLibrary:
        raise NodeError("no network")

    monkeypatch.setattr(browser_parts, "fetch_library", refuse)
    warnings: list[Diagnostic] = []
    files = render_site(replace(make_book(), search=True, warn=warnings.append))
    assert b"search-button" not in content_bytes(files["first/index.html"])
    assert not any(name.startswith("search/") for name in files)
    assert ["no network" in str(warning) for warning in warnings] == [True]


def test_there_is_a_stemmer_for_every_language_of_the_interface() -> None:
    assert set(library.STEMMERS) == set(languages())
