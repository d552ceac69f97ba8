"""The Chromium that sets the book and runs the tests: where it is, how it is started."""

import os
import shutil
from importlib.util import find_spec
from pathlib import Path

from site_builder.files.engine import DISTRIBUTION

SYSTEM_NAMES = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")


class MissingChromiumError(RuntimeError):
    """No Chromium, or nothing to drive one; the message says how to get it."""


def find_chromium() -> Path | None:
    """Playwright's own browser if it is installed, else the system's, else None."""
    if find_spec("playwright"):
        from playwright.sync_api import sync_playwright  # only this needs it

        with sync_playwright() as playwright:
            bundled = Path(playwright.chromium.executable_path)
        if bundled.exists():
            return bundled
    found = (shutil.which(name) for name in SYSTEM_NAMES)
    return next((Path(path) for path in found if path), None)


def launch_arguments() -> list[str]:
    """What a headless run without a display, perhaps as root, needs."""
    arguments = ["--disable-gpu", "--disable-background-networking"]
    return [*arguments, "--no-sandbox"] if os.geteuid() == 0 else arguments


def require_chromium(what: str, *packages: str) -> Path:
    """For ``what``, such as ``the PDF``, which needs ``packages`` besides. Raises
    `MissingChromiumError`, which names all that is missing."""
    found = find_chromium()
    missing = [name for name in ("playwright", *packages) if not find_spec(name)]
    needs = [f"{' and '.join(missing)} (pip install '{DISTRIBUTION}[pdf]')"] if missing else []
    if found is None:
        needs.append("Chromium (apt-get install chromium, or playwright install chromium)")
    if found is None or needs:
        raise MissingChromiumError(f"{what} needs {', and '.join(needs)}")
    return found
