"""``{figure} images/file.svg``: a picture from ``content/``, with ``:alt:`` and a caption."""

from collections.abc import Sequence
from pathlib import PurePosixPath

from markdown_it.token import Token

from site_builder.book import Illustration
from site_builder.diagnostics import unknown
from site_builder.markdown.blocks import check_options, read_html
from site_builder.markdown.fences import Directive
from site_builder.markdown.reading import Reading

SUFFIXES = (".svg", ".png", ".jpg", ".jpeg", ".webp")


def read_illustration(
    directive: Directive, body: Sequence[Token], reading: Reading
) -> Illustration | None:
    check_options(directive, ("alt",), reading)
    caption_html = read_html(directive, body, reading)
    alt = directive.options.get("alt")
    if alt is None or not alt.text:
        reading.problem(directive.line, "{figure} has no ':alt:'; legal: what the picture shows")
    content = reading.root / "content"
    file = directive.argument
    inside = (
        file and not PurePosixPath(file).is_absolute() and ".." not in PurePosixPath(file).parts
    )
    if inside and (content / file).is_file() and not file.endswith(SUFFIXES):
        message = f"picture file {file!r}; legal: a name that ends in {', '.join(SUFFIXES)}"
        reading.problem(directive.line, message)
        return None
    if not inside or not (content / file).is_file():
        pictures = (
            path.relative_to(content).as_posix()
            for path in sorted(content.rglob("*"))
            if path.suffix in SUFFIXES
        )
        reading.problem(directive.line, unknown("picture file", file, pictures))
        return None
    return Illustration(file, alt.text if alt else "", caption_html)
