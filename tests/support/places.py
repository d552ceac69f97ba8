"""The folders of this book, and of another that this engine builds."""

from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
GERMAN_BOOK = ROOT / "tests" / "fixtures" / "german-book"
SCENES = {name: f"simulations.scenes.{name}.scene" for name in ("fadenpendel", "saite")}
LADDERS = {"tonhoehe": "simulations.ladders.tonhoehe"}
"""What the German book has: each id to its module."""
