"""The tools of a figure: its link, reset, full screen, files, embedding, and the reader's own
picture."""

import csv
import io
import re
from pathlib import Path
from typing import Any

import pytest
from PIL import Image
from playwright.sync_api import Browser, FilePayload, Locator, expect
from support.reader import Reader
from support.static_server import serving

from site_builder.publishing.hosting import common_policy, frame_rule
from site_builder.settings.model import Publishing

pytestmark = pytest.mark.browser

CHAPTER = "lens-distortion/"
ID = "figure-lens-distortion"


@pytest.fixture
def tools(guest: Reader, figure: Locator) -> Locator:
    """The figure with a changed setting and its list of tools open."""
    guest.page.context.grant_permissions(["clipboard-read", "clipboard-write"])
    figure.locator("[name=k1]").fill("-0.3")
    guest.page.wait_for_function("location.search.includes('k1=-0.3')")
    guest.settle(figure)
    figure.locator(".share").evaluate("tools => { tools.open = true; }")
    return figure


def save(figure: Locator, button: str) -> Path:
    with figure.page.expect_download() as download:
        figure.locator(button).click()
    path = download.value.path()
    return path.rename(path.with_name(download.value.suggested_filename))


def test_figure_tools_copy_its_link_reset_it_and_fill_the_screen(
    guest: Reader, tools: Locator
) -> None:
    page = guest.page
    tools.locator("[data-copy-link]").focus()
    page.keyboard.press("Enter")
    tools.locator(".tools-status", has_text="copied").wait_for()
    link = page.evaluate("navigator.clipboard.readText()")
    assert link == f"{guest.root}{CHAPTER}?{ID}.k1=-0.3#{ID}"
    page.evaluate(
        "() => { navigator.clipboard.writeText = () => Promise.reject(new Error('no')); }"
    )
    tools.locator("[data-copy-link]").click()
    field = tools.locator(".copied")
    field.wait_for()  # the link is shown to be copied manually
    page.evaluate("delete navigator.clipboard.writeText")
    assert field.input_value().endswith(f"?{ID}.k1=-0.3#{ID}")

    page.emulate_media(reduced_motion="reduce")
    start = tools.locator("script.schema").evaluate("it => `${JSON.parse(it.text).values.k1}`")
    tools.locator("[data-reset]").click()
    expect(tools.locator("[name=k1]")).to_have_value(start)
    page.wait_for_function("location.search === ''")
    page.go_back()
    expect(tools.locator("[name=k1]")).to_have_value("-0.3")

    button, lead = tools.locator("[data-full-screen]"), tools.locator(".panel-view").first
    label, width = button.inner_text(), lead.evaluate("view => view.clientWidth")
    button.click()
    page.wait_for_function(f"document.fullscreenElement?.id === '{ID}'")
    expect(button).not_to_have_text(label)
    assert lead.evaluate("view => view.clientWidth") > width
    page.evaluate("document.exitFullscreen()")  # as a browser's Escape does
    expect(button).to_have_text(label)

    places = """figure => [...figure.querySelectorAll("summary, .tools > button, .open-python")]
      .map(one => [one.offsetLeft, one.offsetTop - figure.offsetTop])"""
    fold = "(figure, open) => figure.querySelectorAll('details').forEach(d => { d.open = open; })"
    tools.evaluate(fold, False)
    before = tools.evaluate(places)
    tools.evaluate(fold, True)
    assert tools.evaluate(places) == before, "the line of tools stays when a fold opens"
    expect(tools.locator(".stage-report > :last-child")).to_be_visible()


def test_numbers_pictures_and_drawings_are_saved(tools: Locator) -> None:
    """Numbers with their settings, a picture with its drawing at twice its size, and a drawing that
    needs no style sheet."""
    text = save(tools, "[data-save-numbers]").read_text(encoding="utf-8")
    rows = {(row["kind"], row["name"]): row for row in csv.DictReader(io.StringIO(text))}
    assert rows["setting", "k1"]["value"] == "-0.3"
    assert float(rows["readout", "corner"]["value"]) == -60.0
    assert rows["readout", "corner"]["unit"] == "px"
    view = tools.locator('[data-panel="picture"] .panel-view')
    with Image.open(save(tools, '[data-save-panel="picture"]')) as picture:
        assert picture.format == "PNG"
        assert picture.size == tuple(view.evaluate("v => [2 * v.clientWidth, 2 * v.clientHeight]"))
        colours = set(picture.convert("RGB").get_flattened_data())
    error = tools.locator('[data-panel="picture"] .overlay .error').first
    painted = error.evaluate("element => getComputedStyle(element).color")
    assert tuple(int(part) for part in re.findall(r"\d+", painted)) in colours
    drawing = save(tools, '[data-save-panel="grid"]').read_text(encoding="utf-8")
    assert "class=" not in drawing
    assert "data:font/woff2" in drawing or "data:application" in drawing
    stroke = tools.locator('[data-panel="grid"] .overlay .image').first.evaluate(
        "element => getComputedStyle(element).stroke"
    )
    assert stroke in drawing


