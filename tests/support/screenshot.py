"""A picture of a built page: ``python tests/support/screenshot.py lens-distortion/``."""

import sys
from pathlib import Path

from chromium import find_chromium, launch_arguments
from playwright.sync_api import sync_playwright
from static_server import serving

BUILD = Path(__file__).resolve().parents[2] / "build"
ALIVE = """[...document.querySelectorAll('simulation-figure')]
    .every((figure) => ['live', 'failed'].includes(figure.dataset.state))"""


def main(address: str) -> None:
    chromium = find_chromium()
    with serving(BUILD / "site") as server, sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=chromium, args=launch_arguments())
        page = browser.new_page(viewport={"width": 1280, "height": 900})
        page.goto(server.url + address)
        page.wait_for_function(ALIVE)
        picture = BUILD / f"{address.strip('/').replace('/', '-') or 'index'}.png"
        page.screenshot(path=picture, full_page=True)
        browser.close()
    print(picture)


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else "")
