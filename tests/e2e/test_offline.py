"""The book without a network, and the turn from one release to the next."""

import os
import time
from collections.abc import Callable, Iterator
from contextlib import suppress
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser, Page
from playwright.sync_api import Error as PlaywrightError
from support.limits import limit_ms, limit_s
from support.page_scripts import FRUGAL
from support.reader import Reader, visit
from support.static_server import Fault, StaticServer, serving

from site_builder.files.folders import folder_files
from site_builder.output.writer import content_bytes
from site_builder.publishing.hosting import LIST, WORKER, no_release, release_files

pytestmark = pytest.mark.browser

PAGE, OTHER = "glossary/", "references/"
"""Without figures; in these the turn of releases is tried."""
FILM = "film.bin"
"""A film that a page could show."""
NEW = "A sentence of the next release."


@pytest.fixture
def host(release: Path) -> Iterator[StaticServer]:
    with serving(release) as server:
        yield server


@pytest.fixture
def keeper(brisk_chromium: Browser, host: StaticServer) -> Iterator[Reader]:
    """A reader whose browser may keep the book."""
    with visit(brisk_chromium, host, service_workers="allow") as someone:
        yield someone


@pytest.fixture(scope="module")
def release(built_site: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Some pages of the book, and all files that they may fetch."""
    site = folder_files(built_site)
    assets = next(name for name in site if name.startswith("assets/")).split("/")[1]
    files = {
        name: content_bytes(site[name])
        for name in site
        if name.split("/")[0] in ("assets", "search", PAGE[:-1], OTHER[:-1])
        and "/stills/" not in name
    }
    files[FILM] = b"0123456789"
    return publish(files, assets, tmp_path_factory.mktemp("release"))


@pytest.fixture(scope="module")
def next_release(release: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The same with one more sentence, and assets in a folder of another name."""
    old = next((release / "assets").iterdir()).name
    new = old[::-1]
    files = {
        name.replace(old, new): content_bytes(content)
        .replace(old.encode(), new.encode())
        .replace(b"</h1>", f"</h1><p>{NEW}</p>".encode())
        for name, content in folder_files(release).items()
    }
    root = publish(files, new, tmp_path_factory.mktemp("next"))
    for file in root.rglob("*"):  # a host tells releases apart by their times
        os.utime(file, (time.time() + 60, time.time() + 60))
    return root


def publish(files: dict[str, bytes], assets: str, root: Path) -> Path:
    files = {name: data for name, data in files.items() if name not in (LIST, WORKER)}
    for name, data in {**files, **release_files(files, f"assets/{assets}/")}.items():
        (root / name).parent.mkdir(parents=True, exist_ok=True)
        (root / name).write_bytes(data)
    return root


def test_after_one_visit_every_page_its_figures_and_the_search_work_without_a_network(
    brisk_chromium: Browser, built_site: Path, book: Any
) -> None:
    with (
        serving(built_site) as host,
        visit(brisk_chromium, host, service_workers="allow") as kept,
    ):
        keep(kept, "")
        host.gone = True
        with kept.page.context.new_page() as page:
            page.add_init_script("delete globalThis.WebAssembly")
            page.goto(kept.root + book["chapters"][-1]["url"])
            titles = page.evaluate(TITLES, [kept.root + each["url"] for each in book["chapters"]])
            for chapter, title in zip(book["chapters"], titles, strict=True):
                assert chapter["title"] in title
            page.goto(kept.root + "de/why-image-formation/")
            assert page.locator("html").get_attribute("lang") == "de"
            for end in ("glossary", "glossary/?figure-camera.k1=0", "glossary/#term-vignetting"):
                page.goto(kept.root + end)
                assert page.title().startswith("Glossary")
            assert search(page, "vignetting")
        figure = kept.open_figure(book, "perspective-projection")
        assert figure.get_attribute("data-state") == "live"


TITLES = """(urls) => Promise.all(urls.map(async (url) => {
  const page = new DOMParser().parseFromString(await (await fetch(url)).text(), 'text/html');
  return page.title;
}))"""


def test_a_new_release_is_there_whole_at_the_second_visit_and_the_old_one_gone(
    keeper: Reader, host: StaticServer, next_release: Path
) -> None:
    """A page that was left open over it still gets its own files. Where the site is no longer kept,
    the kept one is removed."""
    page = keeper.page
    old = keep(keeper)
    host.root = next_release
    page.goto(keeper.root + PAGE)
    assert not is_new(page)
    new = until(lambda: page.evaluate(TAKEN_UP, old))
    assert search(page, "vignetting")
    host.gone = True
    page.goto(keeper.root + OTHER)
    assert is_new(page)
    until(lambda: releases(page) == [new])
    host.gone = False
    assets = next((next_release / "assets").iterdir()).name
    host.damaged["/sw.js"] = no_release(f"assets/{assets}/")[WORKER]
    page.goto(keeper.root + OTHER)
    until(lambda: not releases(page))


def test_a_release_with_a_wrong_file_is_not_taken_up(
    keeper: Reader, host: StaticServer, next_release: Path
) -> None:
    page = keeper.page
    keep(keeper)
    host.root = next_release
    host.damaged[f"/{OTHER}"] = b"<!DOCTYPE html><title>Sign in</title>"
    assert page.evaluate(REFUSED) == "redundant"
    host.gone = True
    page.goto(keeper.root + OTHER)
    assert page.title().startswith("References")
    assert not is_new(page)


REFUSED = """async () => {
  const registration = await navigator.serviceWorker.ready;
  const found = new Promise((resolve) => registration.addEventListener('updatefound', resolve));
  registration.update().catch(() => {});
  await found;
  const worker = registration.installing;
  return new Promise((resolve) => {
    worker.addEventListener('statechange', () => resolve(worker.state));
  });
}"""
"""Look for a release; its first state."""
TAKEN_UP = """async (old) => {
  const registration = await navigator.serviceWorker.ready;
  const busy = registration.installing ?? registration.waiting;
  const name = (await caches.keys()).find((name) => name !== old);
  return !busy && registration.active.state === 'activated' && name;
}"""
"""The release after the old one, once it answers for the pages."""


@pytest.mark.parametrize("file", [WORKER, OTHER])
def test_why_the_book_is_not_stored_is_said_once_and_the_page_works_on(
    keeper: Reader, host: StaticServer, file: str
) -> None:
    host.faults[f"/{file}"] = Fault(status=404)
    keeper.open(PAGE, live=False)
    said = keeper.page.locator(".notice")
    said.wait_for()
    assert file in said.inner_text()
    assert "404" in said.inner_text()
    keeper.page.reload()
    assert search(keeper.page, "vignetting")
    assert not said.count()


def test_the_browser_s_own_copy_goes_first_a_film_is_wound_forward_and_broken_storage_left_alone(
    keeper: Reader, host: StaticServer
) -> None:
    """With its own copy of a script the browser keeps the compiled code."""
    page = keeper.page
    keep(keeper)
    script = page.evaluate("new URL(document.body.dataset.assets + 'js/main.js', location).href")
    for cache, is_kept in (("default", True), ("only-if-cached", False)):
        with page.expect_response(script) as reply:
            page.evaluate(ASK, [script, cache])
        assert reply.value.from_service_worker is is_kept
        assert reply.value.ok
    host.gone = True
    assert {part: page.evaluate(PART, {"Range": part}) for part in PARTS} == PARTS
    host.gone = False
    (worker,) = page.context.service_workers
    worker.evaluate("void (caches.open = () => Promise.reject(new Error('broken')))")
    keeper.open(OTHER, live=False)
    assert search(page, "vignetting")


ASK = """([url, cache]) => fetch(url, {cache, mode: "same-origin"}).then(() => 0)"""
PARTS = {
    "bytes=2-4": [206, "234", "bytes 2-4/10"],
    "bytes=0-": [206, "0123456789", "bytes 0-9/10"],
    "bytes=8-99": [206, "89", "bytes 8-9/10"],
    "lines=1-2": [200, "0123456789", None],
}
"""A host's answers to ranges by RFC 9110, section 14."""
PART = f"""async (headers) => {{
  const reply = await fetch(new URL('../{FILM}', location.href), {{headers}});
  const told = (name) => reply.headers.get(name);
  return [reply.status, await reply.text(), told('content-range')];
}}"""


def keep(reader: Reader, address: str = PAGE) -> str:
    """Visit a page until the book is kept; the name of its release."""
    reader.page.goto(reader.root + address)
    reader.page.wait_for_function("navigator.serviceWorker.controller", timeout=2 * limit_ms())
    (release,) = releases(reader.page)
    return release


def until(ask: Callable[[], Any]) -> Any:
    """Ask until the answer is yes. (Playwright's own waiting takes any promise for a yes.)"""
    deadline = time.monotonic() + 2 * limit_s()
    while time.monotonic() < deadline:
        with suppress(PlaywrightError):  # the page was turned while it was asked
            if answer := ask():
                return answer
        time.sleep(0.1)
    pytest.fail("the answer stays no")


def search(page: Page, words: str) -> str | None:
    """Address of the first hit."""
    page.keyboard.press("/")
    page.locator("dialog[open] input[type=search]").fill(words)
    return page.locator("a[data-result]").first.get_attribute("href")


def releases(page: Page) -> list[str]:
    names: list[str] = page.evaluate("caches.keys()")
    return names


def is_new(page: Page) -> bool:
    return page.get_by_text(NEW).count() > 0


def test_a_page_of_an_earlier_release_runs_on_says_so_and_leads_to_a_whole_page_of_the_next(
    brisk_chromium: Browser, built_site: Path, tmp_path: Path
) -> None:
    """The host has the book with its assets and its Python in folders of other names."""
    folders = [next((built_site / kind).iterdir()) for kind in ("assets", "runtime")]
    for file in built_site.rglob("*.html"):
        if any(file.is_relative_to(folder) for folder in folders):
            continue
        text = file.read_text(encoding="utf-8")
        for folder in folders:
            text = text.replace(folder.name, folder.name[::-1])
        new = tmp_path / file.relative_to(built_site)
        new.parent.mkdir(parents=True, exist_ok=True)
        new.write_text(text, encoding="utf-8")
    for folder in folders:
        (tmp_path / folder.parent.name).mkdir()
        (tmp_path / folder.parent.name / folder.name[::-1]).symlink_to(folder)
    with serving(built_site) as host, visit(brisk_chromium, host, FRUGAL) as reader:
        reader.open("why-image-formation/")
        page, notice = reader.page, reader.page.locator(".notice")
        own = page.evaluate("document.body.dataset.runtime")
        figure = reader.figure("formation-pipeline")
        reader.press(figure, "PageUp")
        host.root = tmp_path
        page.locator("[data-reveal]:visible").first.click()
        page.locator("a.set:visible").first.click()
        assert "has been updated" in notice.inner_text(), "the script that moves figures is gone"
        notice.get_by_role("button", name="Close").click()
        lost = "ladder-shading.zip could not be loaded: the server answered 404"
        assert lost in page.evaluate(MEASURE)
        reader.press(figure, "PageUp")
        page.locator("a[href='../connections/']").last.click()
        page.wait_for_url("**/connections/")
        reader.wait_live()
        assert page.evaluate("document.body.dataset.runtime") != own
        loaded = page.evaluate(LOADED)
        assert any("/runtime/" in address for address in loaded)
        old = own.strip("./").split("/")[-1]
        assert not [address for address in loaded if old in address], "nothing of both"


MEASURE = """async () => {
  const {inside} = await customElements.whenDefined('simulation-figure');
  const asked = {ladder: 'shading', tier: 'any', budget: 0.001};
  return inside.sharedRuntime().call('measure', asked).then(() => '', (error) => error.message);
}"""
"""The message where a part is asked for late."""
LOADED = "performance.getEntriesByType('resource').map(({name}) => name)"
