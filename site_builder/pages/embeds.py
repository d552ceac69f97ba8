"""The page of each figure alone, for frames in other pages.

A figure has the page ``embed/<chapter>/<id of the figure>/``, as the same scene may stand in
several chapters with other settings. There a part leads itself, as no other figure is with it.
"""

from collections.abc import Iterator, Sequence
from dataclasses import replace

from markdown_it.token import Token

from site_builder.document.blocks import Block, Simulation, walk
from site_builder.document.book import Chapter
from site_builder.document.places import Passage

EMBED_FOLDER = "embed/"
ROOT_OF_EMBED = "../../../"
"""The root of the site, from such a page."""


def embed_address(chapter: Chapter, figure: str) -> str:
    """Address of the page of a figure, by its element id, from the site's root."""
    return f"{EMBED_FOLDER}{chapter.url}{figure}/"


def embeds(chapter: Chapter) -> Iterator[tuple[str, Block]]:
    """Path and figure of each, the links of its words leading to the chapter and from there."""
    for block in walk(chapter.body):
        if isinstance(figure := block.content, Simulation):
            words = (
                Passage(_from_outside(part.tokens, f"{ROOT_OF_EMBED}{chapter.url}", figure.id))
                for part in (figure.caption, figure.about)
            )
            caption, about = words
            content = replace(figure, caption=caption, about=about, leader="", small=False)
            yield f"{embed_address(chapter, figure.id)}index.html", replace(block, content=content)


def _from_outside(tokens: Sequence[Token], chapter: str, figure: str) -> tuple[Token, ...]:
    def moved(token: Token) -> Token:
        attrs = dict(token.attrs)
        if token.type == "link_open":
            address = str(attrs["href"])
            if address.startswith((".", "#", "?")):
                attrs["href"] = chapter + address
            attrs["target"] = "_blank"
            attrs.pop("aria-describedby", None)  # the definition of a term, which the chapter has
            if attrs.get("data-figure", figure) != figure:
                del attrs["class"]  # it sets a figure that is not here
        children = token.children and list(_from_outside(token.children, chapter, figure))
        return replace(token, attrs=attrs, children=children)

    return tuple(map(moved, tokens))
