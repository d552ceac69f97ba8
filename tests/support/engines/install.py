"""Find Firefox and WebKitGTK, or install them: ``python -m support.engines.install``."""

from support.chromium import get, packaged
from support.engines import HOW_TO, webkit
from support.engines.firefox import find_firefox


def main() -> None:
    firefox = get(find_firefox, packaged("firefox-esr"))
    print(f"Firefox for the browser tests: {firefox or f'none; {HOW_TO}'}")
    driver = get(webkit.find_webkit, packaged(*webkit.PACKAGES))
    print(f"WebKitGTK for the browser tests: {driver or f'none; {HOW_TO}'}")


if __name__ == "__main__":
    main()
