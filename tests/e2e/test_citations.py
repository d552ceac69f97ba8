"""Links into the text: to a section, from a citation to its work and back."""

import pytest
from playwright.sync_api import expect
from support.reader import Reader

pytestmark = pytest.mark.browser

IN_VIEW = """(id) => {
  const {top, bottom} = document.getElementById(id)?.getBoundingClientRect() ?? {top: -1};
  return top >= 0 && bottom <= innerHeight;
}"""


def test_a_citation_leads_to_its_work_and_back_and_keys_show_a_section_s_link(
    plain_reader: Reader,
) -> None:
    page = plain_reader.page
    plain_reader.open("lens-distortion/", live=False)
    citation = page.locator("a.citation").first
    key = (citation.get_attribute("href") or "").partition("#")[2]
    place = citation.get_attribute("id")
    citation.click()
    page.wait_for_function(IN_VIEW, arg=key)
    page.locator(f'#{key} a[href$="lens-distortion/#{place}"]').click()
    page.wait_for_function(IN_VIEW, arg=place)
    link = page.locator("a.anchor").first
    expect(link).to_have_css("opacity", "0")
    link.focus()
    page.keyboard.press("Shift+Tab")
    page.keyboard.press("Tab")
    expect(link).to_have_css("opacity", "1")
    page.keyboard.press("Enter")
    page.wait_for_function("href => location.hash === href", arg=link.get_attribute("href"))
