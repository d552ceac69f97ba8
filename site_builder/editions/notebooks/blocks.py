"""The cells of each directive."""

from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import partial
from itertools import pairwise
from typing import Any

from site_builder.document.blocks import Block, Prose, Source, walk
from site_builder.document.passage import Passage
from site_builder.document.questions import Prediction, Reveal
from site_builder.editions.notebooks.cells import Code, Part, Text, wrapped
from site_builder.editions.notebooks.figures import audio, figure, illustration, simulation, video
from site_builder.editions.notebooks.page import Page, folded, named
from site_builder.editions.notebooks.questions import predict, quiz, right
from site_builder.editions.notebooks.tables import extremes, ladder, ladder_table, stage_costs
from site_builder.markdown.directives.callout import Callout
from site_builder.markdown.directives.data_sheet import DataSheet
from site_builder.markdown.directives.download import Download
from site_builder.markdown.directives.example import Example
from site_builder.markdown.directives.table import Table
from site_builder.render.markdown import code, escaped, fenced, link, quoted


def parts_of(blocks: Iterable[Block], page: Page) -> Iterator[Part]:
    """All cells of ``blocks``, in order; directives of which nothing is left have none."""
    for block in blocks:
        for part in PARTS[block.template](block.content, block, page):
            if isinstance(part, Code) or part.markdown:
                yield part


def prose(content: Prose, _block: Block, page: Page) -> Iterator[Part]:
    """A cell for each section, which begins with its heading."""
    tokens = content.words.tokens
    starts = [at for at, token in enumerate(tokens) if token.type == "heading_open"]
    for start, end in pairwise((0, *filter(None, starts), len(tokens))):
        yield Text(page.markdown(Passage(tokens[start:end])))


def callout(content: Callout, block: Block, page: Page) -> Iterator[Part]:
    return _quoted(f"**{page.markdown(content.title)}**", block, page)


def example(content: Example, block: Block, page: Page) -> Iterator[Part]:
    return _quoted(f"{named(block.target)}{page.markdown(content.title)}", block, page)


def _quoted(title: str, block: Block, page: Page) -> Iterator[Part]:
    return wrapped([Text(title), *parts_of(block.inside, page)], quoted)


def answer(content: Reveal, block: Block, page: Page) -> Iterator[Part]:
    """Named after its prediction, as cells may lie between the two; what is right comes first."""
    asked, name = _prediction(content.prediction, page)
    summary = f"{name}: {page.words('question.answer')}"
    parts = (*right(asked, page), *parts_of(block.inside, page))
    return wrapped(parts, partial(folded, summary))


def _prediction(id: str, page: Page) -> tuple[Prediction, str]:
    """The one of that id, and its name."""
    for block in walk(page.chapter.body):
        if isinstance(block.content, Prediction) and block.content.id == id and block.target:
            return block.content, block.target.name
    raise LookupError(f"no prediction {id!r}")  # which a check reports


def source(content: Source, _block: Block, page: Page) -> Iterator[Part]:
    """The code to read, and a cell that imports it to be tried."""
    address = page.address(f"../source/{content.path.removesuffix('.py')}/#L{content.first_line}")
    where = (
        f"{code(content.name)} {page.words('listing.in_file')} {link(code(content.path), address)}"
    )
    caption = page.markdown(content.caption)
    yield Text("\n\n".join(filter(None, (where, caption, fenced(content.code, "python")))))
    yield Code(f"from {content.module} import {content.name.partition('.')[0]}")


def table(content: Table, block: Block, page: Page) -> Iterator[Part]:
    caption = f"{named(block.target)}{page.markdown(content.caption)}"
    yield Text(f"{caption}\n\n{page.markdown(content.table)}")


def download(content: Download, _block: Block, page: Page) -> Iterator[Part]:
    """The file lies beside the notebook."""
    given = f"{link(escaped(content.name), f'content/{content.file}')} ({content.size})"
    yield Text(f"{given}\n\n{page.markdown(content.words)}".strip())


def data_sheet(content: DataSheet, _block: Block, page: Page) -> Iterator[Part]:
    """Its words alone: a notebook measures no photographs."""
    yield Text(page.markdown(content.words))


type Maker = Callable[[Any, Block, Page], Iterable[Part]]
PARTS: Mapping[str, Maker] = {
    "answer": answer,
    "audio": audio,
    "callout": callout,
    "data-sheet": data_sheet,
    "download": download,
    "example": example,
    "extremes": extremes,
    "figure": figure,
    "illustration": illustration,
    "ladder": ladder,
    "ladder-table": ladder_table,
    "predict": predict,
    "prose": prose,
    "quiz": quiz,
    "simulation": simulation,
    "source": source,
    "stage-costs": stage_costs,
    "table": table,
    "video": video,
}
"""By the names of templates, of which each directive has one."""
