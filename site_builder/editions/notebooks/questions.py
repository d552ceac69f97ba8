"""Questions: what is asked, and the answers in a fold."""

import re
from collections.abc import Iterator
from functools import partial
from string import ascii_uppercase

from simulations.engine.frame import Panel
from site_builder.document.blocks import Block, contents
from site_builder.document.questions import OTHERWISE, Option, Prediction, Question, Quiz, Reveal
from site_builder.editions.notebooks.cells import Part, Text, wrapped
from site_builder.editions.notebooks.page import Page, folded, named
from site_builder.markdown.questions.kinds import kind_of
from site_builder.pages.environment import render_template
from site_builder.render.markdown import escaped

DRAWING = re.compile(
    r'<svg class="overlay" viewBox="0 0 ([\d.]+) ([\d.]+)"[^>]*>(.*?)</svg>', re.DOTALL
)


def quiz(question: Quiz, block: Block, page: Page) -> Iterator[Part]:
    asked = (f"{named(block.target)}{page.markdown(question.prompt)}", _offered(question, page))
    answers = "\n".join(_answers(question, page))
    yield Text("\n\n".join((*filter(None, asked), folded(page.words("question.answer"), answers))))


def predict(question: Prediction, block: Block, page: Page) -> Iterator[Part]:
    """What is right begins the `answer`; where none follows, it stands here."""
    title = f"{named(block.target)}{escaped(page.words('predict.title'))}"
    asked = (title, page.markdown(question.prompt), _offered(question, page))
    yield Text("\n\n".join(filter(None, asked)))
    answers = contents(page.chapter.body, Reveal)
    if question.id not in (each.prediction for each in answers):
        yield from wrapped(right(question, page), partial(folded, page.words("question.answer")))


def right(question: Prediction, page: Page) -> Iterator[Text]:
    """The right option, number or curve."""
    yield from (Text(_answer(option, page)) for option in question.options if option.correct)
    if drawing := _drawing(question, page):
        name = f"{question.id}.png"
        shown = f"![{escaped(page.words('predict.computed_curve'))}](attachment:{name})"
        yield Text(shown, {name: page.picture([drawing])})


def _offered(question: Question, page: Page) -> str:
    """What can be chosen, or ordered."""
    lines = zip(ascii_uppercase, kind_of(question).offered(question), strict=False)
    return "\n".join(f"- {letter}: {page.markdown(option.words)}" for letter, option in lines)


def _answers(question: Quiz, page: Page) -> Iterator[str]:
    """A line for each answer, with its explanation."""
    kind = kind_of(question)
    if kind.needs_page:  # its other answers are settings that only a page can judge
        yield from (f"- {page.markdown(o.explanation)}" for o in question.options if o.correct)
        if solution := kind.view(question, page.chapter.simulations):
            yield f"- {escaped(page.words('edition.one_way', settings=solution))}"
        return
    for place, option in enumerate(question.options, 1):
        verdict = page.words("question.right" if option.correct else "question.wrong")
        yield f"{f'{place}.' if kind.numbered else f'- **{verdict}:**'} {_answer(option, page)}"


def _answer(option: Option, page: Page) -> str:
    otherwise = page.words("question.otherwise") if option.text == OTHERWISE else ""
    said = otherwise or page.markdown(option.words)
    return "  \n  ".join(filter(None, (said, page.markdown(option.explanation))))


def _drawing(question: Prediction, page: Page) -> Panel | None:
    """Axes and the true curve of what is to be drawn; None where nothing is."""
    template = "editions/notebook-drawing.html"
    if not kind_of(question).drawn:
        return None
    html = render_template(template, page.book, question=question, chapter=page.chapter)
    found = DRAWING.search(html)
    assert found  # the template has one
    width, height, marks = found.groups()
    return Panel("field", "", float(width), float(height), overlay=marks)
