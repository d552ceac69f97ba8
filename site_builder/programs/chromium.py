"""The Chromium that sets the book and runs the tests: where it is, how it is started."""

import os
import shutil
from pathlib import Path

SYSTEM_NAMES = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")


class MissingChromiumError(RuntimeError):
    """No Chromium, or nothing to drive one; the message says how to get it."""


def find_chromium() -> Path | None:
    """Playwright's own browser if it is installed, else the system's, else None."""
    from playwright.sync_api import sync_playwright  # only this needs it

    with sync_playwright() as playwright:
        bundled = Path(playwright.chromium.executable_path)
    if bundled.exists():
        return bundled
    for name in SYSTEM_NAMES:
        found = shutil.which(name)
        if found:
            return Path(found)
    return None


def launch_arguments() -> list[str]:
    """What a headless run without a display, perhaps as root, needs."""
    arguments = ["--disable-gpu", "--disable-background-networking"]
    return [*arguments, "--no-sandbox"] if os.geteuid() == 0 else arguments


def require_chromium(what: str) -> Path:
    """For ``what``, such as ``the PDF``. Raises `MissingChromiumError`."""
    try:
        found = find_chromium()
    except ModuleNotFoundError as error:
        message = f"{what} needs the package {error.name!r}; `pip install {error.name}` installs it"
        raise MissingChromiumError(message) from None
    if found is None:
        raise MissingChromiumError(
            f"{what} needs Chromium, and none was found; install one (for example "
            "`apt-get install chromium`), or run `playwright install chromium`"
        )
    return found
