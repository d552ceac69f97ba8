"""Settings of one figure: levels, stated accuracy, links and addresses that set it, highlights, and
screen readers."""

import json
from typing import Any

import pytest
from playwright.sync_api import Locator, expect
from support.page_scripts import SILENT_WORKER, SLOWED
from support.reader import Reader, step

from simulations.models.distortion.lens_model import Distortion
from simulations.registry import load_scene
from simulations.scenes.lens_distortion.stages import inversion_error_px

pytestmark = pytest.mark.browser

CHAPTER = "lens-distortion/"
ID = "figure-lens-distortion"
BARREL = f'a.set[href="?{ID}.k1=-0.2&{ID}.k2=0#{ID}"]'
CORRECTED = "a.set[data-values*='\"correct\": true']"


DRAGS = (
    ("camera", "layers", "focal_length"),
    ("lens-distortion", "first-order", "k1"),  # the cheapest
)


@pytest.mark.parametrize(("scene", "chosen", "control"), DRAGS)
def test_drag_stays_within_the_chosen_level_and_settles_in_it(
    guest: Reader, book: Any, scene: str, chosen: str, control: str
) -> None:
    levels = load_scene(scene).accuracy.names
    figure = guest.figure_at_rest(book, scene)
    if figure.get_attribute("data-level") != chosen:
        guest.choose(figure, "tier", chosen)
        guest.settle(figure)
    guest.open_controls(figure)
    box = guest.scroll_to(figure.locator(f"[name={control}]"))
    mouse = guest.page.mouse
    mouse.move(box["x"] + 0.6 * box["width"], box["y"] + box["height"] / 2)
    with guest.next_frame(figure):
        mouse.down()
    moving = figure.get_attribute("data-level") or ""
    assert levels.index(moving) <= levels.index(chosen)
    mouse.up()
    guest.settle(figure)
    assert figure.get_attribute("data-level") == chosen


def test_slow_figure_moves_at_a_cheaper_level_and_reports_it(guest: Reader, book: Any) -> None:
    figure = guest.figure_at_rest(book, "tiled-floor")
    assert figure.locator("[name=tier] option").first.get_attribute("value") == "automatic"
    assert values(figure, "tier") == ["automatic"]
    assert figure.get_attribute("data-level") == "640"
    guest.open_stage_report(figure)
    figure.evaluate(SLOWED, {"640": 150, "320": 60})
    box = guest.scroll_to(figure.locator("[name=pitch]"))
    mouse, y = guest.page.mouse, box["y"] + box["height"] / 2
    mouse.move(box["x"] + 0.4 * box["width"], y)
    mouse.down()
    for share in range(40, 80):
        mouse.move(box["x"] + share / 100 * box["width"], y)
        guest.page.wait_for_timeout(25)
    with step("frames come at the level that is in time"):
        levels = figure.evaluate("figure => figure.levels")
        assert len(levels) > 10
        assert levels[-3:] == ["160"] * 3
        assert int(figure.get_attribute("data-late") or "0") >= 2
    mouse.up()
    guest.settle(figure)
    with step("the figure rests at its default, and says what was shown"):
        assert figure.get_attribute("data-level") == "640"
        report = figure.locator(".moving").inner_text()
        assert "160 columns" in report
        assert "320 columns would take" in report
    figure.evaluate("figure => figure.unslowed()")


def test_automatic_within_an_error_takes_the_cheapest_level_that_keeps_it(
    guest: Reader, book: Any
) -> None:
    scene = load_scene("lens-distortion")
    figure = guest.figure_at_rest(book, scene.id)
    figure.locator("[name=k1]").fill("-0.3")
    guest.settle(figure)
    guest.choose(figure, "tier", "within-tenth-pixel")
    given = {"k1": -0.3, "k2": float(values(figure, "k2")[0])}
    lens = Distortion(**given)
    errors = {level: inversion_error_px(lens, level) for level in scene.accuracy.names}
    cheapest = next(level for level, error in errors.items() if error <= 0.1)
    assert cheapest != scene.accuracy.default
    expect(figure).to_have_attribute("data-level", cheapest)


