"""What of a finished page is searched: what it says, under which heading, and never an answer."""

import pytest

from site_builder.search.page_text import Section, read_sections, reading_minutes

PAGE = """
<header><p>Frame</p></header>
<article class="chapter" data-searched>
<header><p class="chapter-number">Chapter 4</p><h1>Lenses</h1><p>Summary.</p></header>
<p>An opening with a <strong>term</strong>.</p>
<h2 id="bend">Bent <em>lines</em></h2>
<p>The factor <math display="inline"><mi>k</mi><mn>1</mn></math> counts,
<span class="nowrap"><math><mi>abcdefghijklmnop</mi></math>.</span></p>
<div class="equation"><math display="block"><mi>displayed</mi></math></div>
<figure class="simulation"><simulation-figure><script>secret</script>
<p class="panel-title">Grid</p><p class="description">A barrel.</p>
<form class="controls" aria-label="Simulator"><label>slider</label></form></simulation-figure>
<figcaption>Pull it.</figcaption></figure>
<figure class="illustration"><div role="img" aria-label="A drawing."></div></figure>
<form class="quiz"><fieldset><legend>How many?</legend><label>seven</label></fieldset>
<button>Check</button><div class="feedback"></div>
<noscript><p>Right: seven</p></noscript></form>
<form class="predict"><div class="predict-question"><p>Guess.</p></div>
<fieldset class="guess"><label>nine</label></fieldset></form>
<section class="answer"><p>It is nine.</p></section>
</article>
<footer><p>Frame</p></footer>
"""


@pytest.fixture
def sections() -> tuple[Section, ...]:
    return read_sections(PAGE)


def test_a_heading_begins_a_section(sections: tuple[Section, ...]) -> None:
    assert [(section.anchor, section.title) for section in sections] == [
        ("", "Lenses"),
        ("bend", "Bent lines"),
    ]


def test_only_the_marked_article_is_read(sections: tuple[Section, ...]) -> None:
    assert sections[0].text == "Summary. An opening with a term."
    assert read_sections(PAGE.replace(" data-searched", "")) == ()


def test_what_is_emphasised_is_a_term_and_stays_in_the_text(sections: tuple[Section, ...]) -> None:
    assert sections[0].terms == ("term",)


def test_a_short_formula_is_text_and_a_long_one_an_ellipsis(sections: tuple[Section, ...]) -> None:
    assert sections[1].text == "The factor k1 counts, …."


def test_a_figure_is_found_by_title_description_and_caption(sections: tuple[Section, ...]) -> None:
    assert sections[1].figures.split(". ") == ["A barrel", "Simulator", "Pull it", "A drawing."]


def test_questions_are_found_and_their_answers_are_not(sections: tuple[Section, ...]) -> None:
    assert sections[1].questions == "How many? Guess."
    everything = repr(sections)
    assert not [word for word in ("seven", "nine", "secret") if word in everything]


def test_text_of_three_minutes_takes_three_minutes() -> None:
    assert reading_minutes("<p>" + "word " * 540 + "</p>") == 3


@pytest.mark.parametrize(("fold", "minutes"), [("<details>", 1), ("<details open>", 3)])
def test_what_is_folded_takes_no_time_to_read(fold: str, minutes: int) -> None:
    assert reading_minutes(f"<p>Some.</p>{fold}<p>{'word ' * 540}</p></details>") == minutes
