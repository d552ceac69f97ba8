"""The book without a network, and the turn from one release to the next."""

import threading
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser, Page
from playwright.sync_api import Error as PlaywrightError
from support.engines import ENGINES, HOW_TO
from support.engines.engine import Engine
from support.limits import limit_ms, limit_s
from support.page_scripts import FRUGAL
from support.places import ROOT
from support.reader import visit
from support.static_server import Fault, StaticServer, serving

from site_builder.assets.pages import write_scripts
from site_builder.files.folders import folder_files, integrity
from site_builder.output.writer import content_bytes
from site_builder.publishing.hosting import WORKER, address, no_release, release_files

pytestmark = pytest.mark.browser

FILM, ODD = "film.bin", "Fig #3 50%.bin"
"""Files of the small site: a film for a page, and one whose name is no address."""
MOMENTS = ("loading", "at rest", "offline")
UPDATES = ("whole", "cut", "arriving", "none")
TABLE = {
    "whole": ("1 1 1 1", "1 1 1 1", "2 1 1 1"),
    "cut": ("2 2 2 1", "2 2 2 1", "2 - - 1"),
    "damaged": ("2 2 2 1", "2 2 2 1", "2 - - 1"),
    "none": ("2 2 2", "2 2 2", "2 - -"),
}
"""Which release a page shows: by what is stored of release 1; by what the page does as it looks for
release 2 (`MOMENTS`); and by what arrives of that (`UPDATES`). A host has one release at a time."""
ROWS = {
    (stored, moment, update): shown
    for stored, cells in TABLE.items()
    for moment, cell in zip(MOMENTS, cells, strict=True)
    for update, shown in zip(UPDATES, cell.split(), strict=False)
}
SAMPLE = [
    (stored, moment, update)
    for stored, moment, update in ROWS
    if ([*TABLE].index(stored) + MOMENTS.index(moment) + UPDATES.index(update)) % 3 == 0
]
"""A third, in which any two of the three parts of a row meet."""

HTML = """<!DOCTYPE html><title>{release}</title><script>
  window.shared = () => import(new URL("{root}assets/{release}/shared.js", location.href));
</script>"""
SHARED = b'export const late = async () => (await import("./late.js")).release;'
"""The same in both releases; the file beside it is not."""
SHOWN = "async () => document.title + (await (await shared()).late())"
SEEK = """async () => {
  const known = await navigator.serviceWorker.getRegistration();
  const registration = known ?? (await navigator.serviceWorker.register('sw.js'));
  if (known) await known.update();
  const worker = registration.installing ?? registration.waiting;
  window.end = new Promise((resolve) => {
    const look = () => !/^(activated|redundant)$/.test(worker?.state ?? 'activated') || resolve();
    worker?.addEventListener('statechange', look);
    look();
  });
}"""
"""Look for a release; `end` comes when it is taken up, or is not."""
FRAME = """async () => {
  const frame = Object.assign(document.createElement('iframe'), {src: 'other/'});
  await new Promise((resolve) => (frame.onload = resolve) && document.body.append(frame));
  await (await frame.contentWindow.shared()).late();
}"""
"""Open a further page, which may be of the next release, beside this one."""
EACH = """async () => {
  const texts = [];
  for (const name of await caches.keys()) {
    const cache = await caches.open(name);
    for (const key of await cache.keys()) {
      const file = await cache.match(key);
      ACT;
    }
  }
  return texts;
}"""
STORED = EACH.replace("ACT", "texts.push(await file.text())")
SPOIL = {
    "cut": EACH.replace("ACT", "if (!key.url.includes('.json')) await cache.delete(key)"),
    "damaged": EACH.replace("ACT", "await cache.put(key, new Response('damaged', file))"),
}


@dataclass
class ChromiumTab:
    """What the table needs of an `Engine`."""

    page: Page

    def open(self, url: str) -> None:
        try:
            self.page.goto(url)
        except PlaywrightError:
            self.page.wait_for_url("chrome-error:**")  # else it interrupts what is opened next
            raise

    def ask(self, expression: str) -> Any:
        return self.page.evaluate(expression)


type Tab = Engine | ChromiumTab