def test_error_is_stated_at_rest_by_tier_and_never_for_another_frame(
    visitor: Reader, book: Any
) -> None:
    """The error is measured only where it is visible."""
    figure = visitor.turn_to_figure(book, "lens-distortion")
    assert figure.locator(".accuracy-value").text_content() == "…"
    with visitor.next_frame(figure):
        figure.locator("[name=k1]").fill("-0.3")
    visitor.settle(figure)
    errors = {}
    for tier in ("first-order", "newton-bracketed"):
        visitor.choose(figure, "tier", tier)
        errors[tier] = visitor.final_error(figure)
    assert errors["newton-bracketed"] == "under 10⁻⁹\xa0px"
    assert float(errors["first-order"].removesuffix("\xa0px")) > 1
    figure.evaluate(NOTE_ERROR)
    with visitor.next_frame(figure):
        figure.locator("[name=k1]").fill("0.2")
    assert visitor.page.evaluate("window.beside")[0] == "…"
    # Focused nearer than its focal length, a lens forms no image, and no stage is run.
    figure = visitor.turn_to_figure(book, "depth-of-field")
    for focus in ("0.05", "3"):
        with visitor.next_frame(figure):
            figure.locator("[name=focus]").fill(focus)
        visitor.settle(figure)
        assert figure.get_attribute("data-state") == "live"
    assert figure.locator(".stages > ol > li:not([hidden])").count() > 5


NOTE_ERROR = """(figure) => {
  window.beside = [];
  figure.addEventListener('painted', () => {
    window.beside.push(figure.querySelector('.accuracy-value').textContent);
  });
}"""
"""Record the stated error when each frame is painted, before its own error arrives."""


def test_link_sets_a_figure_by_a_glide_and_going_back_undoes_it(
    guest: Reader, figure: Locator
) -> None:
    page = guest.page
    figure.evaluate(NOTE_VALUES)
    start = float(figure.locator("[name=k1]").input_value())
    page.locator(BARREL).first.click()
    expect(figure.locator("[name=k1]")).to_have_value("-0.2")
    passed = [float(value) for value in page.evaluate("window.passed")]
    assert passed == sorted(passed, reverse=True)
    assert any(-0.2 < value < start for value in passed)
    assert all(round(100 * value, 6) == round(100 * value) for value in passed)
    guest.settle(figure)
    assert figure.locator("output[name=corner]").inner_text() == "−40.0"
    figure.locator("[name=k1]").fill("0.3")
    guest.settle(figure)
    page.locator(BARREL).first.press("Enter")
    expect(figure.locator("[name=k1]")).to_have_value("-0.2")
    guest.settle(figure)
    page.go_back()
    expect(figure.locator("[name=k1]")).to_have_value("0.3")
    guest.settle(figure)
    page.go_forward()
    expect(figure.locator("[name=k1]")).to_have_value("-0.2")
    # Touching the figure stops the glide.
    guest.restore(figure)
    figure.evaluate(TOUCH_ON_THE_WAY)
    page.locator(BARREL).first.click()
    guest.wait_for(figure, "(figure) => figure.querySelector('[name=k1]').value <= -0.05")
    stopped = figure.locator("[name=k1]").input_value()
    guest.settle(figure)
    assert figure.locator("[name=k1]").input_value() == stopped != "-0.2"
    # Less motion, no glide.
    guest.restore(figure)
    page.emulate_media(reduced_motion="reduce")
    page.evaluate("window.passed.length = 0")
    page.locator(BARREL).first.click()
    expect(figure.locator("[name=k1]")).to_have_value("-0.2")
    assert page.evaluate("window.passed") == []


NOTE_VALUES = """(figure) => {
  const k1 = figure.querySelector('[name=k1]');
  window.passed = [];
  k1.addEventListener('input', () => window.passed.push(k1.value));
}"""
TOUCH_ON_THE_WAY = """(figure) => {
  const k1 = figure.querySelector('[name=k1]');
  k1.addEventListener('input', function touch() {
    if (k1.value > -0.05) return;
    k1.removeEventListener('input', touch);
    figure.dispatchEvent(new Event('pointerdown'));
  });
}"""


