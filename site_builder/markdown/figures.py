"""Where the figures of a page stand: looked up before its words are, which speak of them."""

from collections.abc import Sequence

from markdown_it.token import Token

from site_builder.markdown.directive import Use
from site_builder.markdown.directives.simulation import SIMULATION
from site_builder.markdown.reading import Place, Reading


def place_figures(tokens: Sequence[Token], reading: Reading) -> None:
    """Give each figure of the page its id; whether its scene is known is for its reader to say."""
    for token in tokens:
        if token.type == "directive_open" and token.meta["directive"] is SIMULATION:
            use: Use = token.meta["use"]
            chosen = reading.free_id(f"figure-{use.argument}", use.line)
            first, last = token.map or (0, 0)
            reading.figures.append(Place(chosen, use.argument, (first + 1, last + 1)))