def test_embedded_figure_works_in_a_page_of_another_origin(
    guest: Reader, tools: Locator, baseline_chromium: Browser, built_site: Path, tmp_path: Path
) -> None:
    tools.locator("[data-copy-embed]").click()
    tools.locator(".tools-status", has_text="copied").wait_for()
    html = guest.page.evaluate("navigator.clipboard.readText()")
    assert f'src="{guest.root}embed/{CHAPTER}{ID}/?k1=-0.3"' in html
    pages = [page.read_bytes() for page in built_site.rglob("*.html")]
    policy = f"{common_policy(pages)}; {frame_rule(Publishing().frames)}"
    requests: list[str] = []
    errors: list[str] = []
    with (
        serving(tmp_path) as course,
        serving(built_site, {"Content-Security-Policy": policy}) as book,
        baseline_chromium.new_context(viewport={"width": 1440, "height": 900}) as context,
    ):
        frame = html.replace(guest.root, book.url)
        (tmp_path / "index.html").write_text(f"<!DOCTYPE html><link rel=icon href=data:,>{frame}")
        page = context.new_page()
        context.on("request", lambda request: requests.append(request.url))
        page.on("pageerror", lambda error: errors.append(str(error)))
        page.on(
            "console", lambda message: errors.extend([message.text] * (message.type == "error"))
        )
        page.goto(course.url)
        inside = page.frame_locator("iframe")
        expect(inside.locator("simulation-figure")).to_have_attribute("data-state", "live")
        assert inside.locator("[name=k1]").input_value() == "-0.3"
        inside.locator("[name=k1]").fill("0.1")
        expect(inside.locator("output[name=corner]")).to_have_text("20.0")
        embedded = page.frames[1]
        box = embedded.locator("figure").bounding_box()
        assert box is not None
        assert box["x"] + box["width"] / 2 == pytest.approx(720, abs=10), "in the middle"
        embedded.wait_for_url("**/?k1=0.1")
        embedded.goto(f"{embedded.url}&k9=1")
        expect(inside.locator(".figure-message", has_text="k9=1")).to_be_visible()
        assert errors == []
        outside = {url for url in requests if not url.startswith((book.url, "data:", "blob:"))}
        assert outside == {course.url}


RED, GLASS, WHITE = (200, 0, 0, 255), (0, 0, 0, 0), [255] * 4
MIDDLE_PIXEL = """(figure) => {
  const canvas = figure.querySelector('[data-panel="picture"] canvas');
  const [x, y] = [canvas.width >> 1, canvas.height >> 1];
  return [...canvas.getContext('2d').getImageData(x, y, 1, 1).data];
}"""


def picture(width: int, height: int, colour: tuple[int, ...], name: str = "own.png") -> FilePayload:
    buffer = io.BytesIO()
    Image.new("RGBA", (width, height), colour).save(buffer, "PNG")
    return FilePayload(name=name, mimeType="image/png", buffer=buffer.getvalue())


def test_figure_shows_the_readers_picture_and_then_the_books_again(
    guest: Reader, figure: Locator
) -> None:
    """By the button and by the menu of pictures; a file that is no picture is refused."""

    def choose(file: FilePayload) -> Any:
        with guest.next_frame(figure):
            figure.locator("input[type=file]").set_input_files([file])
        return figure.evaluate(MIDDLE_PIXEL)

    with guest.next_frame(figure):  # the browser's, which may be a code off the page's
        figure.locator("[name=k1]").fill("-0.01")
    guest.settle(figure)
    before = figure.evaluate(MIDDLE_PIXEL)
    away = figure.get_by_role("button", name="The book’s picture")
    cropped = figure.locator(".photograph-cropped")
    assert choose(picture(640, 480, RED)) == [*RED]
    expect(cropped).to_be_hidden()
    with guest.next_frame(figure):
        away.click()
    assert figure.evaluate(MIDDLE_PIXEL) == before
    expect(away).to_be_hidden()
    assert choose(picture(640, 640, RED)) == [*RED]
    expect(cropped).to_be_visible()
    assert choose(picture(640, 480, GLASS)) == WHITE, "what is transparent"
    guest.open_controls(figure)
    with guest.next_frame(figure):
        figure.locator("select[name=picture]").select_option(index=1)
    guest.settle(figure)
    assert figure.evaluate(MIDDLE_PIXEL) not in (WHITE, [*RED])
    expect(away).to_be_hidden()
    none = FilePayload(name="notes.png", mimeType="image/png", buffer=b"no picture at all")
    for file, words in (
        (none, "Can’t open “notes.png”"),
        (picture(8, 8, RED, "dot.png"), "“dot.png” has 8 × 8 pixels; it needs at least 16"),
    ):
        figure.locator("input[type=file]").set_input_files([file])
        expect(figure.locator(".figure-message")).to_contain_text(words)
        expect(figure).to_have_attribute("data-state", "live")
