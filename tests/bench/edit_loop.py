"""``python -m bench.edit_loop [--rounds 7]``: how long an author waits for an edit.

Serves a copy of this book, edits it as an author does, and measures the time from saving the file
until an open page shows the edit.
"""

import argparse
import os
import shutil
import signal
import socket
import statistics
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from playwright.sync_api import Page
from support.chromium import open_chromium

ROOT = Path(__file__).resolve().parents[2]
PARTS = ("content", "simulations", "site_builder", "static", "LICENSE")
"""Of the checkout: what a book is built from."""
REST_S = 1.5
"""Between two edits."""
LONGEST_MS = 60_000


@dataclass(frozen=True, slots=True)
class Edit:
    """What an author changes again and again."""

    title: str
    goal_s: float
    file: str
    """Below the book's folder."""
    old: str
    """Stands in the file; each round puts another text in its place."""
    new: str
    """With ``{word}``, which no round has twice."""
    shown: str
    """An expression that is true in the page once it shows ``{word}``."""


SENTENCE = "document.querySelector('main').textContent.includes('{word}')"
RULE = "getComputedStyle(document.body).getPropertyValue('--edited').trim() === '{word}'"
THIS_BOOK = (
    Edit(
        "a sentence", 1.0, "content/04-lens-distortion.md",
        "\n\n## ", "\n\nA sentence of {word}.\n\n## ", SENTENCE,
    ),
    Edit(
        "a style rule", 0.5, "static/css/prose.css",
        "", "body {{ --edited: {word}; }}\n", RULE,
    ),
    Edit(
        "a scene", 4.0, "simulations/scenes/lens_distortion/scene.py",
        '"Largest bow"', '"Bow {word}"', SENTENCE,
    ),
)  # fmt: skip


def main() -> None:
    parser = argparse.ArgumentParser(prog="bench.edit_loop", description=__doc__)
    parser.add_argument("--rounds", type=int, default=7)
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder, open_chromium() as browser:
        page = browser.new_page(service_workers="block")
        book = Path(folder) / "book"
        copy_book(book)
        with served(book) as address:
            page.goto(f"{address}lens-distortion/")
            page.wait_for_selector("simulation-figure[data-state=live]", timeout=LONGEST_MS)
            for edit in THIS_BOOK:
                print(told(edit.title, waits(edit, book, page, given.rounds), edit.goal_s))


def copy_book(folder: Path) -> None:
    """With the engine in it, whose style sheets are edited too."""
    folder.mkdir()
    for part in PARTS:
        if (ROOT / part).is_dir():
            ignored = shutil.ignore_patterns("__pycache__")
            shutil.copytree(ROOT / part, folder / part, ignore=ignored)
        else:
            shutil.copy(ROOT / part, folder / part)


@contextmanager
def served(book: Path) -> Iterator[str]:
    """The address at which the book is served, after its first build."""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    command = [sys.executable, "-m", "site_builder", "serve", "--port", str(port)]
    environment = {**os.environ, "PYTHONPATH": str(book)}
    process = subprocess.Popen(
        [*command, "--out", str(book / "build" / "site")], cwd=book, env=environment,
        stdout=subprocess.PIPE, text=True,
    )  # fmt: skip
    assert process.stdout is not None
    try:
        address = next(line for line in process.stdout if line.startswith("http"))
        threading.Thread(target=process.stdout.read, daemon=True).start()
        yield address.strip()
    finally:
        process.send_signal(signal.SIGINT)
        process.wait()


def waits(edit: Edit, book: Path, page: Page, rounds: int) -> list[float]:
    """Seconds from saving to showing, of each round; the file is put back after them."""
    file = book / edit.file
    before = file.read_text(encoding="utf-8")
    found = []
    for count in range(rounds):
        time.sleep(REST_S)
        word = f"e{time.time_ns():x}{count}"
        new = edit.new.format(word=word)
        text = before.replace(edit.old, new, 1) if edit.old else before + new
        begin = time.perf_counter()
        file.write_text(text, encoding="utf-8")
        shown = edit.shown.format(word=word)
        page.wait_for_function(shown, polling="raf", timeout=LONGEST_MS)
        found.append(time.perf_counter() - begin)
    file.write_text(before, encoding="utf-8")
    return found


def told(title: str, found: list[float], goal_s: float) -> str:
    middle = statistics.median(found)
    spread = f"{min(found):.2f} to {max(found):.2f} s"
    return f"{title}: {middle:.2f} s ({spread}); goal {goal_s:g} s"


if __name__ == "__main__":
    main()
