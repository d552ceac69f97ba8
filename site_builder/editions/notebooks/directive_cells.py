"""Notebook cells for each directive."""

import json
import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import replace
from functools import partial
from itertools import pairwise
from pathlib import PurePosixPath
from string import ascii_uppercase
from typing import Any

from simulations.engine.frame import Panel
from site_builder.document.blocks import (
    OTHERWISE,
    Block,
    Deeper,
    Option,
    Prediction,
    Prose,
    Question,
    Quiz,
    Reveal,
    Simulation,
    Source,
    contents,
    walk,
)
from site_builder.document.places import Passage
from site_builder.editions.notebooks.cells import (
    ChapterPage,
    Code,
    Part,
    Text,
    folded,
    named,
    wrapped,
)
from site_builder.editions.notebooks.tables import extremes, ladder, ladder_table, stage_costs
from site_builder.figures.frames import pixels
from site_builder.markdown.directives.boxes import Box
from site_builder.markdown.directives.pictures import DrawnIllustration, PictureFile
from site_builder.markdown.questions.kinds import kind_of
from site_builder.pages.environment import render_template
from site_builder.render.markdown import code, escaped, fenced, link, quoted

LONGEST = 80
"""Characters of a call on one line."""


def simulation(figure: Simulation, block: Block, page: ChapterPage) -> Iterator[Part]:
    """The cell, then its caption."""
    initial_frame = page.initial_frame(figure)
    panels = [
        replace(panel, raster=pixels(page.checked.pictures[picture.file]))
        if (picture := initial_frame.pictures.get(panel.name))
        else panel
        for panel in initial_frame.frame.panels
    ]
    yield Code(call(figure), page.picture(panels), initial_frame.frame.description)
    about = page.markdown(figure.about)
    yield Text(f"{named(block.target)}{page.markdown(figure.caption)}\n\n{about}".strip())


def call(figure: Simulation) -> str:
    """``figure("lens-distortion", k1=-0.2)``."""
    values: Mapping[str, object] = figure.values
    if figure.tier != figure.scene.accuracy.default:
        values = {"tier": figure.tier, **values}
    if figure.panels:
        values = {"panels": list(figure.panels), **values}
    given = [json.dumps(figure.scene.id), *(f"{k}={_python_literal(v)}" for k, v in values.items())]
    line = f"figure({', '.join(given)})"
    if len(line) <= LONGEST:
        return line
    return "figure(\n" + "".join(f"    {each},\n" for each in given) + ")"


def _python_literal(value: object) -> str:
    is_json = isinstance(value, str | list)
    return json.dumps(value, ensure_ascii=False) if is_json else repr(value)


def illustration(drawn: DrawnIllustration, block: Block, page: ChapterPage) -> Iterator[Part]:
    name = f"{block.target.id if block.target else 'illustration'}.png"
    picture = page.picture(drawn.illustration.panels)
    words = Passage((*drawn.caption.tokens, *drawn.sentences.tokens))
    yield _picture_part(block, page, drawn.description, {name: picture}, words)


def figure(shown: PictureFile, block: Block, page: ChapterPage) -> Iterator[Part]:
    yield _picture_part(block, page, shown.alt, _file(shown.file, page), shown.caption)


def _picture_part(
    block: Block, page: ChapterPage, alt: str, picture: Mapping[str, bytes], caption: Passage
) -> Text:
    (name,) = picture
    shown = f"![{escaped(' '.join(alt.split()))}](attachment:{name})"
    return Text(f"{shown}\n\n{named(block.target)}{page.markdown(caption)}", picture)


def _file(path: str, page: ChapterPage) -> Mapping[str, bytes]:
    """A picture of the author's, by its name."""
    name = PurePosixPath(path).name.replace(" ", "-")
    return {name: (page.content / path).read_bytes()}


DRAWING = re.compile(
    r'<svg class="overlay[^"]*" viewBox="0 0 ([\d.]+) ([\d.]+)"[^>]*>(.*?)</svg>', re.DOTALL
)


def quiz(question: Quiz, block: Block, page: ChapterPage) -> Iterator[Part]:
    asked = (f"{named(block.target)}{page.markdown(question.prompt)}", _option_list(question, page))
    answers = folded(page.words("question.answer"), "\n".join(_answers(question, page)))
    if cells := kind_of(question).cells(question):
        yield Text("\n\n".join(filter(None, asked)))
        yield from (Code(cell, may_fail=cell != cells[0]) for cell in cells)
        yield Text(answers)
    else:
        yield Text("\n\n".join((*filter(None, asked), answers)))


def predict(question: Prediction, block: Block, page: ChapterPage) -> Iterator[Part]:
    """What is right begins the `answer`; where none follows, it stands here."""
    title = f"{named(block.target)}{escaped(page.words('predict.title'))}"
    asked = (title, page.markdown(question.prompt), _option_list(question, page))
    yield Text("\n\n".join(filter(None, asked)))
    answers = contents(page.chapter.body, Reveal)
    if question.id not in (each.prediction for each in answers):
        yield from wrapped(
            right_answer(question, page), partial(folded, page.words("question.answer"))
        )


def right_answer(question: Prediction, page: ChapterPage) -> Iterator[Text]:
    """The right option, number or curve."""
    yield from (Text(_answer(option, page)) for option in question.options if option.correct)
    if drawing := _drawing(question, page):
        name = f"{question.id}.png"
        shown = f"![{escaped(page.words('predict.computed_curve'))}](attachment:{name})"
        yield Text(shown, {name: page.picture([drawing])})