def test_link_brings_its_figure_into_view_and_a_button_leads_back(
    guest: Reader, figure: Locator
) -> None:
    """A link in a prediction sets every control that its claim depends on."""
    page = guest.page
    link, back = page.locator(CORRECTED), page.locator(".way-back")
    guest.scroll_to(link)
    expect(figure.locator(".panels")).not_to_be_in_viewport(ratio=0.5)
    expect(back).to_have_count(0)
    link.click()
    guest.wait_for(figure, "(figure) => figure.querySelector('[name=correct]').checked")
    expect(figure.locator(".panels")).to_be_in_viewport(ratio=0.5)
    back.click()
    expect(link).to_be_in_viewport()
    expect(link).to_be_focused()
    expect(back).to_have_count(0)
    start = figure.evaluate("f => JSON.parse(f.querySelector('script.schema').textContent).values")
    guest.open_controls(figure)
    figure.locator("[name=correct]").check(force=True)
    figure.locator("[name=k2]").fill("0.3")
    link = page.locator(f"[data-answers] a.set[data-figure={ID}]").first
    link.click()
    claim = json.loads(link.get_attribute("data-values") or "")
    for name, value in {**start, **claim}.items():
        control = figure.locator(f"[name={name}]")
        match control.get_attribute("type"):
            case "checkbox":
                expect(control).to_be_checked(checked=value)
            case "range":
                expect(control).to_have_value(f"{value:g}")


def open_at(visitor: Reader, **settings: str) -> Locator:
    """The chapter's first figure, at an address with ``settings``."""
    query = "&".join(f"{ID}.{name}={value}" for name, value in settings.items())
    visitor.turn_to_unlinked(f"{CHAPTER}?{query}#{ID}")
    return visitor.figure("lens-distortion")


def values(figure: Locator, *names: str) -> list[str]:
    return [figure.locator(f"form.controls [name={name}]").input_value() for name in names]


def starts(figure: Locator, *names: str) -> list[str]:
    """The values at which the page starts controls."""
    script = figure.locator("script.schema")
    given = script.evaluate("(script) => JSON.parse(script.text).values")
    return [
        f"{given[name]:g}" if isinstance(given[name], float) else str(given[name]) for name in names
    ]


def test_address_sets_only_its_figure_and_invalid_parts_are_named(visitor: Reader) -> None:
    figure = open_at(visitor, k1="-0.3", picture="chart", tier="newton-5", correct="true")
    assert values(figure, "k1", "picture", "tier") == ["-0.3", "chart", "newton-5"]
    assert figure.locator("[name=correct]").is_checked()
    assert figure.get_attribute("data-level") == "newton-5"
    assert figure.locator("output[name=corner]").inner_text() == "−60.0"
    assert values(visitor.page.locator("#figure-two-coefficients"), "k1", "k2") == ["-0.2", "0.2"]
    assert not figure.locator(".figure-status").is_visible()
    figure = open_at(visitor, k1="-7", k2="0.1234")
    assert values(figure, "k1", "k2") == ["-0.5", "0.12"], "in range, and on the steps"
    (worker,) = visitor.page.workers
    for meaningless in (
        {"k1": "1e", "k2": "", "k9": "1"},
        {"picture": "%E0%A4%A", "correct": "yes", "tier": "best"},
    ):
        figure = open_at(visitor, **meaningless)
        names = ("k1", "k2", "picture")
        assert values(figure, *names) == starts(figure, *names)
        assert values(figure, "tier") == ["automatic"]
        message = figure.locator(".figure-message").inner_text()
        assert all(f"{name}=" in message for name in meaningless)
    figure.locator("[name=k1]").fill("0.1")
    figure.locator(".figure-status").wait_for(state="hidden")
    visitor.turn_to(CHAPTER)
    assert values(figure, "k1") == starts(figure, "k1")
    assert visitor.page.workers == [worker]


def test_address_follows_moved_controls_without_history_entries(visitor: Reader) -> None:
    """Back from another chapter the figure has its settings."""
    visitor.turn_to(CHAPTER)
    page, figure = visitor.page, visitor.figure("lens-distortion")
    entries = page.evaluate("history.length")
    visitor.open_controls(figure)
    figure.locator("[name=k1]").fill("0.3")
    figure.locator("[name=k2]").fill("-0.1")
    address = "search => location.search === search"
    page.wait_for_function(address, arg=f"?{ID}.k1=0.3&{ID}.k2=-0.1")
    assert page.evaluate("history.length") == entries
    figure.locator("[name=k1]").fill(*starts(figure, "k1"))
    page.wait_for_function(address, arg=f"?{ID}.k2=-0.1")
    visitor.turn_to("lighting-and-reflectance/")
    page.go_back()
    page.locator(f"#{ID}").wait_for()
    visitor.wait_live()
    assert values(figure, "k1", "k2") == [*starts(figure, "k1"), "-0.1"]


