"""Find Firefox and WebKitGTK, or install them: ``python -m support.engines.install``."""

from support.chromium import find_or_install, packaged
from support.engines import HOW_TO, webkit
from support.engines.firefox import find_firefox


def main() -> None:
    firefox = find_or_install(find_firefox, packaged("firefox-esr"))
    print(f"Firefox for the browser tests: {firefox or f'none; {HOW_TO}'}")
    driver = find_or_install(webkit.find_webkit, packaged(*webkit.PACKAGES))
    print(f"WebKitGTK for the browser tests: {driver or f'none; {HOW_TO}'}")


if __name__ == "__main__":
    main()