def _option_list(question: Question, page: ChapterPage) -> str:
    """What can be chosen, or ordered."""
    lines = zip(ascii_uppercase, kind_of(question).offered(question), strict=False)
    return "\n".join(f"- {letter}: {page.markdown(option.words)}" for letter, option in lines)


def _answers(question: Quiz, page: ChapterPage) -> Iterator[str]:
    """A line for each answer, with its explanation."""
    kind = kind_of(question)
    if kind.cells(question):
        yield from (page.markdown(option.words) for option in question.options if option.correct)
        return
    if kind.needs_page:  # its other answers are settings that only a page can judge
        yield from (f"- {page.markdown(o.explanation)}" for o in question.options if o.correct)
        if solution := kind.view(question, page.chapter.simulations):
            yield f"- {escaped(page.words('edition.one_way', settings=solution))}"
        return
    for place, option in enumerate(question.options, 1):
        verdict = page.words("question.right" if option.correct else "question.wrong")
        yield f"{f'{place}.' if kind.numbered else f'- **{verdict}:**'} {_answer(option, page)}"


def _answer(option: Option, page: ChapterPage) -> str:
    otherwise = page.words("question.otherwise") if option.text == OTHERWISE else ""
    said = otherwise or page.markdown(option.words)
    return "  \n  ".join(filter(None, (said, page.markdown(option.explanation))))


def _drawing(question: Prediction, page: ChapterPage) -> Panel | None:
    """Axes and the true curve of what is to be drawn; None where nothing is."""
    template = "editions/notebook-drawing.html"
    if not kind_of(question).drawn:
        return None
    html = render_template(template, page.book, question=question, chapter=page.chapter)
    found = DRAWING.search(html)
    assert found  # the template has one
    width, height, marks = found.groups()
    return Panel("field", "", float(width), float(height), overlay=marks)


def parts_of(blocks: Iterable[Block], page: ChapterPage) -> Iterator[Part]:
    """All cells of ``blocks``, in order; directives of which nothing is left have none."""
    for block in blocks:
        for part in PARTS[block.template](block.content, block, page):
            if isinstance(part, Code) or part.markdown:
                yield part


def prose(content: Prose, _block: Block, page: ChapterPage) -> Iterator[Part]:
    """A cell for each section, which begins with its heading."""
    tokens = content.words.tokens
    starts = [at for at, token in enumerate(tokens) if token.type == "heading_open"]
    for start, end in pairwise((0, *filter(None, starts), len(tokens))):
        yield Text(page.markdown(Passage(tokens[start:end])))


def deeper(content: Deeper, block: Block, page: ChapterPage) -> Iterator[Part]:
    """As any section, with a mark behind its heading."""
    heading, mark = content.heading, page.words("chapter.deeper")
    yield Text(f"{'#' * heading.level} {page.markdown(heading.words)} ({escaped(mark)})")
    yield from parts_of(block.inside, page)


def callout(content: Box, block: Block, page: ChapterPage) -> Iterator[Part]:
    title = page.markdown(content.title)
    return _quoted(f"{named(block.target)}{title and f'**{title}**'}".rstrip(), block, page)


def example(content: Box, block: Block, page: ChapterPage) -> Iterator[Part]:
    return _quoted(f"{named(block.target)}{page.markdown(content.title)}", block, page)


def _quoted(title: str, block: Block, page: ChapterPage) -> Iterator[Part]:
    return wrapped([Text(title), *parts_of(block.inside, page)], quoted)


def answer(content: Reveal, block: Block, page: ChapterPage) -> Iterator[Part]:
    """Named after its prediction, as cells may lie between the two; what is right comes first."""
    asked, name = _prediction(content.prediction, page)
    summary = f"{name}: {page.words('question.answer')}"
    parts = (*right_answer(asked, page), *parts_of(block.inside, page))
    return wrapped(parts, partial(folded, summary))


def _prediction(id: str, page: ChapterPage) -> tuple[Prediction, str]:
    """The one of that id, and its name."""
    for block in walk(page.chapter.body):
        if isinstance(block.content, Prediction) and block.content.id == id and block.target:
            return block.content, block.target.name
    raise LookupError(f"no prediction {id!r}")  # which a check reports


def source(content: Source, _block: Block, page: ChapterPage) -> Iterator[Part]:
    """The code to read, and a cell that imports it to be tried."""
    address = page.address(f"../source/{content.path.removesuffix('.py')}/#L{content.first_line}")
    where, tried = link(code(content.path), address), f"import {content.module}"
    if content.name:
        where = f"{code(content.name)} {page.words('listing.in_file')} {where}"
        tried = f"from {content.module} import {content.name.partition('.')[0]}"
    caption = page.markdown(content.caption)
    yield Text("\n\n".join(filter(None, (where, caption, fenced(content.code, "python")))))
    yield Code(tried)


def table(content: Box, block: Block, page: ChapterPage) -> Iterator[Part]:
    caption = f"{named(block.target)}{page.markdown(content.title)}"
    yield Text(f"{caption}\n\n{page.markdown(content.table)}")


def data_sheet(content: Prose, _block: Block, page: ChapterPage) -> Iterator[Part]:
    """Its words alone: a notebook measures no photographs."""
    yield Text(page.markdown(content.words))


type Maker = Callable[[Any, Block, ChapterPage], Iterable[Part]]
PARTS: Mapping[str, Maker] = {
    "answer": answer,
    "callout": callout,
    "data-sheet": data_sheet,
    "deeper": deeper,
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
}
"""Blocks by the name of the template, of which each directive has one."""