@pytest.fixture(scope="module")
def sites(tmp_path_factory: pytest.TempPathFactory) -> Mapping[str, Path]:
    """Two releases of a small site."""
    folder = tmp_path_factory.mktemp("sites")
    for release in "12":
        assets = f"assets/{release}/"
        write_scripts(ROOT, folder / release / assets, ["offline/service_worker"])
        files: dict[str, bytes | Path] = {
            **folder_files(folder / release),
            "index.html": HTML.format(release=release, root="").encode(),
            "other/index.html": HTML.format(release=release, root="../").encode(),
            f"{assets}shared.js": SHARED,
            f"{assets}late.js": f"export const release = {release};".encode(),
            f"{assets}{ODD}": release.encode(),
            f"{assets}{FILM}": b"0123456789",
        }
        for name, content in {**files, **release_files(files, assets)}.items():
            (folder / release / name).parent.mkdir(parents=True, exist_ok=True)
            (folder / release / name).write_bytes(content_bytes(content))
    return {release: folder / release for release in "12"}


@pytest.fixture
def host(sites: Mapping[str, Path]) -> Iterator[StaticServer]:
    """Each is an origin of its own, where nothing is stored yet."""
    with serving(sites["1"]) as server:
        yield server


@pytest.fixture
def tab(brisk_chromium: Browser, host: StaticServer) -> Iterator[ChromiumTab]:
    with visit(brisk_chromium, host, service_workers="allow") as someone:
        yield ChromiumTab(someone.page)


@pytest.mark.parametrize(
    "row",
    [
        pytest.param(row, id="-".join(row), marks=[] if row in SAMPLE else pytest.mark.deep)
        for row in ROWS
    ],
)
def test_a_release_is_there_whole_or_not_at_all_whatever_is_stored_and_arrives(
    row: tuple[str, str, str], tab: Tab, host: StaticServer, sites: Mapping[str, Path]
) -> None:
    turn_of_releases(row, tab, host, sites)


@pytest.mark.deep
def test_a_release_is_there_whole_or_not_at_all_in_firefox(
    sites: Mapping[str, Path], tmp_path: Path
) -> None:
    opened = ENGINES["Firefox"](tmp_path)
    if opened is None:
        pytest.skip(f"Firefox: {HOW_TO}")
    with opened as firefox:
        for row in list(ROWS)[2::9]:
            with serving(sites["1"]) as host:
                turn_of_releases(row, firefox, host, sites)


def turn_of_releases(
    row: tuple[str, str, str], tab: Tab, host: StaticServer, sites: Mapping[str, Path]
) -> None:
    """A page shows what the table says, and once all arrives the last release is stored whole."""
    stored, moment, update = row
    last = "1" if update == "none" else "2"
    host.uncached = True
    if stored != "none":
        take_up(tab, host.url)
    if stored in SPOIL:
        tab.ask(SPOIL[stored])
    requested, released = threading.Event(), threading.Event()

    def hold(content: bytes) -> bytes:
        requested.set()
        released.wait(4 * limit_s())
        return content

    if update in ("cut", "arriving"):
        fault = Fault(lambda _: b"Sign in") if update == "cut" else Fault(hold)
        host.faults[f"/2/{address(ODD)}"] = fault
    files = folder_files(sites[last])
    whole = sorted(content_bytes(files[name]).decode() for name in files if name != WORKER)
    host.root = sites[last]
    tab.open(host.url)
    if moment == "at rest":
        tab.ask("async () => void (await shared())")
    tab.ask(SEEK)
    if update == "arriving":
        assert requested.wait(2 * limit_s())
    else:
        tab.ask("() => window.end")
    if moment == "at rest":
        tab.ask(FRAME)
    visible = shown(tab)
    if moment == "offline":
        host.gone = True
        visible = shown(tab, host.url)
    assert visible == ROWS[row] * len(visible), row
    if update == "cut" and moment != "offline":
        assert set(whole) - {last} <= set(tab.ask(STORED)), "one file stops no other"

    host.gone = False
    host.faults.clear()
    released.set()
    if update != "arriving" or moment == "offline":
        tab.open(f"{host.url}other/")
        take_up(tab, host.url)
    tab.ask("() => window.end")
    until(lambda: set(whole) <= set(tab.ask(STORED)))
    host.gone = True
    for page in ("", "other?place=1"):
        assert shown(tab, host.url + page) == last * 2, row
    assert tab.ask("() => location.href").endswith("other/?place=1")
    until(lambda: whole == sorted(tab.ask(STORED)))


def take_up(tab: Tab, home: str) -> None:
    tab.open(home)
    tab.ask(SEEK)
    tab.ask("() => window.end")


