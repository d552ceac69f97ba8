"""The row of tools below a figure: link, reset, full screen, files; and what is folded there."""

import csv
import io
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from PIL import Image
from playwright.sync_api import Browser, Locator, expect
from support.host import hosting
from support.reader import Reader

from site_builder.publishing.hosting import common_policy, frame_rule
from site_builder.settings.model import Publishing

pytestmark = pytest.mark.browser

CHAPTER = "lens-distortion/"
ID = "figure-lens-distortion"


@pytest.fixture
def figure(guest: Reader, book: Any) -> Iterator[Locator]:
    """A figure at a setting of its own, its list of tools open."""
    guest.page.context.grant_permissions(["clipboard-read", "clipboard-write"])
    found = guest.stay_at_figure(book, "lens-distortion")
    guest.put_back(found)
    found.locator("[name=k1]").fill("-0.3")
    guest.page.wait_for_function("location.search.includes('k1=-0.3')")
    guest.settle(found)
    found.locator(".share").evaluate("tools => { tools.open = true; }")
    yield found
    guest.page.emulate_media(reduced_motion="null")


def saved(figure: Locator, button: str) -> Path:
    with figure.page.expect_download() as download:
        figure.locator(button).click()
    path = download.value.path()
    return path.rename(path.with_name(download.value.suggested_filename))


def test_the_link_that_is_copied_opens_the_figure_as_it_is(guest: Reader, figure: Locator) -> None:
    figure.locator("[data-copy-link]").click()
    figure.locator(".tools-said", has_text="copied").wait_for()
    link = guest.page.evaluate("navigator.clipboard.readText()")
    assert link == f"{guest.root}{CHAPTER}?{ID}.k1=-0.3#{ID}"
    forbid = "() => { navigator.clipboard.writeText = () => Promise.reject(new Error('no')); }"
    guest.page.evaluate(forbid)
    figure.locator("[data-copy-link]").click()
    field = figure.locator(".copied")
    field.wait_for()  # it is shown to be copied by hand
    guest.page.evaluate("delete navigator.clipboard.writeText")
    assert field.input_value().endswith(f"?{ID}.k1=-0.3#{ID}")


def test_an_embedded_figure_lives_in_a_page_of_another_origin(
    guest: Reader, figure: Locator, brisk_chromium: Browser, built_site: Path, tmp_path: Path
) -> None:
    figure.locator("[data-copy-embed]").click()
    figure.locator(".tools-said", has_text="copied").wait_for()
    html = guest.page.evaluate("navigator.clipboard.readText()")
    assert f'src="{guest.root}embed/{CHAPTER}{ID}/?k1=-0.3"' in html
    assert ' height="900"' in html  # three panels
    pages = [page.read_bytes() for page in built_site.rglob("*.html")]
    policy = f"{common_policy(pages)}; {frame_rule(Publishing().frames)}"
    rules = {"/*": {"Content-Security-Policy": policy}}
    asked: list[str] = []
    errors: list[str] = []
    with hosting(tmp_path) as course, hosting(built_site, rules=rules) as book:
        frame = html.replace(guest.root, book.url)
        (tmp_path / "index.html").write_text(f"<!DOCTYPE html><link rel=icon href=data:,>{frame}")
        with brisk_chromium.new_context(viewport={"width": 1440, "height": 900}) as context:
            page = context.new_page()
            context.on("request", lambda request: asked.append(request.url))
            page.on("pageerror", lambda error: errors.append(str(error)))
            page.on("console", lambda said: errors.extend([said.text] * (said.type == "error")))
            page.goto(course.url)
            inside = page.frame_locator("iframe")
            inside.locator("simulation-figure[data-state=live]").wait_for(timeout=60_000)
            assert inside.locator("[name=k1]").input_value() == "-0.3"
            inside.locator("[name=k1]").fill("0.1")
            expect(inside.locator("output[name=corner]")).to_have_text("20.0")
            embedded = page.frames[1]
            box = embedded.locator("figure").bounding_box()
            assert box is not None
            assert box["x"] + box["width"] / 2 == pytest.approx(720, abs=10), "in the middle"
            embedded.wait_for_url("**/?k1=0.1")
            embedded.goto(f"{embedded.url}&k9=1")
            said = inside.locator(".figure-message", has_text="k9=1")
            expect(said).to_be_visible()
    assert errors == []
    outside = {url for url in asked if not url.startswith((book.url, "data:", "blob:"))}
    assert outside == {course.url}


def test_reset_returns_to_the_start_of_the_page_and_back_undoes_it(
    guest: Reader, figure: Locator
) -> None:
    guest.page.emulate_media(reduced_motion="reduce")
    figure.locator("[data-reset]").click()
    is_at = "([figure, value]) => figure.querySelector('[name=k1]').value === value"
    start = figure.locator("script.schema").evaluate("s => JSON.parse(s.text).values.k1")
    guest.page.wait_for_function(is_at, arg=[figure.element_handle(), str(start)])
    guest.page.wait_for_function("location.search === ''")
    guest.page.go_back()
    guest.page.wait_for_function(is_at, arg=[figure.element_handle(), "-0.3"])


