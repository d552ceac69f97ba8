"""Readers get the scripts of the kinds of questions that their book asks, and no others."""

from collections.abc import Callable, Mapping

import pytest

from site_builder.build import Options, render_site
from site_builder.output.assets import content_bytes

type MakeBook = Callable[..., Options]

OWN_STATIC = (
    "css/book.css",
    "js/main.ts",
    "js/search/ranking.ts",
    "js/search/words.ts",
    "images/favicon.svg",
)
PLAIN = {
    "content/book.toml": 'title = "Plain"\nsubtitle = "Text."\nprerequisites = "None."\n'
    'chapters = ["00-first"]\n',
    "content/01-second.md": None,
    **{f"static/{name}": None for name in OWN_STATIC},
}
QUESTION = ":::{quiz} sum\nOne and one?\n- [x] Two\n  : Yes.\n- [ ] One\n  : No.\n:::\n"


@pytest.fixture(autouse=True)
def bundled() -> None:
    """In place of the fixture of other tests: scripts are bundled as for readers."""


def shipped(options: Options) -> dict[str, str]:
    """Scripts and the style sheet, by their path among the assets."""
    files = render_site(options)
    return {
        name.split("/", 2)[2]: content_bytes(content).decode()
        for name, content in files.items()
        if name.startswith("assets/") and name.endswith((".js", ".css"))
    }


def holds(files: Mapping[str, str], text: str) -> bool:
    return any(text in script for name, script in files.items() if name.endswith(".js"))


def test_a_question_brings_its_own_kind_and_no_other(make_book: MakeBook) -> None:
    files = shipped(make_book(QUESTION, PLAIN))
    assert holds(files, "label.option")
    assert not holds(files, ".grip")
    assert "\n.verdict" in files["css/book.css"]


def test_what_a_script_starts_or_loads_is_shipped_with_it(make_book: MakeBook) -> None:
    files = shipped(make_book(QUESTION + "\n:::{simulation} demo\n:::\n", PLAIN))
    assert holds(files, "LiveFigure")
    assert {"js/runtime/worker.js", "css/workshop.css"} <= set(files)
