"""``{figure} images/file.svg``: a picture from ``content/``, with ``:alt:`` and a caption."""

from dataclasses import dataclass
from pathlib import Path, PurePosixPath

from site_builder.diagnostics import unknown
from site_builder.kept.keeper import reads_file
from site_builder.markdown.bodies import CAPTION
from site_builder.markdown.directive import LABEL, Argument, Directive, Numbered, OptionLine, Use
from site_builder.markdown.reading import Reading

SUFFIXES = (".svg", ".png", ".jpg", ".jpeg", ".webp")


@dataclass(frozen=True, slots=True)
class Figure:
    """A picture file with a caption."""

    file: str
    """Path below ``content/``."""
    alt: str
    caption_html: str


def read_figure(use: Use, caption_html: str, reading: Reading) -> Figure | None:
    fault = _fault_of(use.argument, reading.root / "content")
    if fault:
        reading.problem(use.line, fault)
        return None
    return Figure(use.argument, use.text("alt"), caption_html)


def _fault_of(file: str, content: Path) -> str:
    """What is wrong with the picture ``file``; nothing where it can be shown."""
    path = PurePosixPath(file)
    inside = file and not path.is_absolute() and ".." not in path.parts
    if inside:
        reads_file(content / file)
    if not inside or not (content / file).is_file():
        pictures = (
            picture.relative_to(content).as_posix()
            for picture in sorted(content.rglob("*"))
            if picture.suffix in SUFFIXES
        )
        return unknown("picture file", file, pictures)
    if not file.endswith(SUFFIXES):
        return f"picture file {file!r}; legal: a name that ends in {', '.join(SUFFIXES)}"
    return ""


FIGURE = Directive(
    name="figure",
    says="a picture of yours",
    argument=Argument("images/file.svg", lacks="names no picture"),
    options=(OptionLine("alt", says="what the picture shows", required=True), LABEL),
    body=CAPTION,
    read=read_figure,
    template="figure",
    numbered=Numbered(
        "Figure", lambda use: f"figure-{PurePosixPath(use.argument).stem}", again=True
    ),
)