def test_numbers_pictures_and_drawings_are_saved(figure: Locator) -> None:
    """The numbers with the settings that they belong to."""
    text = saved(figure, "[data-save-numbers]").read_text(encoding="utf-8")
    rows = {(row["kind"], row["name"]): row for row in csv.DictReader(io.StringIO(text))}
    assert rows["setting", "k1"]["value"] == "-0.3"
    assert float(rows["readout", "corner"]["value"]) == -60.0
    assert rows["readout", "corner"]["unit"] == "px"
    saves_a_picture_at_twice_its_size_with_its_drawing(figure)
    saves_a_drawing_as_svg_that_needs_no_style_sheet(figure)


def saves_a_picture_at_twice_its_size_with_its_drawing(figure: Locator) -> None:
    view = figure.locator('[data-panel="picture"] .panel-view')
    with Image.open(saved(figure, '[data-save-panel="picture"]')) as picture:
        assert picture.format == "PNG"
        assert picture.size == tuple(view.evaluate("v => [2 * v.clientWidth, 2 * v.clientHeight]"))
        colours = set(picture.convert("RGB").get_flattened_data())
    error = figure.locator('[data-panel="picture"] .overlay .error').first
    painted = error.evaluate("element => getComputedStyle(element).color")
    assert tuple(int(part) for part in re.findall(r"\d+", painted)) in colours


def saves_a_drawing_as_svg_that_needs_no_style_sheet(figure: Locator) -> None:
    drawing = saved(figure, '[data-save-panel="grid"]').read_text(encoding="utf-8")
    assert "class=" not in drawing
    assert "data:font/woff2" in drawing or "data:application" in drawing
    stroke = figure.locator('[data-panel="grid"] .overlay .image').first.evaluate(
        "element => getComputedStyle(element).stroke"
    )
    assert stroke in drawing


def test_full_screen_shows_the_figure_alone_until_it_is_left(
    guest: Reader, figure: Locator
) -> None:
    button = figure.locator("[data-full-screen]")
    said = button.inner_text()
    width = figure.locator(".panel-view").first.evaluate("view => view.clientWidth")
    button.click()
    guest.page.wait_for_function(f"document.fullscreenElement?.id === '{ID}'")
    expect(button).not_to_have_text(said)
    lead = figure.locator(".panel-view").first
    assert lead.evaluate("view => view.clientWidth") > width
    guest.page.evaluate("document.exitFullscreen()")  # as a browser's Escape does
    expect(button).to_have_text(said)


def test_the_line_of_tools_stays_as_it_is_when_a_fold_opens(figure: Locator) -> None:
    places = """figure => [...figure.querySelectorAll("summary, .tools > button, .open-python")]
      .map(one => [one.offsetLeft, one.offsetTop - figure.offsetTop])"""
    fold = "(figure, open) => figure.querySelectorAll('details').forEach(d => { d.open = open; })"
    figure.evaluate(fold, False)
    before = figure.evaluate(places)
    figure.evaluate(fold, True)
    assert figure.evaluate(places) == before
    height = "report => report.lastElementChild.getBoundingClientRect().height"
    assert figure.locator(".stage-report").evaluate(height) > 0


def test_the_tools_are_reached_by_keyboard(guest: Reader, figure: Locator) -> None:
    summary = figure.locator(".share > summary")
    summary.focus()
    guest.page.keyboard.press("Tab")
    assert figure.locator("[data-copy-link]").evaluate("b => b === document.activeElement")
    guest.page.keyboard.press("Enter")
    figure.locator(".tools-said", has_text="copied").wait_for()


def test_words_and_readouts_light_up_what_has_their_colour(guest: Reader, figure: Locator) -> None:
    caption = guest.page.locator(f"#{ID} .figure-caption")
    lit = "([element, role]) => (element.dataset.lit ?? '') === role"
    for pointed, role in [
        (caption.locator(".role-world"), "world"),
        (figure.locator(".readout.role-ray"), "ray"),
    ]:
        pointed.hover()
        for element in (figure, guest.page.locator("article.chapter")):
            guest.page.wait_for_function(lit, arg=[element.element_handle(), role])
        guest.page.mouse.move(0, 0)
        guest.page.wait_for_function(lit, arg=[figure.element_handle(), ""])
    caption.locator(".role-image").hover()
    guest.page.wait_for_function(lit, arg=[figure.element_handle(), "image"])
    faded = "element => getComputedStyle(element).opacity !== '1'"
    guest.page.wait_for_function(
        faded, arg=figure.locator(".overlay > .camera").first.element_handle()
    )


def test_the_error_is_measured_only_while_it_is_shown(visitor: Reader) -> None:
    visitor.turn_to(CHAPTER)
    figure = visitor.figure("lens-distortion")
    accuracy = figure.locator(".accuracy")
    assert figure.locator(".accuracy-value").text_content() == "…"
    figure.locator(".stage-report > summary").click()
    visitor.page.wait_for_function(
        "line => line.dataset.judged === 'true'", arg=accuracy.element_handle()
    )
    assert figure.locator(".accuracy-value").inner_text() != "…"


def test_numbers_can_be_heard_and_do_not_speak_while_they_change(plain_reader: Reader) -> None:
    plain_reader.open(CHAPTER, live=False)
    figure = plain_reader.figure("lens-distortion")
    readouts = figure.locator(".readouts").first
    heard = readouts.aria_snapshot()
    assert "status" not in heard
    assert "paragraph" in heard, "Firefox tells of no flexible box without a role"
    assert readouts.locator("output").first.inner_text() in heard
    panels = figure.locator(".panels")
    assert panels.locator("svg text").count() > 0
    assert "text:" not in panels.aria_snapshot(), "of drawings, only their names"
