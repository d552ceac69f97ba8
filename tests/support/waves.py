"""Another book, on waves, and Python run on it by the engine of this one."""

import os
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
WAVES = ROOT / "tests" / "fixtures" / "waves-book"
SCENES = {
    name.replace("_", "-"): f"simulations.scenes.{name}.scene"
    for name in ("leakage", "standing_waves", "wave_packet")
}
LADDERS = {"tone-frequency": "simulations.ladders.tone_frequency"}
"""Its scenes and ladders, each id to its module."""


def on_waves(*words: str, book: Path = WAVES) -> "subprocess.CompletedProcess[str]":
    """As ``BOOK=tests/fixtures/waves-book python …``."""
    environment = {**os.environ, "BOOK": str(book)}
    command = [sys.executable, *words]
    return subprocess.run(
        command, cwd=ROOT, env=environment, capture_output=True, text=True, check=False
    )
