"""The parts of a page. Those that other parts of the builder use are here, simulations and quoted
modules; the content of every other directive is a class in its own file.
"""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from simulations.engine.scene import Scene
from site_builder.document.passage import Passage
from site_builder.document.places import Target


@dataclass(frozen=True, slots=True)
class Block:
    """A part of a page: a run of plain Markdown, or one directive."""

    template: str
    """Its file below ``templates/blocks/``, without ``.html``."""
    content: object
    """What the template shows; most directives have a class of their own for it."""
    inside: "tuple[Block, ...]" = ()
    """The blocks in it, as a callout has them."""
    target: "Target | None" = None
    """Its number and where a link to it leads; None where it is not numbered."""


def walk(blocks: Iterable[Block]) -> Iterator[Block]:
    """All of them, each before those inside it."""
    for block in blocks:
        yield block
        yield from walk(block.inside)


def contents[T](blocks: Iterable[Block], kind: type[T]) -> Iterator[T]:
    """What the blocks of one kind show, those inside other blocks included."""
    return (block.content for block in walk(blocks) if isinstance(block.content, kind))


NO_WORDS = Passage()


@dataclass(frozen=True, slots=True)
class Prose:
    """Paragraphs, lists, headings, formulae: anything that plain Markdown makes."""

    words: Passage


@dataclass(frozen=True, slots=True)
class Simulation:
    """A figure that comes alive in the page."""

    scene: Scene[Any]
    id: str
    """Element id: ``figure-`` and the scene's id, numbered where a page shows a scene twice."""
    values: Mapping[str, object]
    """Starting values that differ from the scene's defaults, already checked."""
    tier: str
    """Starting accuracy; the scene's default where the author named none."""
    caption: Passage
    """What to try."""
    path: str
    line: int
    about: Passage = NO_WORDS
    """What it shows, in a fold."""
    in_sight: tuple[str, ...] = ()
    """Names of the controls and readouts that are not folded; none where the first are shown."""
    yours: bool = False
    """Whether the reader's photographs go into the figure, an instrument."""


@dataclass(frozen=True, slots=True)
class Source:
    """The real source of a function of the book's own code."""

    module: str
    name: str
    path: str
    """File of the module, relative to the root of the project."""
    first_line: int
    code: str
    docstring: tuple[int, int]
    """Its lines in the code, from the first to before the last; equal where there is none."""
    caption: Passage
