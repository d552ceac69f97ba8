"""The whole book without a network, after one visit."""

from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser, Page
from support.limits import limit_ms
from support.reader import visit
from support.static_server import ODD_PATH, Fault, serving

from site_builder.publishing.hosting import WORKER

pytestmark = pytest.mark.browser


def test_every_page_figure_and_the_search_work_offline_after_one_visit(
    baseline_chromium: Browser, built_site: Path, book: Any
) -> None:
    with (
        serving(built_site, path=ODD_PATH) as host,
        visit(baseline_chromium, host, service_workers="allow") as reader,
    ):
        reader.page.goto(reader.root)
        reader.page.wait_for_function("navigator.serviceWorker.controller", timeout=2 * limit_ms())
        host.offline = True
        with reader.page.context.new_page() as page:
            page.add_init_script("delete globalThis.WebAssembly")
            page.goto(reader.root + book["chapters"][-1]["url"])
            titles = page.evaluate(TITLES, [reader.root + each["url"] for each in book["chapters"]])
            for chapter, title in zip(book["chapters"], titles, strict=True):
                assert chapter["title"] in title
            for end in ("glossary", "glossary/?figure-camera.k1=0", "glossary/#term-vignetting"):
                page.goto(reader.root + end)
                assert page.title().startswith("Glossary")
            assert search(page, "vignetting")
        figure = reader.open_figure(book, "perspective-projection")
        assert figure.get_attribute("data-state") == "live"


TITLES = """(urls) => Promise.all(urls.map(async (url) => {
  const page = new DOMParser().parseFromString(await (await fetch(url)).text(), 'text/html');
  return page.title;
}))"""


@pytest.mark.parametrize("file", [WORKER, "references/"])
def test_failure_to_store_the_book_is_reported_once_and_pages_work(
    baseline_chromium: Browser, built_site: Path, file: str
) -> None:
    with (
        serving(built_site) as host,
        visit(baseline_chromium, host, service_workers="allow") as reader,
    ):
        host.faults[f"/{file}"] = Fault(lambda _: b"", status=404)
        reader.open("glossary/", live=False)
        notice = reader.page.locator(".notice")
        notice.wait_for()
        assert file in notice.inner_text()
        assert "404" in notice.inner_text()
        reader.page.reload()
        assert search(reader.page, "vignetting")
        assert not notice.count()


def search(page: Page, words: str) -> str | None:
    """Address of the first hit."""
    page.keyboard.press("/")
    page.locator("dialog[open] input[type=search]").fill(words)
    return page.locator("a[data-result]").first.get_attribute("href")
