"""The field that filters the tables of hard cases."""

import pytest
from playwright.sync_api import expect
from support.reader import Reader

pytestmark = pytest.mark.browser


def test_only_the_cases_with_every_typed_word_are_shown(plain_reader: Reader) -> None:
    plain_reader.open("where-the-models-break/", live=False)
    field = plain_reader.page.get_by_role("searchbox", name="Filter the cases")
    field.fill("quaternion zero")
    rows = plain_reader.page.locator(".extremes tbody tr").locator("visible=true")
    expect(rows).not_to_have_count(0)
    for text in rows.all_inner_texts():
        assert "quaternion" in text.lower()
        assert "zero" in text.lower()
    count = plain_reader.page.locator(".case-filter [role=status]")
    expect(count).to_have_text(f"{rows.count()} case{'s' if rows.count() > 1 else ''}")
    tables = plain_reader.page.locator("details.extremes")
    field.fill("no such case")
    expect(tables.locator("visible=true")).to_have_count(0)
    field.fill("")
    expect(tables.locator("visible=true")).to_have_count(tables.count())
    expect(plain_reader.page.locator("details.extremes[open]")).to_have_count(0)
