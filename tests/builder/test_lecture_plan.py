"""The lecturer's plan: named sections, what these show and ask, and mistakes with their place."""

from collections.abc import Callable

from support.html_outline import read_html
from support.little_book import rendered

from site_builder.build import Options

type MakeBook = Callable[..., Options]

ASKED = "What?\n- [x] this\n  : yes\n- [ ] that\n  : no\n:::\n"
FIRST = f"""
## Lines

:::{{simulation}} demo
Here.
:::

:::{{quiz}} within
{ASKED}
## Planes

:::{{simulation}} demo
There.
:::

## Questions

:::{{quiz}} at-the-end
{ASKED}"""
PLAN = """\
intro = "What teaches what."

[[section]]
number = "2.1"
title = "Primitives"
note = "Points and lines."
taught = [
  "first#lines",
]
"""
FILE = "content/lecture-plan.toml"


def test_a_section_is_listed_with_what_it_shows_and_asks_and_no_other(make_book: MakeBook) -> None:
    page = read_html(rendered(make_book(FIRST, {FILE: PLAN}))["lecture-plan/index.html"])
    links = [link.attributes["href"] for link in page.all("a") if "li" in link.inside]
    assert [link for link in links if link and link.startswith("../first/#")] == [
        "../first/#lines",
        "../first/#figure-demo",
        "../first/#quiz-within",
        "../first/#quiz-at-the-end",
    ]


def test_the_contents_lead_to_the_plan_where_there_is_one(make_book: MakeBook) -> None:
    def links(files: dict[str, str]) -> list[str | None]:
        page = read_html(rendered(make_book(FIRST, files))["first/index.html"])
        return [link.attributes.get("href") for link in page.all("a")]

    assert "../lecture-plan/" not in links({})
    assert "../lecture-plan/" in links({FILE: PLAN})
