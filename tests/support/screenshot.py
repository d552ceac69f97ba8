"""The README's picture, or one of any built page: ``make screenshot``."""

import sys
from pathlib import Path

from playwright.sync_api import Page
from support.chromium import open_chromium
from support.static_server import serving

ROOT = Path(__file__).resolve().parents[2]
README_PICTURE = ROOT / ".github" / "screenshot.png"
ALIVE = """[...document.querySelectorAll('simulation-figure')]
    .every((figure) => ['live', 'failed'].includes(figure.dataset.state))"""
QUIET = """(figure) => !figure.querySelector('.figure-status:not([hidden])')
    && figure.dataset.frames > 1"""

VIEW = "(figure) => { document.activeElement.blur(); scrollTo(0, figure.offsetTop - 240); }"


def page_picture(page: Page, address: str) -> Path:
    """The whole page at ``address``, from top to bottom."""
    picture = ROOT / "build" / f"{address.strip('/').replace('/', '-') or 'index'}.png"
    page.screenshot(path=picture, full_page=True)
    return picture


def readme_picture(page: Page) -> Path:
    """What a reader sees after dragging k₁ of the first figure into a barrel."""
    figure = page.locator("simulation-figure").first
    figure.locator("input[name=k1]").fill("-0.3")
    page.wait_for_function(QUIET, arg=figure.element_handle())
    page.evaluate(VIEW, figure.element_handle())
    page.wait_for_timeout(1500)  # the error is computed once the hand rests
    README_PICTURE.parent.mkdir(exist_ok=True)
    page.screenshot(path=README_PICTURE)
    return README_PICTURE


def main(address: str) -> None:
    with open_chromium() as browser, serving(ROOT / "build" / "site") as server:
        page = browser.new_page(viewport={"width": 1280, "height": 860})
        page.goto(server.url + (address or "lens-distortion/"))
        page.wait_for_function(ALIVE)
        print(page_picture(page, address) if address else readme_picture(page))


if __name__ == "__main__":
    main(sys.argv[1])
