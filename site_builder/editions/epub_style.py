"""The style sheet of the e-book: the site's colours, faces and drawings, without what readers of
e-books lack."""

import re
from pathlib import Path

OWN = Path(__file__).with_name("epub.css")
TOKEN = re.compile(r"^  (--[\w-]+): light-dark\(([^,]+), [^)]+\);", re.MULTILINE)
FACE = re.compile(r"^@font-face \{\n(?:(?!\}).*\n)*?  src: url\((?:.*\n)*?\}\n", re.MULTILINE)
CONTAINER = re.compile(r"^@container (?:.*\n)*?\}\n", re.MULTILINE)
FAMILIES = {"--serif": '"Book Serif", serif', "--sans": '"Book Sans", sans-serif'}


def book_style(folder: Path) -> str:
    """``folder`` holds the site's style sheets. Variables are resolved, to the light theme."""
    tokens = dict(TOKEN.findall(_read(folder / "tokens.css"))) | FAMILIES
    faces = "".join(FACE.findall(_read(folder / "fonts.css")))
    drawings = CONTAINER.sub("", _read(folder / "overlay.css"))
    return faces + resolve(drawings + _read(OWN), tokens)


def resolve(sheet: str, tokens: dict[str, str]) -> str:
    """Without variables. Raises `KeyError` for one that is not a token."""
    return re.sub(r"var\((--[\w-]+)\)", lambda found: tokens[found[1]], sheet)


def _read(file: Path) -> str:
    return file.read_text(encoding="utf-8") if file.exists() else ""
