"""Compressed bytes fetched until a page is first painted, and until its first figure is live.
``python -m bench.bytes`` measures the built site, writes the section ``bytes`` of
``content/costs.json`` and prints each page."""

import re
from collections.abc import Iterator, Mapping
from pathlib import Path

from bench.costs import SITE, store_section
from playwright.sync_api import Browser
from support.chromium import open_chromium
from support.static_server import StaticServer, serving

from site_builder.cache.results import Cache, using
from site_builder.files.folders import folder_files
from site_builder.pages.embeds import EMBED_FOLDER
from site_builder.publishing.hosting import compressed_copies

NEEDED = re.compile(r'<link rel="(?:preload" as="font|stylesheet)"[^>]* href="([^"]+)"')
"""Files in the head that the first paint waits for, or that are fetched before it."""
KB = 1000
LIVE_MARK = "404.html?lived"
REPORT_LIVE = f"""new MutationObserver((changes, observer) => {{
  if (!changes.some(({{target}}) => target.dataset?.state === 'live')) return;
  observer.disconnect();
  fetch('{LIVE_MARK}');
}}).observe(document, {{subtree: true, attributeFilter: ['data-state']}})"""
"""In every page: requests a file when the first figure is live; later requests do not count."""


class Weights:
    """Bytes of the files of a site as a host sends them, in the smallest copy of each."""

    def __init__(self, root: Path) -> None:
        self.root = root.resolve()
        with using(Cache()):
            copies = compressed_copies(folder_files(root))
        self._sizes = {
            name.removesuffix(".br"): len(body)
            for name, body in copies.items()
            if name.endswith(".br")
        }

    def of(self, name: str) -> int:
        """Bytes of a file, or of the page of a folder."""
        file = self.root / name
        if file.is_dir():
            return self.of(f"{name}index.html")
        return self._sizes.get(name) or file.stat().st_size

    def first_paint(self, page: str) -> int:
        """Bytes of a page and of the files that its first paint needs."""
        file = self.root / page
        names = NEEDED.findall(file.read_text(encoding="utf-8"))
        files = [file, *((file.parent / name).resolve() for name in names)]
        return sum(self.of(each.relative_to(self.root).as_posix()) for each in files)

    def first_live_frame(self, browser: Browser, server: StaticServer, address: str) -> int:
        """Bytes requested until the first figure of a page is live, in a browser with an empty
        cache."""
        with browser.new_context(service_workers="block") as context:
            context.add_init_script(REPORT_LIVE)
            requested: list[str] = []
            context.on("request", lambda request: requested.append(request.url))
            page = context.new_page()
            with page.expect_request(f"**/{LIVE_MARK}", timeout=60_000):
                page.goto(server.url + address)
            end = next(n for n, url in enumerate(requested) if url.endswith(LIVE_MARK))
        own = (url for url in requested[:end] if url.startswith(server.url))
        names = {url.removeprefix(server.url) for url in own}
        return sum(self.of(name.partition("?")[0]) for name in names)


def measure(browser: Browser, server: StaticServer) -> Iterator[tuple[str, int, int | None]]:
    """Each page's address and both numbers in bytes; the second is None without a figure.

    Pages with a single figure for other sites are left out.
    """
    weights = Weights(server.root)
    for file in sorted(weights.root.rglob("index.html")):
        page = file.relative_to(weights.root).as_posix()
        if page.startswith(EMBED_FOLDER):
            continue
        address = page.removesuffix("index.html")
        has_figure = "<simulation-figure" in file.read_text(encoding="utf-8")
        live = weights.first_live_frame(browser, server, address) if has_figure else None
        yield address, weights.first_paint(page), live


def worst(found: Mapping[str, int]) -> dict[str, float]:
    """The largest of these numbers of bytes, in kilobytes."""
    return {"worst_kb": round(max(found.values()) / KB, 1)}


def main() -> None:
    painted, live = {}, {}
    with open_chromium() as browser, serving(SITE) as server:
        for address, paint, frame in measure(browser, server):
            painted[address] = paint
            if frame is not None:
                live[address] = frame
            after = f"{frame / KB:8.0f} kB to the first live frame" if frame else ""
            print(f"{address or './':60} {paint / KB:6.1f} kB to the first paint {after}")
    store_section("bytes", {"first_paint": worst(painted), "first_live_frame": worst(live)})


if __name__ == "__main__":
    main()
