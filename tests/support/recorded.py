"""Texts that are recorded in files."""

from pathlib import Path

import pytest


def assert_recorded(text: str, file: Path) -> None:
    """A mismatch leaves ``NAME-changed`` beside it to compare, and to rename if it is right."""
    changed = file.with_name(f"{file.stem}-changed{file.suffix}")
    if not file.is_file() or text != file.read_text(encoding="utf-8"):
        changed.write_text(text, encoding="utf-8")
        pytest.fail(f"see {changed.name}:\n{text}")
    changed.unlink(missing_ok=True)
