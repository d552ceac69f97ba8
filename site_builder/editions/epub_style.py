"""The style sheet of the e-book: the site's colours, faces and drawings, without what readers of
e-books lack."""

import re
from pathlib import Path

from site_builder.output.font_faces import MATHS_FACES, face_rule
from site_builder.output.light_theme import light_tokens, resolve, without_containers

OWN = Path(__file__).with_name("epub.css")
FACE = re.compile(r"^@font-face \{\n(?:(?!\}).*\n)*?  src: url\((?:.*\n)*?\}\n", re.MULTILINE)
FAMILIES = {"--serif": '"Book Serif", serif', "--sans": '"Book Sans", sans-serif'}


def book_style(folder: Path) -> str:
    """``folder`` holds the site's style sheets. Variables are resolved, to the light theme."""
    tokens = light_tokens(_read(folder / "tokens.css")) | FAMILIES
    faces = "".join((*FACE.findall(_read(folder / "fonts.css")), *map(face_rule, MATHS_FACES)))
    drawings = without_containers(_read(folder / "overlay.css"))
    return faces + resolve(drawings + _read(OWN), tokens)


def _read(file: Path) -> str:
    return file.read_text(encoding="utf-8") if file.exists() else ""
