"""The lecturer's plan: named sections, what these show and ask, and mistakes with their place."""

from collections.abc import Callable

from support.html_outline import read_html
from support.little_book import files_of, rendered

from site_builder.build import Options

type MakeBook = Callable[..., Options]

FILE = "content/lecture-plan.toml"


def test_a_section_is_listed_with_what_it_shows_and_asks_and_no_other(make_book: MakeBook) -> None:
    page = read_html(rendered(make_book(files=files_of("lecture-plan")))["lecture-plan/index.html"])
    links = [link.attributes["href"] for link in page.all("a") if "li" in link.inside]
    assert [link for link in links if link and link.startswith("../first/#")] == [
        "../first/#lines",
        "../first/#figure-demo",
        "../first/#quiz-within",
        "../first/#quiz-at-the-end",
    ]


def test_the_contents_lead_to_the_plan_where_there_is_one(make_book: MakeBook) -> None:
    files = files_of("lecture-plan")
    for given in (files, {name: text for name, text in files.items() if name != FILE}):
        site = rendered(make_book(files=given))
        led_to = {
            link.attributes.get("href") for link in read_html(site["first/index.html"]).all("a")
        }
        assert ("../lecture-plan/" in led_to) is (FILE in given)
        (make_book().root / FILE).unlink(missing_ok=True)
