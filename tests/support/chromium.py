"""Find Chromium for the browser tests, or install it: ``python -m support.chromium``."""

import os
import shutil
import subprocess
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

from playwright.sync_api import Browser, sync_playwright

from site_builder.programs.chromium import find_chromium, launch_arguments

__all__ = ["find_chromium", "find_headless_shell", "launch_arguments", "open_chromium"]

HOW_TO = (
    "the browser tests need Chromium, and none could be found or installed; "
    "install one (for example `apt-get install chromium`) or run `playwright install chromium`"
)


SHELL = "chromium-headless-shell"


def find_headless_shell() -> Path | None:
    """The system's Chromium without a window, if it is installed.

    It opens and paints the same pages with a quarter less work.
    """
    found = shutil.which(SHELL)
    return Path(found) if found else None


@contextmanager
def open_chromium(*arguments: str) -> Iterator[Browser]:
    """The complete browser, for measurements; raises `SystemExit` if none is installed."""
    found = find_chromium()
    if found is None:
        raise SystemExit(HOW_TO)
    with (
        sync_playwright() as playwright,
        playwright.chromium.launch(
            executable_path=found, args=[*launch_arguments(), *arguments]
        ) as browser,
    ):
        yield browser


def install_commands() -> list[list[str]]:
    """Commands that install a browser, the least intrusive first."""
    return [[sys.executable, "-m", "playwright", "install", "chromium"], *packaged("chromium")]


def packaged(*names: str) -> list[list[str]]:
    """Commands that install system packages; empty without apt or the rights for it."""
    if not shutil.which("apt-get"):
        return []
    elevate = [] if os.geteuid() == 0 else ["sudo", "-n"]
    if elevate and not shutil.which("sudo"):
        return []
    apt = [*elevate, "apt-get"]
    return [[*apt, "update", "-qq"], [*apt, "install", "-y", "-qq", *names]]


def main() -> int:
    found = find_or_install(find_chromium, install_commands())
    shell = find_or_install(find_headless_shell, packaged(SHELL)) if found else None
    print(f"Chromium for the browser tests: {shell or found}" if found else HOW_TO)
    return 0 if found else 1


def find_or_install(
    find: Callable[[], Path | None], commands: Sequence[Sequence[str]]
) -> Path | None:
    """The program found, if necessary after running the commands one by one."""
    found = find()
    for command in commands:
        if found:
            break
        print("not found yet; trying:", " ".join(command), flush=True)
        subprocess.run(command, check=False)
        found = find()
    return found


if __name__ == "__main__":
    raise SystemExit(main())
