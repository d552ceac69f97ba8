"""What a reader fetches, packed: until a page is first painted, and until its first figure is live.
``python -m bench.bytes`` measures the built site, writes the section ``bytes`` of
``content/costs.json`` and prints each page."""

import re
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path

from bench.costs import keep
from playwright.sync_api import Browser
from support.chromium import open_chromium
from support.host import Host, hosting
from support.places import ROOT

from site_builder.cache.results import Cache, using
from site_builder.files.folders import folder_files
from site_builder.pages.embeds import FOLDER as EMBED_FOLDER
from site_builder.publishing.compressed import compressed_copies

SITE = ROOT / "build" / "site"
NEEDED = re.compile(r'<link rel="(?:preload" as="font|stylesheet)"[^>]* href="([^"]+)"')
"""What a head names that the first paint waits for, or is fetched before what it does not."""
KB = 1000
KEEP = {"/*": {"Cache-Control": "max-age=600"}}
"""Header of GitHub Pages for every file, so that browsers do not fetch one twice."""
LIVED = "404.html"
SETTLED_MS = 500
"""After which all is sent that was asked for until then."""
TELL = f"""new MutationObserver((changes, observer) => {{
  if (!changes.some(({{target}}) => target.dataset?.state === 'live')) return;
  observer.disconnect();
  fetch('{LIVED}?' + Date.now());
}}).observe(document, {{subtree: true, attributeFilter: ['data-state']}})"""
"""In every page: tells the host when a figure lives: what is asked for later is for the next."""


def packed_copies(site: Path) -> dict[str, bytes]:
    """Packed copies of all files."""
    with using(Cache()):
        return compressed_copies(folder_files(site))


def first_paint(host: Host, page: str) -> int:
    """Bytes of a page and of what its head names for the first paint."""
    folder = (host.root / page).parent
    html = (host.root / page).read_text(encoding="utf-8")
    names = [page, *(_below(host.root, folder / address) for address in NEEDED.findall(html))]
    return sum(len(host.packed(name, "br")[1]) for name in names)


def first_live_frame(browser: Browser, host: Host, address: str) -> int:
    """Bytes sent until the first figure of a page is live, in a browser that has nothing of it."""
    with browser.new_context(service_workers="block") as context:
        page = context.new_page()
        page.add_init_script(TELL)
        host.sent.clear()
        page.goto(host.url + address)
        page.wait_for_selector("simulation-figure[data-state=live]", timeout=60_000)
        while not (told := [each.query for each in host.sent if each.name == LIVED]):
            page.wait_for_timeout(10)
        page.wait_for_timeout(SETTLED_MS)
        files = [each for each in host.sent if each.name != LIVED]
        return sum(each.size for each in files if each.asked_ms <= float(told[0]))


def measure(browser: Browser, host: Host) -> Iterator[tuple[str, int, int | None]]:
    """Each page's address, and both numbers in bytes; the second None where no figure is.

    Pages of one figure alone are left out: the book's pages have the same figures.
    """
    for file in sorted(host.root.rglob("index.html")):
        page = _below(host.root, file)
        if page.startswith(EMBED_FOLDER):
            continue
        address = page.removesuffix("index.html")
        has_figure = "<simulation-figure" in file.read_text(encoding="utf-8")
        live = first_live_frame(browser, host, address) if has_figure else None
        yield address, first_paint(host, page), live


@contextmanager
def browser_and_host(site: Path = SITE) -> Iterator[tuple[Browser, Host]]:
    with open_chromium() as browser, hosting(site, packed_copies(site), KEEP) as host:
        yield browser, host


def worst(found: Mapping[str, int]) -> dict[str, float]:
    """The greatest of some numbers of bytes, in kilobytes."""
    return {"worst_kb": round(max(found.values()) / KB, 1)}


def _below(root: Path, file: Path) -> str:
    return file.resolve().relative_to(root.resolve()).as_posix()


def main() -> None:
    painted, live = {}, {}
    with browser_and_host() as (browser, host):
        for address, paint, frame in measure(browser, host):
            painted[address] = paint
            if frame is not None:
                live[address] = frame
            after = f"{frame / KB:8.0f} kB to the first live frame" if frame else ""
            print(f"{address or './':60} {paint / KB:6.1f} kB to the first paint {after}")
    keep("bytes", {"first_paint": worst(painted), "first_live_frame": worst(live)})


if __name__ == "__main__":
    main()