def test_reload_restores_settings_from_the_address_before_python_starts(reader: Reader) -> None:
    reader.page.add_init_script(SILENT_WORKER)
    reader.open(f"{CHAPTER}?{ID}.k1=0.3", live=False)
    reader.page.reload()
    expect(reader.figure("lens-distortion").locator("[name=k1]")).to_have_value("0.3")


def test_words_readouts_and_controls_are_highlighted_together(
    guest: Reader, figure: Locator, plain_reader: Reader
) -> None:
    """Numbers that a control changes are marked until it rests."""
    page = guest.page
    caption = page.locator(f"#{ID} .figure-caption")
    lit = "(element, role) => (element.dataset.lit ?? '') === role"
    with step("words and readouts highlight the figure and the chapter"):
        for pointed, role in [
            (caption.locator(".role-world"), "world"),
            (figure.locator(".readout.role-ray"), "ray"),
        ]:
            pointed.hover()
            for element in (figure, page.locator("article.chapter")):
                guest.wait_for(element, lit, role)
            page.mouse.move(0, 0)
            guest.wait_for(figure, lit, "")
    with step("the other parts of the drawing fade"):
        caption.locator(".role-image").hover()
        guest.wait_for(
            figure.locator(".overlay > .camera").first,
            "one => getComputedStyle(one).opacity !== '1'",
        )
        page.mouse.move(0, 0)
    with step("numbers that a control changes are marked until it rests"):
        moved = figure.locator(".readout[data-moved] output")
        with guest.next_frame(figure):
            figure.locator("[name=k1]").fill("0.1")
        expect(moved).to_have_count(0)
        figure.evaluate("""(figure) => {
          window.marked = new Set();
          figure.addEventListener('painted', () => {
            for (const item of figure.querySelectorAll('.readout[data-moved] output')) {
              window.marked.add(item.name);
            }
          });
        }""")
        with guest.next_frame(figure):
            figure.locator("[name=k1]").fill("0.21")
        marked = set(page.evaluate("[...window.marked]"))
        assert {"corner", "bow"} & marked
        assert "kind" not in marked
        expect(moved).to_have_count(0)

    with step("symbols of a formula highlight the chapter"):
        page = plain_reader.page
        plain_reader.open("perspective-projection/", live=False)
        symbol = page.locator('main math [class^="role-"]').first
        symbol.hover()
        role = str(symbol.get_attribute("class")).removeprefix("role-")
        plain_reader.wait_for(page.locator("article.chapter"), lit, role)
        assert page.locator('main :is(span, math *)[class^="role-"][tabindex]').count() == 0
    with step("a word highlights the control that drives it"):
        plain_reader.turn_to("lighting-and-reflectance/", live=False)
        driven = plain_reader.figure("phong").locator(".control.driven")
        about = page.locator("#figure-phong .about")
        about.evaluate("one => { one.open = true; }")
        about.locator(".role-light").first.hover()
        expect(driven.locator("[name=light_angle]")).to_have_count(1)
        page.mouse.move(0, 0)
        expect(driven).to_have_count(0)


def test_screen_reader_finds_numbers_and_pictures_by_name(
    plain_reader: Reader, guest: Reader, figure: Locator
) -> None:
    plain_reader.open(CHAPTER, live=False)
    still = plain_reader.figure("lens-distortion")
    readouts = still.locator(".readouts").first
    snapshot = readouts.aria_snapshot()
    assert "status" not in snapshot, "changing numbers are not announced"
    assert "paragraph" in snapshot, "Firefox ignores flexible boxes without a role"
    assert readouts.locator("output").first.inner_text() in snapshot
    panels = still.locator(".panels")
    assert panels.locator("svg text").count() > 0
    assert "text:" not in panels.aria_snapshot(), "drawings have only their names"
    canvases = figure.locator("canvas.live")
    assert canvases.count() > 0
    for canvas in canvases.all():
        panel = canvas.locator("xpath=ancestor::*[@data-panel][1]")
        picture = guest.page.get_by_role("img").and_(canvas)
        expect(picture).to_have_accessible_name(panel.locator(".panel-title").inner_text())
