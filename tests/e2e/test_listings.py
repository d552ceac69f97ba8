"""Functions quoted in a chapter: the code in sight, the docstring in a fold."""

import pytest
from playwright.sync_api import expect
from support.reader import Reader

pytestmark = pytest.mark.browser


def test_the_docstring_of_a_function_is_folded_and_its_code_is_not(plain_reader: Reader) -> None:
    plain_reader.open("2d-transformations/", live=False)
    listing = plain_reader.page.locator(".source", has_text="apply_homography").first
    docstring = listing.locator(".docstring pre")
    expect(docstring).to_be_hidden()
    expect(listing.locator("> pre").first).to_contain_text("def apply_homography")
    expect(listing.locator("> pre").last).to_contain_text("return")
    listing.locator("summary").press("Enter")
    expect(docstring).to_be_visible()
    expect(docstring).to_contain_text('"""')
