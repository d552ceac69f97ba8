"""What of the site's pages is in the printed book: what is read, and every answer last."""

import io
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from pypdf import PdfReader

from simulations.engine.drawing import line
from simulations.engine.frame import Frame
from simulations.engine.stages import Outputs
from site_builder.build import Options
from site_builder.editions.compose import compose
from site_builder.editions.links import Place
from site_builder.editions.pdf import anchor_pages, make_pdf
from site_builder.editions.tree import elements, first, words
from site_builder.editions.volume import anchor, volume

type MakeBook = Callable[..., Options]


def test_no_answer_stands_before_the_answers(make_book: MakeBook, body: str) -> None:
    first, _, answers = compose(make_book(body)).sections
    assert "Which one?" in words(first.article)
    assert "for a reason" not in words(first.article)
    assert "Yes, for a reason" in words(answers.article)


def test_nothing_is_left_that_needs_a_hand(make_book: MakeBook, body: str) -> None:
    article = compose(make_book(body)).sections[0].article
    names = {element.tag for element in elements(article)}
    assert names.isdisjoint({"button", "input", "select", "script", "noscript", "details"})


@pytest.mark.parametrize("pictures", [True, False])
def test_a_figure_shows_its_main_control_at_several_values(
    make_book: MakeBook, body: str, *, pictures: bool
) -> None:
    options = make_book(body.replace("{simulation} demo", "{simulation} demo\n:k1: 0.1"))

    demo = options.load_scene("demo")

    def follow(settings: Any, outputs: Outputs) -> Frame:
        frame = demo.draw(settings, outputs)
        if pictures:
            raster = np.full((4, 6, 4), 128 + round(200 * settings.k1), np.uint8)
            return replace(frame, panels=(replace(frame.panels[0], raster=raster),))
        turned = replace(frame.panels[1], overlay=line((0, 0), (100 * settings.k1, 10)))
        return replace(frame, panels=(frame.panels[0], turned))

    scene = replace(demo, draw=follow)
    composed = compose(replace(options, load_scene=lambda _id: scene))
    article = composed.sections[0].article
    values = [words(item) for item in elements(article, kind="multiple-value")]
    assert values == ["Distortion: −0.20 px", "Distortion: 0.10 px", "Distortion: 0.30 px"]
    rows = elements(article, kind="multiple")
    shown = {str(image.get("src")).removeprefix("../") for row in rows for image in row.iter("img")}
    assert len(shown) == (3 if pictures else 0)
    assert shown <= set(composed.files)


def test_every_id_of_the_whole_is_unique_and_every_link_leads_to_one(
    make_book: MakeBook, body: str
) -> None:
    whole = volume(compose(make_book(body)))
    ids = [element.attrib["id"] for element in whole.iter() if "id" in element.attrib]
    assert len(ids) == len(set(ids))
    inside = [link.get("href", "") for link in elements(whole, "a")]
    assert inside
    assert {link.removeprefix("#") for link in inside if link.startswith("#")} <= set(ids)


def test_ids_beyond_ascii_stay_apart_in_it() -> None:
    moire, moira = (anchor(Place("page", f"moir{letter}")) for letter in "éá")
    assert moire.isascii()
    assert moire != moira


@pytest.mark.browser
def test_contents_and_links_name_the_pages_on_which_things_are(
    make_book: MakeBook, body: str
) -> None:
    with ThreadPoolExecutor() as aside:  # no two Playwrights in one thread
        pdf = aside.submit(make_pdf, compose(make_book(body))).result()
    reader = PdfReader(io.BytesIO(pdf))
    pages = anchor_pages(pdf)
    texts = [" ".join(page.extract_text().split()) for page in reader.pages]
    assert f"(p. {pages['second']})" in texts[pages["first"] - 1].replace("\xa0", " ")
    assert "for a reason" in texts[pages["answers"] - 1]
    assert len({pages[name] for name in ("first", "second", "answers")}) == 3
    titles = [str(entry["/Title"]) for entry in reader.outline if isinstance(entry, dict)]
    assert titles[:3] == ["Contents", "First", "Second"]


def test_an_answer_leads_to_the_equation_of_its_chapter(make_book: MakeBook) -> None:
    asked = "- [x] this\n  : By {ref}`eq-a`.\n- [ ] that\n  : No.\n- [ ] more\n  : No.\n"
    body = f"$$\nx = 1\n$$ (eq-a)\n\n:::{{quiz}} which\nWhich?\n{asked}- [ ] all\n  : No.\n:::\n"
    document = volume(compose(make_book(body)))
    answers = first(document, kind="answers")
    assert "#first.eq-a" in [link.get("href") for link in elements(answers, "a")]
