"""``python -m site_builder guide``: write the guide, then build or serve it as any other book."""

import os
import subprocess
import sys
from pathlib import Path

from site_builder.files.engine import ENGINE
from site_builder.guide.book import write_guide

FOLDER = Path("build", "guide")


def run_guide(place: tuple[str, int] | None, *, runtime: bool = True, folder: Path = FOLDER) -> int:
    """Serve it at ``place``, host and port, or only build it; the exit code of that."""
    book, site = folder.resolve() / "book", folder.resolve() / "site"
    write_guide(book)
    how = ["serve", "--host", place[0], "--port", str(place[1])] if place else ["build"]
    command = [sys.executable, "-m", "site_builder", *how, "--out", str(site)]
    given = [] if runtime else ["--no-runtime"]
    environment = {**os.environ, "PYTHONPATH": str(ENGINE)}  # from the folder of another book
    return subprocess.run([*command, *given], cwd=book, env=environment, check=False).returncode
