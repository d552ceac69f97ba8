"""What a notebook is made of, before it is a file: words with their pictures, and code."""

from base64 import b64encode
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from itertools import groupby
from mimetypes import guess_type
from types import MappingProxyType
from typing import Any

from nbformat import v4

NO_PICTURES: Mapping[str, bytes] = MappingProxyType({})


@dataclass(frozen=True, slots=True)
class Text:
    """Markdown; it shows ``pictures``, files by name, as ``attachment:NAME``."""

    markdown: str
    pictures: Mapping[str, bytes] = field(default=NO_PICTURES)


@dataclass(frozen=True, slots=True)
class Code:
    """Python, and what it showed when the book was built."""

    source: str
    picture: bytes = b""
    """PNG; nothing where it shows none."""
    words: str = ""
    """The same for readers who cannot see it."""


type Part = Text | Code


def wrapped(parts: Iterable[Part], wrap: Callable[[str], str]) -> Iterator[Part]:
    """``parts`` with ``wrap`` around the words; code stays, as it cannot stand inside of words."""
    for is_text, run in groupby(parts, key=lambda part: isinstance(part, Text)):
        if is_text:
            joined = join(part for part in run if isinstance(part, Text))
            yield Text(wrap(joined.markdown), joined.pictures)
        else:
            yield from run


def join(texts: Iterable[Text]) -> Text:
    each = [*texts]
    pictures = {name: file for text in each for name, file in text.pictures.items()}
    return Text("\n\n".join(text.markdown for text in each), pictures)


def cell_of(part: Part, id: str) -> Any:
    """The cell as nbformat has it."""
    if isinstance(part, Text):
        attached = {
            name: {guess_type(name)[0]: b64encode(file).decode()}
            for name, file in part.pictures.items()
        }
        more = {"attachments": attached} if attached else {}
        return v4.new_markdown_cell(part.markdown, id=id, **more)
    data = {"image/png": b64encode(part.picture).decode(), "text/plain": part.words}
    outputs = [v4.new_output("display_data", data)] if part.picture else []
    return v4.new_code_cell(part.source, id=id, outputs=outputs)
