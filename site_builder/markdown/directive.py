"""A directive as one value: how it is written, what reads it and what shows it.

The parser, the checks, the table of templates and the author's guide all follow from these
values; ``directives/__init__.py`` lists them.
"""

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from markdown_it.token import Token

from site_builder.document.places import Plain
from site_builder.markdown.parse_context import ParseContext


@dataclass(frozen=True, slots=True)
class OptionValue:
    """What an author wrote in an option line."""

    text: str
    line: int


@dataclass(frozen=True, slots=True)
class DirectiveCall:
    """A directive as an author wrote it; its reader finds only legal options here."""

    name: str
    argument: str
    options: Mapping[str, OptionValue]
    line: int
    """Line of the opening fence, counted from 1."""

    def text(self, option: str) -> str:
        """The option's value; its default, or nothing, where the author gave none."""
        return self.options[option].text if option in self.options else ""

    def line_of(self, option: str) -> int:
        """Line of the option, or of the fence where the author gave none."""
        return self.options[option].line if option in self.options else self.line


@dataclass(frozen=True, slots=True)
class FileKind:
    """Files of ``content/`` that a directive may name."""

    name: str
    """What one is called: ``picture file``."""
    suffixes: tuple[str, ...] = ()
    """How their names end; any way where there are none."""


@dataclass(frozen=True, slots=True)
class Argument:
    """The words behind the name of a directive."""

    form: str
    """Form that the author's guide shows: ``scene-id``."""
    lacks: str = ""
    """The message where it is missing: ``names no scene``. Empty: it is optional."""
    expected: Collection[str] | None = None
    """All that it may be; None: any text, for the reader to judge."""
    kind: str = ""
    """The name of what ``expected`` lists: ``table of extremes``."""
    file: FileKind | None = None
    """The file of ``content/`` that it names."""


@dataclass(frozen=True, slots=True, kw_only=True)
class OptionLine:
    """A line ``:name: value`` below the opening fence."""

    name: str
    doc: str
    """What an author gives with it: ``what the picture shows``."""
    expected: tuple[str, ...] = ()
    """All that it may be, its default first; any text where there are none."""
    required: bool = False
    file: FileKind | None = None
    """The file of ``content/`` that it names."""
    form: str = ""
    """Regular expression of all that it may be, which ``doc`` describes."""


@dataclass(frozen=True, slots=True)
class Body[B]:
    """What may stand between the fences."""

    doc: str
    """In the author's guide: ``a caption``."""
    read: Callable[[DirectiveCall, Sequence[Token], ParseContext], B]
    """Its tokens as the directive's reader gets them; reports what may not stand there."""
    nests: bool = False
    """Whether it is made of blocks, which the template gets as ``inside``."""


@dataclass(frozen=True, slots=True)
class Numbered:
    """How things of a directive are counted in their chapter, and what they are cited by."""

    kind: str
    """What they are called: ``Figure``. Directives of one kind share a count."""
    id: Callable[[DirectiveCall], str]
    """Element id, where the author gives no ``:label:``."""
    again: bool = False
    """Whether a page may show the same twice; the id of the second then ends in ``-2``."""
    label: str = ""
    """What each is called before its number, where that is no word of the language's."""


LABEL = OptionLine(name="label", doc="what it is cited by")


@dataclass(frozen=True, slots=True, kw_only=True)
class Directive[B]:
    """One directive, ``:::{name} argument``."""

    name: str
    doc: str
    """What it makes, in the author's guide: ``a live figure``."""
    argument: Argument | None
    body: Body[B]
    read: Callable[[DirectiveCall, B, ParseContext], object | None]
    """What the template shows; None, and a report, where mistakes leave nothing to show. Raises
    `CodeError`, which is reported at the opening fence."""
    template: str
    """Its file below ``templates/blocks/``, without ``.html``."""
    options: tuple[OptionLine, ...] = ()
    numbered: Numbered | None = None
    """None where it carries no number."""
    plain: Callable[[Any], Plain] | None = None
    """Gives its plain text for the search; None where it is not searched."""
    more_options: str = ""
    """Options that only the reader can judge, in words: ``the controls of the scene``."""
