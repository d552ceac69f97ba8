"""The glossary: what its file must say, where terms are marked, and the pages that list them."""

from collections.abc import Callable, Sequence
from dataclasses import replace

import pytest
from support.html_outline import Page, read_html
from support.little_book import rendered

from site_builder.build import Options, check_site
from site_builder.diagnostics import Diagnostic
from site_builder.references.glossary import Glossary, Term

type MakeBook = Callable[..., Options]

FILE = "content/glossary.toml"
GLOSSARY = """\
[pose]
says = "Where a camera *is*, by $R$."
explained = "first#poses"
related = ["field of view"]

["field of view"]
says = "What is seen."
explained = "first"
also = ["FOV"]
words = ["field of view", "fields of view", "FOV"]
"""
BODY = """
The field of view of a Pose, and a pose.

## Poses

Fields of view and **poses**; a composed pose.
"""


def built(make_book: MakeBook, body: str = BODY) -> dict[str, Page]:
    site = rendered(make_book(body, {FILE: GLOSSARY}))
    pages = [path for path in site if path.endswith("index.html")]
    return {path.removesuffix("/index.html"): read_html(site[path]) for path in pages}


def marks(page: Page) -> list[str]:
    return [mark.text for mark in page.all("a", "term")]


@pytest.mark.parametrize(
    ("words", "text", "found"),
    [
        ((), "Poses: a pose, posed, re-pose.", ["Poses", "pose"]),
        (("posed",), "A pose was Posed.", ["Posed"]),
    ],
)
def test_a_name_its_plural_and_the_words_given_instead_are_uses(
    words: Sequence[str], text: str, found: list[str]
) -> None:
    glossary = Glossary({"pose": Term("pose", "", "", words=tuple(words))})
    assert [text[start:end] for _, start, end in glossary.uses(text)] == found


def test_of_two_terms_at_one_place_the_longer_is_used() -> None:
    terms = [Term("aliasing", "", ""), Term("anti-aliasing filter", "", "")]
    glossary = Glossary({term.name: term for term in terms})
    assert [term.name for term, *_ in glossary.uses("An anti-aliasing filter.")] == [
        "anti-aliasing filter"
    ]


def test_the_first_use_in_a_chapter_is_marked_and_tells_its_definition(
    make_book: MakeBook,
) -> None:
    page = built(make_book)["first"]
    assert marks(page) == ["field of view", "Pose"]
    (mark, other) = page.all("a", "term")
    assert mark.attributes["href"] == "../glossary/#field-of-view"
    definitions = page.all("div", "definition")
    described = {term.attributes["aria-describedby"] for term in (mark, other)}
    assert {item.attributes["id"] for item in definitions} == described
    assert all("popover" in item.attributes for item in definitions)


def test_no_heading_link_question_or_control_is_marked(make_book: MakeBook) -> None:
    body = (
        "\n[A pose](#pose). Set **Pose** to 1. The field of view.\n\n## Pose\n\n"
        ":::{quiz} q\nA pose?\n- [x] Pose\n  : Pose.\n- [ ] No\n  : No.\n:::\n\nThe last pose.\n"
    )
    text = GLOSSARY.replace("first#poses", "first#pose")
    page = read_html(rendered(make_book(body, {FILE: text}))["first/index.html"])
    assert marks(page) == ["field of view", "pose"]


def test_authors_may_mark_a_term_and_leave_one_unmarked(make_book: MakeBook) -> None:
    body = f"\nA {{term}}`pose <none>`, its {{term}}`attitude <pose>`.\n{BODY}"
    assert marks(built(make_book, body)["first"])[0] == "attitude"


def test_the_glossary_names_the_places_of_each_term(make_book: MakeBook) -> None:
    page = built(make_book)["glossary"]
    links = {link.text: link.attributes["href"] for link in page.all("a")}
    assert links["Poses"] == "../first/#poses"
    assert links["field of view"] == "#field-of-view"


def test_the_index_has_other_names_and_what_authors_mark(make_book: MakeBook) -> None:
    page = built(make_book, f"{BODY}\nThe {{index}}`camera obscura <box>`.\n")["index-of-terms"]
    names = [name.text for name in page.all("dt") if "article" in name.inside]
    assert names == ["box", "field of view", "FOV", "pose"]
    links = [link.attributes["href"] for link in page.all("a")]
    assert "../first/#index-box" in links
    assert links.count("../first/#poses") == 1


@pytest.mark.parametrize(
    ("text", "warned"),
    [
        ("A pose.\n\n## Poses\n\nThe **pose**.\n", True),
        ("## Poses\n\nThe **pose**.\n\n## Later\n\nA pose.\n", False),
        ("A {term}`pose`.\n\n## Poses\n\nThe **pose**.\n", False),
    ],
)
def test_a_term_used_before_its_explanation_is_warned_of_unless_it_is_marked(
    make_book: MakeBook, text: str, warned: bool
) -> None:
    glossary = '[pose]\nsays = "Where it is."\nexplained = "first#poses"\n'
    found: list[Diagnostic] = []
    check_site(replace(make_book(text, {FILE: glossary}), warn=found.append))
    assert ["'pose' is used before" in one.message for one in found] == [True] * warned
