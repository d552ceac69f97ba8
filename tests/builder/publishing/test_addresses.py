"""Addresses as an author writes them."""

import pytest

from site_builder.settings.addresses import site_address, source_address


@pytest.mark.parametrize("given", ["https://host.example/book", "https://host.example/book/"])
def test_an_address_ends_in_a_slash(given: str) -> None:
    assert site_address(given) == "https://host.example/book/"


@pytest.mark.parametrize(
    "given",
    [
        *("host.example", "ftp://host.example/", "https:///book", "https://host/?a=1"),
        *(
            'https://host/"><script>',
            "https://host/a b",
            "https://host/\n",
            3,
            None,
            ["https://h/"],
        ),
        "javascript://host/%0aalert(1)",
    ],
)
def test_what_is_no_address_is_refused(given: object) -> None:
    with pytest.raises(ValueError, match="legal: 'https://host/'"):
        site_address(given)


@pytest.mark.parametrize(
    "given", ["https://host/", "{path}", "https://host/{path}/{path}", "javascript:{path}", 1]
)
def test_an_address_of_sources_has_one_place_for_a_path(given: object) -> None:
    with pytest.raises(ValueError, match=r"with \{path\} once"):
        source_address(given)


def test_without_an_address_there_is_none() -> None:
    assert (site_address(""), source_address("")) == ("", "")
