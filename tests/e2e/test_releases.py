"""The service worker: changes of release, storage and ranges, mostly of a small site."""

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
from support.limits import limit_s
from support.page_scripts import SAVE_DATA
from support.places import ROOT
from support.reader import visit
from support.static_server import Fault, StaticServer, serving

from site_builder.assets.page_assets import write_scripts
from site_builder.files.folders import folder_files, integrity
from site_builder.output.writer import content_bytes
from site_builder.publishing.hosting import WORKER, address, no_release, release_files

pytestmark = pytest.mark.browser

FILM, ODD = "film.bin", "Fig #3 50%.bin"
"""Files of the small site: a binary file, and a name that needs escaping."""
MOMENTS = ("loading", "at rest", "offline")
UPDATES = ("whole", "cut", "arriving", "none")
TABLE = {
    "whole": ("1 1 1 1", "1 1 1 1", "2 1 1 1"),
    "cut": ("2 2 2 1", "2 2 2 1", "2 - - 1"),
    "damaged": ("2 2 2 1", "2 2 2 1", "2 - - 1"),
    "none": ("2 2 2", "2 2 2", "2 - -"),
}
"""The release that a page shows, by the stored state of release 1, by the state of the page while
it looks for release 2 (`MOMENTS`), and by how that release arrives (`UPDATES`). A host has one
release at a time."""
ROWS = {
    (stored, moment, update): release
    for stored, cells in TABLE.items()
    for moment, cell in zip(MOMENTS, cells, strict=True)
    for update, release in zip(UPDATES, cell.split(), strict=False)
}
SAMPLE = [
    (stored, moment, update)
    for stored, moment, update in ROWS
    if ([*TABLE].index(stored) + MOMENTS.index(moment) + UPDATES.index(update)) % 3 == 0
]
"""A third of the rows, which has all pairs of two parts of a row."""

