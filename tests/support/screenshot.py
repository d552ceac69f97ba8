"""The screenshot in the README, or one of any built page: ``make screenshot``."""

import sys

from support.chromium import open_chromium
from support.places import ROOT
from support.reader import Reader, visit
from support.static_server import serving


def readme_picture(reader: Reader) -> None:
    """The first figure after dragging k₁ to a barrel distortion."""
    reader.open("lens-distortion/")
    figure = reader.figure("lens-distortion")
    with reader.next_frame(figure):
        figure.locator("input[name=k1]").fill("-0.3")
    reader.settle(figure)
    figure.evaluate(
        "(figure) => { document.activeElement.blur(); scrollTo(0, figure.offsetTop - 240); }"
    )
    reader.page.screenshot(path=ROOT / ".github" / "screenshot.png")


def page_picture(reader: Reader, address: str) -> None:
    """The whole page at ``address``, from top to bottom, in ``build/``."""
    reader.open(address)
    picture = ROOT / "build" / f"{address.strip('/').replace('/', '-')}.png"
    reader.page.screenshot(path=picture, full_page=True)


def main(address: str) -> None:
    screen = {"width": 1280, "height": 860}
    with (
        open_chromium() as browser,
        serving(ROOT / "build" / "site") as server,
        visit(browser, server, viewport=screen) as reader,
    ):
        if address:
            page_picture(reader, address)
        else:
            readme_picture(reader)


if __name__ == "__main__":
    main(sys.argv[1])
