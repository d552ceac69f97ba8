"""The plain JavaScript that figures are timed against draws the pictures that they draw."""

from collections.abc import Callable

import pytest
from bench.twins import TWINS, Twin, installed
from playwright.sync_api import Browser

pytestmark = pytest.mark.browser


@pytest.mark.parametrize(
    "make",
    [TWINS[0], *(pytest.param(make, marks=pytest.mark.deep) for make in TWINS[1:])],
    ids=lambda make: make.__name__,
)
def test_a_plain_script_draws_the_picture_of_the_figure(
    chromium: Browser, make: Callable[[], Twin]
) -> None:
    page = chromium.new_page()
    try:
        installed(page, make())  # raises where more than some pixels of an edge differ
    finally:
        page.close()
