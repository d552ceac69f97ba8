"""Find a Chromium for the browser tests, or get one: ``python tests/support/chromium.py``."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

from playwright.sync_api import sync_playwright

SYSTEM_NAMES = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")

HOW_TO = (
    "the browser tests need Chromium, and none could be found or installed; "
    "install one (for example `apt-get install chromium`) or run `playwright install chromium`"
)


def find_chromium() -> Path | None:
    """Playwright's own browser if it is installed, else the system's, else None."""
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


def install_commands() -> list[list[str]]:
    """Ways to get a browser, the least intrusive first."""
    commands = [[sys.executable, "-m", "playwright", "install", "chromium"]]
    if shutil.which("apt-get"):
        if os.geteuid() == 0:
            elevate: list[str] | None = []
        else:
            elevate = ["sudo", "-n"] if shutil.which("sudo") else None
        if elevate is not None:
            commands.append([*elevate, "apt-get", "update", "-qq"])
            commands.append([*elevate, "apt-get", "install", "-y", "-qq", "chromium"])
    return commands


def main() -> int:
    found = find_chromium()
    for command in install_commands():
        if found:
            break
        print("no Chromium yet; trying:", " ".join(command), flush=True)
        subprocess.run(command, check=False)
        found = find_chromium()
    print(f"Chromium for the browser tests: {found}" if found else HOW_TO)
    return 0 if found else 1


if __name__ == "__main__":
    raise SystemExit(main())
