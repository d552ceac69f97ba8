"""Drafts while a hand moves, the chosen accuracy at rest, and the error once nothing moves."""

from collections.abc import Callable
from typing import Any

import pytest
from playwright.sync_api import Locator
from support.reader import Reader

from simulations.registry import load_scene

pytestmark = pytest.mark.browser

type OpenFigure = Callable[[str], Locator]


@pytest.fixture
def open_figure(guest: Reader, book: Any) -> OpenFigure:
    """Leads to a figure that rests as its page has put it."""

    def open_it(scene: str) -> Locator:
        figure = guest.stay_at_figure(book, scene)
        guest.put_back(figure)
        tier = load_scene(scene).default_tier
        if figure.get_attribute("data-tier") != tier:
            guest.choose(figure, "tier", tier)
            guest.settle(figure)
        return figure

    return open_it


def set_slider(figure: Locator, name: str, value: float, *, release: bool) -> None:
    """As a hand does: ``input`` events while it holds the knob, ``change`` when it lets go."""
    figure.locator(f"input[name={name}]").evaluate(
        """(input, [value, release]) => {
          input.value = value;
          input.dispatchEvent(new Event('input', {bubbles: true}));
          if (release) input.dispatchEvent(new Event('change', {bubbles: true}));
        }""",
        [str(value), release],
    )


def test_a_drag_is_drafted_and_settles_in_the_chosen_tier(
    guest: Reader, open_figure: OpenFigure
) -> None:
    figure = open_figure("camera")
    assert figure.get_attribute("data-tier") == "layers"
    frames = guest.frames(figure)
    set_slider(figure, "focal_length", 60, release=False)
    guest.wait_frame(figure, frames)
    assert figure.get_attribute("data-tier") == "draft"
    drafted, frames = guest.shown(figure), guest.frames(figure)
    set_slider(figure, "focal_length", 60, release=True)
    guest.wait_frame(figure, frames)
    guest.settle(figure)
    assert figure.get_attribute("data-tier") == "layers"
    assert guest.shown(figure)["pixels"] != drafted["pixels"]


def test_a_drag_that_leaves_geometry_alone_needs_no_draft(
    guest: Reader, open_figure: OpenFigure
) -> None:
    figure = open_figure("camera")
    frames = guest.frames(figure)
    set_slider(figure, "noise_sigma", 20, release=False)
    guest.wait_frame(figure, frames)
    assert figure.get_attribute("data-tier") == "layers"
    statuses = figure.locator(".stage").evaluate_all(
        "stages => stages.map((stage) => [stage.firstElementChild.textContent,"
        " stage.dataset.status])"
    )
    computed = [name for name, status in statuses if status == "computed"]
    assert computed == ["read noise", "quantisation", "sRGB"]
    count = figure.locator(".stages-count").text_content()
    assert str(count).startswith("3 computed")


@pytest.mark.parametrize(
    ("chosen", "control", "value", "while_dragging"),
    [
        ("layers", "k1", -0.2, "bowed"),
        ("layers", "aperture", 4.0, "layers"),
        ("aperture-rays", "aperture", 4.0, "draft"),
    ],
)
def test_a_drag_has_its_control_s_own_draft_or_where_it_is_too_dear_the_coarse_one(
    guest: Reader,
    open_figure: OpenFigure,
    chosen: str,
    control: str,
    value: float,
    while_dragging: str,
) -> None:
    figure = open_figure("camera")
    if figure.get_attribute("data-tier") != chosen:
        guest.choose(figure, "tier", chosen)
    guest.settle(figure)
    frames = guest.frames(figure)
    set_slider(figure, control, value, release=False)
    guest.wait_frame(figure, frames)
    assert figure.get_attribute("data-tier") == while_dragging


def test_the_error_is_told_at_rest_and_differs_by_tier(
    guest: Reader, open_figure: OpenFigure
) -> None:
    figure = open_figure("lens-distortion")
    set_slider(figure, "k1", -0.3, release=True)
    guest.settle(figure)
    errors = {}
    for tier in ("first-order", "newton-bracketed"):
        guest.choose(figure, "tier", tier)
        errors[tier] = guest.judged(figure)
    assert errors["newton-bracketed"] == "under 10⁻⁹\xa0px"
    assert float(errors["first-order"].removesuffix("\xa0px")) > 1


def test_a_tier_cheaper_than_the_draft_is_kept_while_dragging(
    guest: Reader, open_figure: OpenFigure
) -> None:
    figure = open_figure("lens-distortion")
    guest.choose(figure, "tier", "first-order")
    frames = guest.frames(figure)
    set_slider(figure, "k1", 0.3, release=False)
    guest.wait_frame(figure, frames)
    assert figure.get_attribute("data-tier") == "first-order"


def test_no_error_stands_beside_a_frame_that_it_does_not_belong_to(
    guest: Reader, open_figure: OpenFigure
) -> None:
    figure = open_figure("lens-distortion")
    guest.judged(figure)
    figure.evaluate(NOTE_ERROR)
    frames = guest.frames(figure)
    set_slider(figure, "k1", 0.2, release=False)
    guest.wait_frame(figure, frames)
    assert guest.page.evaluate("window.beside")[0] == "…"


NOTE_ERROR = """(figure) => {
  window.beside = [];
  figure.addEventListener('painted', () => {
    window.beside.push(figure.querySelector('.accuracy-value').textContent);
  });
}"""
"""What stands beside each frame when it is painted; soon after, its own error may."""


def test_a_refused_setting_leaves_the_list_of_stages_ready_for_the_next(
    guest: Reader, open_figure: OpenFigure
) -> None:
    """Focused nearer than its focal length a lens makes no picture, and no stage is run."""
    figure = open_figure("depth-of-field")
    for focus in (0.05, 3.0):
        frames = guest.frames(figure)
        set_slider(figure, "focus", focus, release=True)
        guest.wait_frame(figure, frames)
        guest.settle(figure)
        assert figure.get_attribute("data-state") == "live"
    assert figure.locator(".stages > ol > li:not([hidden])").count() > 5
