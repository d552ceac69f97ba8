"""Figures: scenes as cells, drawings and photographs as pictures of the text."""

import json
from collections.abc import Iterator, Mapping
from dataclasses import replace
from pathlib import PurePosixPath
from urllib.parse import quote

from site_builder.document.blocks import Block, Simulation
from site_builder.document.passage import Passage
from site_builder.editions.notebooks.cells import Code, Part, Text
from site_builder.editions.notebooks.page import Page, folded, named
from site_builder.figures.frames import pixels
from site_builder.markdown.directives.audio import Audio
from site_builder.markdown.directives.figure import Figure
from site_builder.markdown.directives.illustration import Drawn
from site_builder.markdown.directives.video import Video
from site_builder.render.markdown import escaped, link

LONGEST = 80
"""Characters of a call on one line."""


def simulation(figure: Simulation, block: Block, page: Page) -> Iterator[Part]:
    """The cell, then its caption."""
    still = page.still(figure)
    panels = [
        replace(panel, raster=pixels(page.checked.pictures[picture.file]))
        if (picture := still.pictures.get(panel.name))
        else panel
        for panel in still.frame.panels
    ]
    yield Code(call(figure), page.picture(panels), still.frame.description)
    about = page.markdown(figure.about)
    yield Text(f"{named(block.target)}{page.markdown(figure.caption)}\n\n{about}".strip())


def call(figure: Simulation) -> str:
    """``figure("lens-distortion", k1=-0.2)``."""
    values: Mapping[str, object] = figure.values
    if figure.tier != figure.scene.default_tier:
        values = {"tier": figure.tier, **values}
    given = [json.dumps(figure.scene.id), *(f"{k}={_written(v)}" for k, v in values.items())]
    line = f"figure({', '.join(given)})"
    if len(line) <= LONGEST:
        return line
    return "figure(\n" + "".join(f"    {each},\n" for each in given) + ")"


def _written(value: object) -> str:
    return json.dumps(value, ensure_ascii=False) if isinstance(value, str) else repr(value)


def illustration(drawn: Drawn, block: Block, page: Page) -> Iterator[Part]:
    name = f"{block.target.id if block.target else 'illustration'}.png"
    picture = page.picture(drawn.illustration.panels)
    yield _pictured(block, page, drawn.description, {name: picture}, drawn.caption)


def figure(shown: Figure, block: Block, page: Page) -> Iterator[Part]:
    yield _pictured(block, page, shown.alt, _file(shown.file, page), shown.caption)


def video(film: Video, block: Block, page: Page) -> Iterator[Part]:
    """Its still, and a link to the film, which lies beside the notebook."""
    yield _pictured(block, page, film.alt, _file(film.poster, page), film.caption)
    yield Text(link(escaped(film.alt), f"content/{film.file}"))


def audio(recording: Audio, block: Block, page: Page) -> Iterator[Part]:
    """The recording lies beside the notebook; its transcript is folded."""
    licence = f" ({escaped(recording.licence)})" if recording.licence else ""
    parts = (
        f'<audio controls src="content/{quote(recording.file)}"></audio>',
        f"{named(block.target)}{escaped(recording.title)}{licence}",
        folded(page.words("figure.transcript"), page.markdown(recording.transcript)),
    )
    yield Text("\n\n".join(parts))


def _pictured(
    block: Block, page: Page, alt: str, picture: Mapping[str, bytes], caption: Passage
) -> Text:
    (name,) = picture
    shown = f"![{escaped(' '.join(alt.split()))}](attachment:{name})"
    return Text(f"{shown}\n\n{named(block.target)}{page.markdown(caption)}", picture)


def _file(path: str, page: Page) -> Mapping[str, bytes]:
    """A picture of the author's, by its name."""
    name = PurePosixPath(path).name.replace(" ", "-")
    return {name: (page.content / path).read_bytes()}