HTML = """<!DOCTYPE html><title>{release}</title><script>
  window.shared = () => import(new URL("{root}assets/{release}/shared.js", location.href));
</script>"""
SHARED = b'export const late = async () => (await import("./late.js")).release;'
"""Equal in both releases, while the file that it imports differs."""
RELEASES = "async () => document.title + (await (await shared()).late())"
LOOK_FOR_RELEASE = """async () => {
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
"""Look for a new release; `end` resolves once it is active or rejected."""
OPEN_FRAME = """async () => {
  const frame = Object.assign(document.createElement('iframe'), {src: 'other/'});
  await new Promise((resolve) => (frame.onload = resolve) && document.body.append(frame));
  await (await frame.contentWindow.shared()).late();
}"""
"""Open a second page, possibly of the next release, beside this one."""
FOR_EACH_FILE = """async () => {
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
STORED = FOR_EACH_FILE.replace("ACT", "texts.push(await file.text())")
DAMAGE = {
    "cut": FOR_EACH_FILE.replace("ACT", "if (!key.url.includes('.json')) await cache.delete(key)"),
    "damaged": FOR_EACH_FILE.replace("ACT", "await cache.put(key, new Response('damaged', file))"),
}


@dataclass
class ChromiumTab:
    """The part of an `Engine` that the table needs, for Chromium."""

    page: Page

    def open(self, url: str) -> None:
        try:
            self.page.goto(url)
        except PlaywrightError:
            self.page.wait_for_url("chrome-error:**")  # otherwise it interrupts the next page
            raise

    def evaluate(self, expression: str) -> Any:
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
    """A new origin, for which nothing is stored."""
    with serving(sites["1"]) as server:
        yield server


@pytest.fixture
def tab(baseline_chromium: Browser, host: StaticServer) -> Iterator[ChromiumTab]:
    with visit(baseline_chromium, host, service_workers="allow") as reader:
        yield ChromiumTab(reader.page)


@pytest.mark.parametrize(
    "row",
    [
        pytest.param(row, id="-".join(row), marks=[] if row in SAMPLE else pytest.mark.deep)
        for row in ROWS
    ],
)
def test_release_is_shown_completely_or_not_at_all(
    row: tuple[str, str, str], tab: Tab, host: StaticServer, sites: Mapping[str, Path]
) -> None:
    check_change_of_release(row, tab, host, sites)


@pytest.mark.deep
def test_release_is_shown_completely_or_not_at_all_in_firefox(
    sites: Mapping[str, Path], tmp_path: Path
) -> None:
    opened = ENGINES["Firefox"](tmp_path)
    if opened is None:
        pytest.skip(f"Firefox: {HOW_TO}")
    with opened as firefox:
        for row in list(ROWS)[2::9]:
            with serving(sites["1"]) as host:
                check_change_of_release(row, firefox, host, sites)


def check_change_of_release(
    row: tuple[str, str, str], tab: Tab, host: StaticServer, sites: Mapping[str, Path]
) -> None:
    """Check that a page shows the table's release, and that the last one is finally stored."""
    stored, moment, update = row
    last = "1" if update == "none" else "2"
    host.uncached = True
    if stored != "none":
        activate_release(tab, host.url)
    if stored in DAMAGE:
        tab.evaluate(DAMAGE[stored])
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
        tab.evaluate("async () => void (await shared())")
    tab.evaluate(LOOK_FOR_RELEASE)
    if update == "arriving":
        assert requested.wait(2 * limit_s())
    else:
        tab.evaluate("() => window.end")
    if moment == "at rest":
        tab.evaluate(OPEN_FRAME)
    visible = shown_release(tab)
    if moment == "offline":
        host.offline = True
        visible = shown_release(tab, host.url)
    assert visible == ROWS[row] * len(visible), row
    if update == "cut" and moment != "offline":
        assert set(whole) - {last} <= set(tab.evaluate(STORED)), "a cut file stops no other"

    host.offline = False
    host.faults.clear()
    released.set()
    if update != "arriving" or moment == "offline":
        tab.open(f"{host.url}other/")
        activate_release(tab, host.url)
    tab.evaluate("() => window.end")
    until(lambda: set(whole) <= set(tab.evaluate(STORED)))
    host.offline = True
    for page in ("", "other?place=1"):
        assert shown_release(tab, host.url + page) == last * 2, row
    assert tab.evaluate("() => location.href").endswith("other/?place=1")
    until(lambda: whole == sorted(tab.evaluate(STORED)))


def activate_release(tab: Tab, home: str) -> None:
    tab.open(home)
    tab.evaluate(LOOK_FOR_RELEASE)
    tab.evaluate("() => window.end")


def shown_release(tab: Tab, url: str = "") -> str:
    """The releases of a page and of its late script; `-` where the page does not load."""
    with suppress(PlaywrightError, RuntimeError):
        if url:
            tab.open(url)
        return str(tab.evaluate(RELEASES))
    return "-"


def test_stored_book_is_removed_once_offline_use_is_turned_off(
    tab: Tab, host: StaticServer
) -> None:
    activate_release(tab, host.url)
    host.damaged["/sw.js"] = no_release("assets/1/")[WORKER]
    tab.open(host.url)
    with suppress(PlaywrightError):  # the page is loaded anew
        tab.evaluate(LOOK_FOR_RELEASE)
    until(lambda: not tab.evaluate("() => caches.keys()"))


def test_browser_cache_is_used_first_and_retries_and_ranges_work(
    tab: ChromiumTab, host: StaticServer
) -> None:
    """With a script in its own cache, the browser also caches the compiled code."""
    page = tab.page
    activate_release(tab, host.url)
    for cache, is_stored in (("default", True), ("only-if-cached", False)):
        with page.expect_response("**/late.js") as reply:
            page.evaluate(FETCH, ["late.js", {"cache": cache, "mode": "same-origin"}])
        assert reply.value.from_service_worker is is_stored
        assert reply.value.ok
    tab.evaluate(DAMAGE["damaged"])
    options = {"integrity": integrity(b"0123456789")}
    with suppress(PlaywrightError):  # a caller that checks integrity may get a damaged file
        page.evaluate(FETCH, [FILM, options])
    assert page.evaluate(FETCH, [FILM, {**options, "cache": "reload"}])[0] == 200
    host.offline = True
    for part, answer in RANGES.items():
        assert page.evaluate(FETCH, [FILM, {"headers": {"Range": part}}]) == answer
    host.offline = False
    (worker,) = page.context.service_workers
    worker.evaluate("void (caches.open = () => Promise.reject(new Error('broken')))")
    assert shown_release(tab, f"{host.url}other/") == "11"


def test_lost_list_of_files_is_stored_again_once_the_network_is_back(
    tab: ChromiumTab, host: StaticServer
) -> None:
    host.uncached = True
    activate_release(tab, host.url)
    tab.open(host.url)
    tab.evaluate(FOR_EACH_FILE.replace("ACT", "if (/json/.test(key.url)) await cache.delete(key)"))
    chromium = tab.page.context.new_cdp_session(tab.page)
    chromium.send("ServiceWorker.enable")
    chromium.send("ServiceWorker.stopAllWorkers")  # the next one knows no list
    host.offline = True
    assert shown_release(tab, host.url) == "-"
    host.offline = False
    assert shown_release(tab, host.url) == "11"
    until(lambda: any("assets/1/" in text for text in tab.evaluate(STORED)))
    host.offline = True
    assert shown_release(tab, f"{host.url}other/") == "11"


FETCH = """async ([name, options]) => {
  const reply = await fetch(`assets/1/${name}`, options);
  return [reply.status, await reply.text(), reply.headers.get('content-range')];
}"""
RANGES = {
    "bytes=2-4": [206, "234", "bytes 2-4/10"],
    "bytes=0-": [206, "0123456789", "bytes 0-9/10"],
    "bytes=8-99": [206, "89", "bytes 8-9/10"],
    "lines=1-2": [200, "0123456789", None],
}
"""A host's answers to ranges by RFC 9110, section 14."""


def until(condition: Callable[[], Any]) -> None:
    """Poll until the result is true. (Playwright's own waiting accepts any promise as true.)"""
    deadline = time.monotonic() + 2 * limit_s()
    while time.monotonic() < deadline:
        with suppress(PlaywrightError, RuntimeError):  # the page was turned meanwhile
            if condition():
                return
        time.sleep(0.1)
    pytest.fail("the condition stays false")


def test_page_of_an_earlier_release_keeps_working_and_leads_to_the_next(
    baseline_chromium: Browser, built_site: Path, tmp_path: Path
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
    with serving(built_site) as host, visit(baseline_chromium, host, SAVE_DATA) as reader:
        reader.open("why-image-formation/")
        page, notice = reader.page, reader.page.locator(".notice")
        own = page.evaluate("document.body.dataset.runtime")
        figure = reader.figure("formation-pipeline")
        reader.press(figure, "PageUp")
        host.root = tmp_path
        page.locator("[data-reveal]:visible").first.click()
        page.locator("a.set:visible").first.click()
        assert "has been updated" in notice.inner_text(), "the script that moves figures is missing"
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
        assert not [address for address in loaded if old in address], (
            "no page mixes files of two releases"
        )


MEASURE = """async () => {
  const {sharedRuntime} = (await customElements.whenDefined('simulation-figure')).internals;
  const request = {ladder: 'shading', tier: 'any', budget: 0.001};
  return sharedRuntime().call('measure', request).then(() => '', (error) => error.message);
}"""
"""The error of a call that needs a part of an earlier release."""
LOADED = "performance.getEntriesByType('resource').map(({name}) => name)"
