"""Find a Chromium for the browser tests, or get one: ``python -m support.chromium``."""

import os
import shutil
import subprocess
import sys

from site_builder.editions.chromium import find_chromium, launch_arguments

__all__ = ["find_chromium", "launch_arguments"]

HOW_TO = (
    "the browser tests need Chromium, and none could be found or installed; "
    "install one (for example `apt-get install chromium`) or run `playwright install chromium`"
)


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