def shown(tab: Tab, url: str = "") -> str:
    """The releases of a page and of its late script; `-` where the page does not come."""
    with suppress(PlaywrightError, RuntimeError):
        if url:
            tab.open(url)
        return str(tab.ask(SHOWN))
    return "-"


def test_where_the_book_is_no_longer_to_be_stored_it_is_removed(
    tab: Tab, host: StaticServer
) -> None:
    take_up(tab, host.url)
    host.damaged["/sw.js"] = no_release("assets/1/")[WORKER]
    tab.open(host.url)
    with suppress(PlaywrightError):  # the page is loaded anew
        tab.ask(SEEK)
    until(lambda: not tab.ask("() => caches.keys()"))


def test_the_browser_s_own_copy_goes_first_a_second_try_heals_and_a_film_is_wound_forward(
    tab: ChromiumTab, host: StaticServer
) -> None:
    """With its own copy of a script the browser keeps the compiled code."""
    page = tab.page
    take_up(tab, host.url)
    for cache, is_stored in (("default", True), ("only-if-cached", False)):
        with page.expect_response("**/late.js") as reply:
            page.evaluate(FETCH, ["late.js", {"cache": cache, "mode": "same-origin"}])
        assert reply.value.from_service_worker is is_stored
        assert reply.value.ok
    tab.ask(SPOIL["damaged"])
    options = {"integrity": integrity(b"0123456789")}
    with suppress(PlaywrightError):  # what checks a file itself may get a damaged one
        page.evaluate(FETCH, [FILM, options])
    assert page.evaluate(FETCH, [FILM, {**options, "cache": "reload"}])[0] == 200
    host.gone = True
    for part, answer in PARTS.items():
        assert page.evaluate(FETCH, [FILM, {"headers": {"Range": part}}]) == answer
    host.gone = False
    (worker,) = page.context.service_workers
    worker.evaluate("void (caches.open = () => Promise.reject(new Error('broken')))")
    assert shown(tab, f"{host.url}other/") == "11"


FETCH = """async ([name, options]) => {
  const reply = await fetch(`assets/1/${name}`, options);
  return [reply.status, await reply.text(), reply.headers.get('content-range')];
}"""
PARTS = {
    "bytes=2-4": [206, "234", "bytes 2-4/10"],
    "bytes=0-": [206, "0123456789", "bytes 0-9/10"],
    "bytes=8-99": [206, "89", "bytes 8-9/10"],
    "lines=1-2": [200, "0123456789", None],
}
"""A host's answers to ranges by RFC 9110, section 14."""


def test_after_one_visit_every_page_its_figures_and_the_search_work_without_a_network(
    brisk_chromium: Browser, built_site: Path, book: Any
) -> None:
    with (
        serving(built_site) as host,
        visit(brisk_chromium, host, service_workers="allow") as kept,
    ):
        kept.page.goto(kept.root)
        kept.page.wait_for_function("navigator.serviceWorker.controller", timeout=2 * limit_ms())
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


@pytest.mark.parametrize("file", [WORKER, "references/"])
def test_why_the_book_is_not_stored_is_said_once_and_the_page_works_on(
    brisk_chromium: Browser, built_site: Path, file: str
) -> None:
    with (
        serving(built_site) as host,
        visit(brisk_chromium, host, service_workers="allow") as reader,
    ):
        host.faults[f"/{file}"] = Fault(lambda _: b"", status=404)
        reader.open("glossary/", live=False)
        said = reader.page.locator(".notice")
        said.wait_for()
        assert file in said.inner_text()
        assert "404" in said.inner_text()
        reader.page.reload()
        assert search(reader.page, "vignetting")
        assert not said.count()


def until(ask: Callable[[], Any]) -> None:
    """Ask until the answer is yes. (Playwright's own waiting takes any promise for a yes.)"""
    deadline = time.monotonic() + 2 * limit_s()
    while time.monotonic() < deadline:
        with suppress(PlaywrightError, RuntimeError):  # the page was turned while it was asked
            if ask():
                return
        time.sleep(0.1)
    pytest.fail("the answer stays no")


def search(page: Page, words: str) -> str | None:
    """Address of the first hit."""
    page.keyboard.press("/")
    page.locator("dialog[open] input[type=search]").fill(words)
    return page.locator("a[data-result]").first.get_attribute("href")


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
