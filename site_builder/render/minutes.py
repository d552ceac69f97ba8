"""How long a part of the book takes: its words, formulae, figures and questions."""

from collections.abc import Iterable, Iterator

from markdown_it.token import Token

from site_builder.document.blocks import Block, Deeper, Prose, Quiz, Reveal, Simulation
from site_builder.document.places import Passage
from site_builder.markdown.questions.kinds import kind_of
from site_builder.render.words import PLAIN, plain_words

WORDS_A_MINUTE = 180
"""Of a text that is read with care; others are read at some 240."""
MINUTES = {"predict": 1.0, "quiz": 1.5, "simulation": 2.0, "illustration": 0.5, "figure": 0.5}
"""By the template of a block, its words included. An answer counts with its prediction."""
SEEN_BEFORE = 1.0
"""A figure of a scene that stands above as well, whose controls are known."""
FORMULAE = {"math_inline": 0.04, "math_block": 0.25, "math_block_label": 0.25}
"""What a formula takes beside its words: two seconds in a line, fifteen by itself."""


def reading_minutes(blocks: Iterable[Block]) -> int:
    """Minutes for all of them but programs, each of which takes some eight more."""
    shown = tuple(_shown(blocks))
    figures = [block.content for block in shown if isinstance(block.content, Simulation)]
    scenes = [figure.scene.id for figure in figures if not figure.leader]
    again = (MINUTES["simulation"] - SEEN_BEFORE) * (len(scenes) - len(set(scenes)))
    return max(1, round(sum(map(_minutes, shown)) - again))


def count_programs(blocks: Iterable[Block]) -> int:
    """Programs that the reader is asked to write."""
    return sum(_is_program(block) for block in _shown(blocks))


def _shown(blocks: Iterable[Block]) -> Iterator[Block]:
    """All of them and those inside, without what is hidden until a guess."""
    for block in blocks:
        if not isinstance(block.content, Reveal):
            yield block
            yield from _shown(block.inside)


def _minutes(block: Block) -> float:
    content = block.content
    if _is_program(block):
        return 0.0
    if isinstance(content, Simulation) and content.leader:
        return MINUTES["illustration"]
    if block.template in MINUTES:
        return MINUTES[block.template]
    if isinstance(content, Prose):
        return _words(content.words)
    if isinstance(content, Deeper):
        return _words(content.heading.words)
    plain = PLAIN[block.template]
    return sum(map(_words, plain(content).words)) if plain else 0.0


def _is_program(block: Block) -> bool:
    return isinstance(block.content, Quiz) and kind_of(block.content).is_program


def _words(words: str | Passage) -> float:
    if isinstance(words, str):
        return len(words.split()) / WORDS_A_MINUTE
    return len(plain_words(words).split()) / WORDS_A_MINUTE + _formulae(words.tokens)


def _formulae(tokens: Iterable[Token]) -> float:
    return sum(FORMULAE.get(each.type, 0.0) + _formulae(each.children or ()) for each in tokens)
