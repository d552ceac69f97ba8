"""The book's style sheets are joined into the one that pages link to."""

import pytest

from site_builder.diagnostics.diagnostic import BuildError
from site_builder.output.style_sheets import join_style_sheets

ENTRY = "css/book.css"


def test_imported_sheets_stand_in_the_place_of_their_imports_and_are_left_out() -> None:
    files = {
        ENTRY: b'/* All. */\n@import "a.css";\n@import "b.css";\nlast {}\n',
        "css/a.css": b"a { background: url(../x.png) }\n",
        "css/b.css": b"b {}\n",
        "js/main.js": b"",
    }
    joined = join_style_sheets(files, ENTRY)
    assert sorted(joined) == [ENTRY, "js/main.js"]
    assert joined[ENTRY] == b"/* All. */\na { background: url(../x.png) }\nb {}\nlast {}\n"


@pytest.mark.parametrize("name", ["missing.css", "deep/a.css", "../a.css"])
def test_an_import_that_cannot_be_joined_is_named_with_its_line(name: str) -> None:
    files = {
        ENTRY: f'@import "a.css";\n@import "{name}";\n'.encode(),
        "css/a.css": b"",
        "css/deep/a.css": b"",
        "a.css": b"",
    }
    with pytest.raises(BuildError) as caught:
        join_style_sheets(files, ENTRY)
    (found,) = caught.value.diagnostics
    assert str(found).startswith(f"static/css/book.css:2: cannot import {name!r}")
