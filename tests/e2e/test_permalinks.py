"""The state of a figure in the address: read, written, and never trusted."""

import pytest
from playwright.sync_api import Locator
from support.page_scripts import SILENT_WORKER
from support.reader import Reader

pytestmark = pytest.mark.browser

CHAPTER = "lens-distortion/"
ID = "figure-lens-distortion"


def open_at(visitor: Reader, **settings: str) -> Locator:
    """The chapter's first figure, at an address that asks for ``settings``."""
    query = "&".join(f"{ID}.{name}={value}" for name, value in settings.items())
    visitor.turn_to_unlinked(f"{CHAPTER}?{query}#{ID}")
    return visitor.figure("lens-distortion")


def values(figure: Locator, *names: str) -> list[str]:
    return [figure.locator(f"form.controls [name={name}]").input_value() for name in names]


def start(figure: Locator, name: str) -> str:
    """Where the page puts a control."""
    return str(
        figure.locator("script.schema").evaluate(
            "(script, name) => String(JSON.parse(script.text).values[name])", name
        )
    )


def wait_address(visitor: Reader, search: str) -> None:
    visitor.page.wait_for_function("search => location.search === search", arg=search)


def test_an_address_sets_its_figure_and_no_other(visitor: Reader) -> None:
    figure = open_at(visitor, k1="-0.3", picture="chart", tier="newton-5", correct="true")
    assert values(figure, "k1", "picture", "tier") == ["-0.3", "chart", "newton-5"]
    assert figure.locator("[name=correct]").is_checked()
    assert figure.get_attribute("data-tier") == "newton-5"
    assert figure.locator("output[name=corner]").inner_text() == "−60.0"
    other = visitor.page.locator("#figure-two-coefficients")
    assert values(other, "k1", "k2") == ["-0.2", "0.2"]
    assert not figure.locator(".figure-status").is_visible()


def test_numbers_are_brought_into_range_and_onto_the_steps(visitor: Reader) -> None:
    """The link of the chapter itself leads back to its start and keeps the interpreter."""
    figure = open_at(visitor, k1="-7", k2="0.1234")
    assert values(figure, "k1", "k2") == ["-0.5", "0.12"]
    worker = visitor.page.workers[0]
    visitor.turn_to(CHAPTER)
    assert values(figure, "k1") == [start(figure, "k1")]
    assert visitor.page.workers == [worker]


def test_what_an_address_cannot_mean_is_ignored_with_a_word(visitor: Reader) -> None:
    for meaningless in (
        {"k1": "1e", "k2": "", "k9": "1"},
        {"picture": "%E0%A4%A", "correct": "yes", "tier": "best"},
    ):
        figure = open_at(visitor, **meaningless)
        names = ("k1", "k2", "picture")
        assert values(figure, *names) == [start(figure, name) for name in names]
        assert values(figure, "tier") == ["closed-form"]
        said = figure.locator(".figure-message").inner_text()
        assert all(f"{name}=" in said for name in meaningless)
    figure.locator("[name=k1]").fill("0.1")
    figure.locator(".figure-status").wait_for(state="hidden")


def test_a_hand_at_rest_is_kept_in_the_address_without_an_entry_of_the_history(
    visitor: Reader,
) -> None:
    """After another chapter the figure is found as it was left."""
    visitor.turn_to(CHAPTER)
    worker = visitor.page.workers[0]
    figure = visitor.figure("lens-distortion")
    entries = visitor.page.evaluate("history.length")
    visitor.uncover(figure)
    figure.locator("[name=k1]").fill("0.3")
    figure.locator("[name=k2]").fill("-0.1")
    wait_address(visitor, f"?{ID}.k1=0.3&{ID}.k2=-0.1")
    assert visitor.page.evaluate("history.length") == entries
    figure.locator("[name=k1]").fill(start(figure, "k1"))
    wait_address(visitor, f"?{ID}.k2=-0.1")
    visitor.turn_to("lighting-and-reflectance/")
    visitor.page.go_back()
    visitor.page.locator(f"#{ID}").wait_for()
    visitor.wait_live()
    assert values(figure, "k1", "k2") == [start(figure, "k1"), "-0.1"]
    assert visitor.page.workers == [worker]


def test_a_page_that_is_loaded_finds_its_figure_where_the_address_says(reader: Reader) -> None:
    """As after a reload; before Python has answered."""
    reader.page.add_init_script(SILENT_WORKER)
    reader.open(f"{CHAPTER}?{ID}.k1=0.3", live=False)
    reader.page.reload()
    reader.page.wait_for_function(
        "id => document.getElementById(id).querySelector('[name=k1]').value === '0.3'", arg=ID
    )
