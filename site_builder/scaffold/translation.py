"""A chapter to be translated: the original, its sections under ids that translated words keep."""

from itertools import pairwise
from pathlib import Path

from site_builder.diagnostics.diagnostic import Diagnostics
from site_builder.document.places import chapter_id
from site_builder.languages.words import languages
from site_builder.markdown.headings import slug
from site_builder.markdown.parser import make_parser
from site_builder.markdown.text.tokens import plain_text
from site_builder.scaffold.files import write_new
from site_builder.scaffold.names import ScaffoldError
from site_builder.settings.reading import read_settings


def translation(root: Path, text: str) -> tuple[dict[str, str], str]:
    """``de/falling-ball``: language and chapter."""
    language, _, name = text.partition("/")
    files = {chapter_id(file.name): file for file in sorted((root / "content").glob("*.md"))}
    own = read_settings(root, Diagnostics())[0].language
    others = [tag for tag in languages() if tag != own]
    if language not in others or name not in files:
        forms = f"{' or '.join(others)}, a slash, and one of {', '.join(files)}"
        raise ScaffoldError(f"translation {text!r}; legal: {forms}")
    path = f"content/{language}/{files[name].name}"
    write_new(root, {path: with_ids(files[name].read_text(encoding="utf-8"))})
    return {path: ""}, "translate it; what it must keep, python -m site_builder check tells"


def with_ids(markdown: str) -> str:
    """The chapter with the id of each section behind its heading."""
    lines, tokens = markdown.split("\n"), make_parser().parse(markdown)
    for opening, inline in pairwise(tokens):
        if opening.type == "heading_open" and opening.map and "id" not in opening.meta:
            lines[opening.map[0]] += f" {{#{slug(plain_text(inline))}}}"
    return "\n".join(lines)
