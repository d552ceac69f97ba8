"""The style sheet of the e-book: the site's colours, faces and drawings, without what readers of
e-books lack."""

import re
from pathlib import Path

from site_builder.document.book import Colours
from site_builder.files.engine import own_or_engine
from site_builder.output.font_faces import MATHS_FACES, face_rule
from site_builder.output.light_theme import style_of_drawings

OWN = Path(__file__).with_name("epub.css")
FACE = re.compile(r"^@font-face \{\n(?:(?!\}).*\n)*?  src: url\((?:.*\n)*?\}\n", re.MULTILINE)
FAMILIES = {"--serif": '"Book Serif", serif', "--sans": '"Book Sans", sans-serif'}


def book_style(root: Path, colours: Colours) -> str:
    """``root`` is the book's folder, ``colours`` are its own. Variables are resolved, to the light
    theme."""
    fonts = own_or_engine(root, "static/css/fonts.css").read_text(encoding="utf-8")
    faces = "".join((*FACE.findall(fonts), *map(face_rule, MATHS_FACES)))
    own = OWN.read_text(encoding="utf-8")
    return faces + style_of_drawings(root, own, FAMILIES, colours)
