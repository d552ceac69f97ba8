"""Where the links of the site's pages lead on paper."""

import pytest

from site_builder.editions.links import Place, is_external, place_of

PAGES = ("first", "second", "references")


@pytest.mark.parametrize(
    ("address", "place"),
    [
        ("#here", Place("first", "here")),
        ("../second/", Place("second", "")),
        ("../second/#there", Place("second", "there")),
        ("?figure.k1=1#figure", Place("first", "figure")),
        ("../second/?figure.k1=1#figure", Place("second", "figure")),
        ("../second/#moir%C3%A9", Place("second", "moiré")),
        ("../source/simulations/x/#L3", None),
    ],
)
def test_a_link_leads_to_a_place_of_the_book_or_to_none(address: str, place: Place | None) -> None:
    assert place_of(address, "first", PAGES) == place


@pytest.mark.parametrize(
    ("address", "external"), [("https://doi.org/1", True), ("mailto:a@b", True), ("../x/", False)]
)
def test_what_has_a_scheme_leads_out_of_the_book(address: str, external: bool) -> None:
    assert is_external(address) is external
