"""Parts of a figure: what moves in one moves in the others, by one call of the worker."""

import pytest
from playwright.sync_api import expect
from support.reader import Reader

pytestmark = pytest.mark.browser

CHAPTER, LEADER, PART = "lens-distortion/", "figure-lens-distortion", "figure-the-curve"
COUNT_RENDERS = """async () => {
  const runtime = (await customElements.whenDefined('simulation-figure')).internals.sharedRuntime();
  const usual = Object.getPrototypeOf(runtime).call;
  window.renders = 0;
  runtime.call = function (call, ...given) {
    window.renders += Number(call === 'render');
    return usual.call(this, call, ...given);
  };
}"""


def test_leader_and_part_show_one_frame_whichever_is_moved(visitor: Reader) -> None:
    """By hand, key, link, reset, Back and address, which names the leader alone."""
    page = visitor.page
    visitor.turn_to(CHAPTER)
    leader, part = (page.locator(f"#{place} simulation-figure") for place in (LEADER, PART))
    visitor.settle(leader)
    page.evaluate(COUNT_RENDERS)
    shown: list[object] = []

    def assert_both_show(k1: str) -> None:
        visitor.settle(leader)
        assert leader.locator("[name=k1]").input_value() == k1
        assert part.get_attribute("data-frames") == leader.get_attribute("data-frames")
        now = [visitor.content(figure) for figure in (leader, part)]
        assert all(one["drawings"] for one in now)
        assert now not in shown
        shown.append(now)

    assert_both_show("0")
    page.emulate_media(reduced_motion="reduce")  # no glides
    frames = visitor.frames(leader)
    leader.locator("[name=k1]").fill("-0.3")
    assert_both_show("-0.3")
    assert page.evaluate("window.renders") == visitor.frames(leader) - frames
    handle = part.locator("[data-handle]:not([hidden])").first
    visitor.scroll_to(handle)
    x, y = visitor.middle(handle)
    visitor.drag((x, y), (x, y - 40), steps=3)
    visitor.settle(leader)
    dragged = leader.locator("[name=k1]").input_value()
    assert float(dragged) > -0.3
    assert_both_show(dragged)
    page.wait_for_function(f"location.search === '?{LEADER}.k1={dragged}'")
    page.locator(f"a.set[data-figure={PART}]").first.click()
    assert_both_show("-0.2")
    expect(part.locator(".panels")).to_be_in_viewport(ratio=0.5)
    page.go_back()
    expect(leader.locator("[name=k1]")).to_have_value(dragged)
    part.locator("[data-further]").click()  # the tools of a narrow figure
    part.locator("[data-reset]").click()
    expect(leader.locator("[name=k1]")).to_have_value("0")
    address = f"{CHAPTER}?{LEADER}.k1=0.2&{PART}.k1=0.4#{PART}"
    visitor.turn_to_unlinked(address)
    assert_both_show("0.2")
    page.emulate_media(reduced_motion="null")


def test_controls_of_a_part_move_those_of_its_leader_and_follow_them(visitor: Reader) -> None:
    visitor.turn_to("sampling-and-aliasing/")
    page = visitor.page
    leader, part = (
        page.locator(f"#figure-{name} simulation-figure")
        for name in ("slanted-edge", "line-and-wave")
    )
    contrast = part.locator("output[name=contrast]")
    before = contrast.inner_text()
    with visitor.next_frame(leader):
        part.locator("[name=wave]").fill("0.6")
    assert leader.locator("[name=wave]").input_value() == "0.6"
    assert contrast.inner_text() == leader.locator("output[name=contrast]").text_content() != before
    aperture = leader.locator("[name=aperture]")
    with visitor.next_frame(part):
        aperture.fill("16")
    for shown in (leader, part):
        assert shown.locator("[name=aperture]").input_value() == "16"
        value = shown.locator(".control:has([name=aperture]) .control-value")
        assert value.text_content() == "f/16.0"
