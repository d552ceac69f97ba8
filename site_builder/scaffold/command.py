"""``python -m site_builder new KIND NAME``."""

from pathlib import Path

from site_builder.scaffold.new_book import make_book
from site_builder.scaffold.pieces import PIECES


def make_new(root: Path, kind: str, name: str) -> str:
    """Make it, and say what was made and what comes next. Raises `ScaffoldError`."""
    if kind == "book":
        files = make_book(Path(name))
        return f"{name}: {len(files)} files\nnext: cd {name} && make serve"
    made, after = PIECES[kind](root, name)
    return "\n".join([*made, f"next: {after}"])
