"""The contracts of import-linter, and the pins of the two groups of dependencies."""

import re
import subprocess
import sys

from support.places import ROOT


def test_imports_run_only_downwards() -> None:
    lint = "from importlinter.cli import lint_imports_command as lint; lint()"
    command = [sys.executable, "-c", lint, "--no-cache"]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout


def test_pins_of_the_book_are_among_the_pins_of_the_tests() -> None:
    texts = [(ROOT / f".locks/{group}.txt").read_text("utf-8") for group in ("book", "test")]
    book, test = (set(re.findall(r"^[\w.-]+==[^\s;]+", text, re.MULTILINE)) for text in texts)
    assert book < test
