"""The folders of this book, and of two others that this engine builds."""

from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
WAVES = ROOT / "tests" / "fixtures" / "waves-book"
GERMAN_BOOK = ROOT / "tests" / "fixtures" / "german-book"
