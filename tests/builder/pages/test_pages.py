"""The pages of a small book: well formed, complete without scripts, and as the contract says."""

import json
from collections.abc import Callable, Mapping
from itertools import pairwise
from pathlib import Path, PurePosixPath

import pytest
from support.html_outline import Page, read_html

from site_builder.build import Options, render_site
from site_builder.output.assets import content_bytes
from site_builder.pages.licences import gather_licences
from site_builder.runtime.pinned import VERSIONS

BODY = """
## Start

See [the second](01-second.md#a-section) or [this section](#start).

:::{simulation} demo
:k1: -0.25
:tier: fast
A caption with $k_1$.
:::

:::{note}
What happens at zero?

:::{simulation} demo
Again.
:::
:::

:::{quiz} first-quiz
How many "degrees"?

- [ ] 4
  : A similarity: less than `</script>` four.
- [x] 6
  : Yes.
:::

:::{example} By hand
Twice two is four.[^note]
:::

:::{source} simulations.models.thing:double
It doubles.
:::

:::{figure} images/plan.svg
:alt: A plan
A *plan*.
:::

:::{table} Two columns
| a | b |
|---|---|
| 1 | 2 |
:::

### Detail

[^note]: Check it.
"""


@pytest.fixture
def site(make_book: Callable[..., Options]) -> Mapping[str, bytes]:
    files = render_site(make_book(BODY))
    return {path: content_bytes(content) for path, content in files.items()}


@pytest.fixture
def chapter(site: Mapping[str, bytes]) -> Page:
    return read_html(site["first/index.html"])


def test_all_pages_are_well_formed(site: Mapping[str, bytes]) -> None:
    pages = [path for path in site if path.endswith(".html")]
    assert set(pages) == {
        "404.html",
        "first/index.html",
        "index.html",
        "licences/index.html",
        "second/index.html",
        "source/simulations/models/thing/index.html",
    }
    for path in pages:
        read_html(site[path])


def test_every_relative_address_leads_to_a_file_or_an_element(site: Mapping[str, bytes]) -> None:
    for path in (path for path in site if path.endswith("index.html")):
        page = read_html(site[path])
        for address in page.addresses():
            if address.startswith(("https://", "data:")):
                continue
            file, _, anchor = address.partition("#")
            target = _resolve(path, file)
            assert target in site, f"{path}: {address}"
            ids = (
                {item.attributes.get("id") for item in read_html(site[target]).elements}
                if anchor
                else {anchor}
            )
            assert anchor in ids, f"{path}: {address}"  # fmt: skip


def _resolve(page: str, file: str) -> str:
    parts: list[str] = []
    for part in (*PurePosixPath(page).parent.parts, *file.split("/")) if file else page.split("/"):
        if part == "..":
            parts.pop()
        elif part not in ("", "."):
            parts.append(part)
    target = "/".join(parts)
    return target if "." in PurePosixPath(target).name else f"{target}/index.html".lstrip("/")


def test_headings_never_skip_a_level(site: Mapping[str, bytes]) -> None:
    for path in (path for path in site if path.endswith("index.html")):
        levels = [
            int(e.tag[1])
            for e in read_html(site[path]).elements
            if e.tag in ("h1", "h2", "h3", "h4")
        ]
        assert levels[0] == 1, path
        assert levels.count(1) == 1, path
        assert all(b <= a + 1 for a, b in pairwise(levels)), path  # fmt: skip


def test_a_figure_shows_its_still_its_numbers_and_its_controls(
    chapter: Page, site: Mapping[str, bytes]
) -> None:
    figure = chapter.all("simulation-figure")[0].attributes
    assert figure == {"data-simulation": "demo", "data-state": "still", "data-frames": "0"}
    still = chapter.all("img", "still")[0].attributes["src"] or ""
    assert site[_resolve("first/index.html", still)].startswith(b"RIFF")
    assert [item.text for item in chapter.all("output")[:2]] == [
        "\u22120.25",
        "1.00 0.00\n0.00 1.00",
    ]
    assert chapter.all("p", "description")[0].text == "Shows k1 of -0.25 in tier fast."
    slider = next(e for e in chapter.all("input") if e.attributes["name"] == "k1").attributes
    assert (slider["min"], slider["max"], slider["value"]) == ("-0.5", "0.5", "-0.25")
    assert chapter.all("span", "control-value")[0].text == "\u22120.25\u00a0px"
    names = [
        e.attributes["name"]
        for e in chapter.elements
        if "name" in e.attributes and "form" in e.inside
    ]
    assert names[:5] == ["k1", "kind", "on", "play", "tier"]  # fmt: skip


