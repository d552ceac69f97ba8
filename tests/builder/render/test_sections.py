"""The book in plain words: what is said under which heading, and never an answer."""

from collections.abc import Callable

import pytest
from support.little_book import files_of

from site_builder.build import Options, check_site
from site_builder.pages.reading_time import reading_minutes
from site_builder.render.sections import Section, chapter_sections


@pytest.fixture
def sections(make_book: Callable[..., Options]) -> tuple[Section, ...]:
    book, *_ = check_site(make_book(files=files_of("sections")))
    return chapter_sections(book.chapters[0], lambda _figure: "A barrel.")


def test_a_heading_begins_a_section(sections: tuple[Section, ...]) -> None:
    assert [(section.anchor, section.title) for section in sections] == [
        ("", "First"),
        ("bent-lines", "Bent lines"),
    ]


def test_what_is_emphasised_is_a_term_and_stays_in_the_text(sections: tuple[Section, ...]) -> None:
    assert sections[0].terms == ("term",)
    assert sections[0].text == "The first chapter. An opening with a term."


def test_a_short_formula_is_text_and_a_long_one_an_ellipsis(sections: tuple[Section, ...]) -> None:
    assert sections[1].text == "The factor k1 counts, …. In an aside."


def test_a_figure_is_found_by_title_description_and_caption(sections: tuple[Section, ...]) -> None:
    assert all(text in sections[1].figures for text in ("Demo.", "A barrel.", "Pull it."))


def test_questions_are_found_and_answers_are_not(sections: tuple[Section, ...]) -> None:
    assert sections[1].questions == "How many? A guess?"
    everything = repr(sections)
    assert not [
        word for word in ("seven", "nine", "ten", "twelve", "secret") if f" {word}" in everything
    ]


def test_text_of_three_minutes_takes_three_minutes(make_book: Callable[..., Options]) -> None:
    book, *_ = check_site(make_book("word " * 540))
    assert reading_minutes(book.chapters[0], lambda _figure: "") == 3
