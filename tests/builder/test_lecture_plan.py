"""The lecturer's plan: named sections, what these show and ask, and mistakes with their place."""

from collections.abc import Callable

import pytest
from support.html_outline import read_html

from site_builder.build import Options, check_site, render_site
from site_builder.diagnostics import BuildError
from site_builder.output.assets import content_bytes

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
    site = render_site(make_book(FIRST, {FILE: PLAN}))
    page = read_html(content_bytes(site["lecture-plan/index.html"]))
    links = [link.attributes["href"] for link in page.all("a") if "li" in link.inside]
    assert [link for link in links if link and link.startswith("../first/#")] == [
        "../first/#lines",
        "../first/#figure-demo",
        "../first/#quiz-within",
        "../first/#quiz-at-the-end",
    ]


def test_the_contents_lead_to_the_plan_where_there_is_one(make_book: MakeBook) -> None:
    def links(files: dict[str, str]) -> list[str | None]:
        page = read_html(content_bytes(render_site(make_book(FIRST, files))["first/index.html"]))
        return [link.attributes.get("href") for link in page.all("a")]

    assert "../lecture-plan/" not in links({})
    assert "../lecture-plan/" in links({FILE: PLAN})


@pytest.mark.parametrize(
    ("text", "report"),
    [
        (
            PLAN.replace("#lines", "#line"),
            "8: unknown target in first 'line'; did you mean 'lines'",
        ),
        (PLAN.replace("first#", "frist#"), "8: unknown chapter 'frist'; did you mean 'first'"),
        (PLAN.replace("#lines", ""), "8: 'first' is Chapter 0; legal: a section, "),
        (PLAN.replace("#lines", "#figure-demo"), "8: 'first#figure-demo' is Figure 0.1; legal: a "),
        (
            PLAN.replace("note =", "notes = 1\nnote ="),
            "3: unknown key 'notes'; did you mean 'note'",
        ),
        (PLAN.replace('note = "Points and lines."\n', ""), "3: no 'note'; legal: "),
        (PLAN.replace("[[section]]", "[section]"), "3: no sections; legal: "),
        (PLAN.replace("[[section]]", "[[section]"), "3: malformed TOML: "),
    ],
)
def test_a_plan_that_leads_nowhere_is_reported_where_it_does(
    make_book: MakeBook, text: str, report: str
) -> None:
    with pytest.raises(BuildError) as failure:
        check_site(make_book(FIRST, {FILE: text}))
    assert str(failure.value).startswith(f"{FILE}:{report}")