def test_a_scene_shown_twice_gets_two_ids(chapter: Page) -> None:
    ids = [figure.attributes["id"] for figure in chapter.all("figure", "simulation")]
    assert ids == ["figure-demo", "figure-demo-2"]


def test_the_schema_in_the_page_holds_controls_values_and_tiers(chapter: Page) -> None:
    schema = json.loads(chapter.all("script", "schema")[0].text)
    assert schema["values"] == {"k1": -0.25, "kind": "a", "on": False, "play": 0}
    assert schema["tiers"] == ["fast", "exact"]
    assert (schema["default_tier"], schema["draft_tier"]) == ("fast", "fast")
    assert [control["kind"] for control in schema["controls"]] == [
        "slider", "choice", "toggle", "action",
    ]  # fmt: skip


def test_a_quiz_can_be_answered_by_keyboard_and_read_by_its_script(chapter: Page) -> None:
    form = chapter.all("form", "quiz")[0]
    assert form.attributes["data-quiz"] == "first-quiz"
    answers = [e.attributes for e in chapter.all("input") if e.attributes["name"] == "answer"]
    assert [(a["type"], a["value"]) for a in answers] == [("radio", "0"), ("radio", "1")]
    data = json.loads(chapter.all("script", "quiz-data")[0].text)
    assert [option["correct"] for option in data["options"]] == [False, True]
    assert data["options"][1]["explanation_html"] == "Yes."
    assert chapter.all("legend")[0].text == "How many “degrees”?"


def test_chapters_are_linked_in_order(site: Mapping[str, bytes]) -> None:
    first, second = (read_html(site[f"{name}/index.html"]) for name in ("first", "second"))
    following = [a.attributes["href"] for a in first.all("a") if a.attributes.get("rel") == "next"]
    previous = [a.attributes["href"] for a in second.all("a") if a.attributes.get("rel") == "prev"]
    assert (following, previous) == (["../second/"], ["../first/"])


def test_the_catalogue_lists_chapters_simulations_and_quizzes(site: Mapping[str, bytes]) -> None:
    book = json.loads(site["book.json"])
    assert [(c["number"], c["id"], c["url"]) for c in book["chapters"]] == [
        (0, "first", "first/"), (1, "second", "second/"),
    ]  # fmt: skip
    assert book["chapters"][0]["simulations"] == ["demo"]
    assert book["chapters"][0]["quizzes"] == ["first-quiz"]
    assert [control["name"] for control in book["simulations"][0]["controls"]] == [
        "k1", "kind", "on", "play",
    ]  # fmt: skip
    quiz = book["quizzes"][0]
    assert (quiz["id"], quiz["chapter"], quiz["kind"]) == ("first-quiz", "first", "single")
    assert quiz["options"] == [{"text": "4", "correct": False}, {"text": "6", "correct": True}]


def test_a_page_loads_nothing_from_elsewhere(site: Mapping[str, bytes]) -> None:
    for path in (path for path in site if path.endswith(".html")):
        for element in read_html(site[path]).elements:
            if element.tag != "a":
                for name in ("src", "href"):
                    assert "//" not in (element.attributes.get(name) or ""), path


def test_a_listing_leads_to_its_line_in_the_whole_module(
    chapter: Page, site: Mapping[str, bytes]
) -> None:
    caption = chapter.all("code", "path")[0]
    assert caption.text == "simulations/models/thing.py"
    code = chapter.all("pre", "code")[0]
    assert "figure" in code.inside
    module = read_html(site["source/simulations/models/thing/index.html"])
    lines = [line.attributes["id"] for line in module.all("span", "line")]
    assert lines == [f"L{number}" for number in range(1, 9)]


def test_a_picture_stands_with_its_words_and_its_file(
    chapter: Page, site: Mapping[str, bytes]
) -> None:
    (picture,) = (item for item in chapter.all("img") if item.attributes["alt"] == "A plan")
    assert "figure" in picture.inside
    assert site[_resolve("first/index.html", picture.attributes["src"] or "")].startswith(b"<svg ")


OF_THE_RUNTIME = (
    "Mozilla Public License Version 2.0",
    "PYTHON SOFTWARE FOUNDATION LICENSE",
    "NumPy Developers",
)


def test_licences_of_what_is_shipped_are_given_in_full(site: Mapping[str, bytes]) -> None:
    page = site["licences/index.html"].decode()
    assert "SIL OPEN FONT LICENSE" in page
    assert [phrase for phrase in OF_THE_RUNTIME if phrase in page] == []


def test_those_of_the_interpreter_are_given_where_it_is_shipped() -> None:
    told = "".join(licence.text for licence in gather_licences(Path(), VERSIONS))
    assert [phrase for phrase in OF_THE_RUNTIME if phrase not in told] == []
