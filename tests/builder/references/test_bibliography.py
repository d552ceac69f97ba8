"""The bibliography: what an entry must say, how it is cited, and the page that lists it."""

from collections.abc import Callable
from pathlib import Path

import pytest
from support.html_outline import read_html
from support.little_book import rendered

from site_builder.build import Options, render_site
from site_builder.diagnostics import Diagnostics
from site_builder.references.bibliography import Bibliography, read_bibliography

type MakeBook = Callable[..., Options]

BIB = r"""% a comment
@article{zhang2000,
  author = {Zhang, Zhengyou},
  title = {A {Flexible} technique},
  journal = {Some Journal},
  volume = 22, number = 11, pages = {1330--1334}, year = 2000,
  doi = {10.1109/34.888718},
}

@book{hartley2004,
  author = {Hartley, Richard and Zisserman, Andrew},
  title = {Geometry}, publisher = {A Press}, year = 2004, isbn = {0-521},
}
"""
CITES = "\n{cite}`hartley2004, §4.1; zhang2000` and {citet}`zhang2000, p. 3`.\n"


def read(root: Path, text: str) -> tuple[Bibliography, list[str]]:
    (root / "content").mkdir()
    (root / "content" / "references.bib").write_text(text, encoding="utf-8")
    problems = Diagnostics()
    return read_bibliography(root, problems), [str(found) for found in problems.found]


def entry(key: str, authors: str, year: int) -> str:
    return f"@misc{{{key}, author = {{{authors}}}, title = {{T}}, year = {year}}}\n"


def test_a_reference_is_told_whole(tmp_path: Path) -> None:
    works = read(tmp_path, BIB)[0].works
    assert works["zhang2000"].reference == (
        "Zhang, Z. (2000). A Flexible technique. Some Journal 22(11), 1330–1334."
    )
    assert works["zhang2000"].address == "https://doi.org/10.1109/34.888718"
    assert works["hartley2004"].reference == (
        "Hartley, R. and Zisserman, A. (2004). Geometry. A Press."
    )


@pytest.mark.parametrize(
    ("authors", "who", "everyone"),
    [
        (r"Heikkil{\"a}, Janne", "Heikkilä", "Heikkilä, J."),
        ("{CIE}", "CIE", "CIE"),
        ("van der Walt, Stéfan J.", "van der Walt", "van der Walt, S. J."),
        ("A, B and C, D and E, F", "A et al.", "A, B., C, D. and E, F."),
        ("A, B and C, D and others", "A et al.", "A, B., C, D. et al."),
    ],
)
def test_authors_are_named_as_is_usual(
    tmp_path: Path, authors: str, who: str, everyone: str
) -> None:
    work = read(tmp_path, entry("k", authors, 2000))[0].works["k"]
    assert (work.who, work.everyone) == (who, everyone)


def test_works_of_the_same_authors_and_year_are_told_apart(tmp_path: Path) -> None:
    works = read(tmp_path, "".join(entry(key, "Cook, R.", 1984) for key in ("one", "two")))[0].works
    assert [work.year for work in works.values()] == ["1984a", "1984b"]


def cited(make_book: MakeBook) -> dict[str, bytes]:
    return rendered(make_book(CITES, {"content/references.bib": BIB}))


def test_a_citation_is_a_link_that_tells_its_work(make_book: MakeBook) -> None:
    page = read_html(
        rendered(make_book(CITES, {"content/references.bib": BIB}))["first/index.html"]
    )
    links = page.all("a", "citation")
    assert [link.text for link in links] == [
        "Hartley and Zisserman 2004",
        "Zhang 2000",
        "Zhang (2000, p. 3)",
    ]
    assert [link.attributes["href"] for link in links] == [
        "../references/#hartley2004", "../references/#zhang2000", "../references/#zhang2000",
    ]  # fmt: skip
    assert [link.attributes["id"] for link in links] == [
        "cite-hartley2004", "cite-zhang2000", "cite-zhang2000-2",
    ]  # fmt: skip
    assert (links[1].attributes["title"] or "").startswith("Zhang, Z. (2000). A Flexible")


def test_each_work_is_listed_with_the_places_that_cite_it(make_book: MakeBook) -> None:
    page = read_html(
        rendered(make_book(CITES, {"content/references.bib": BIB}))["references/index.html"]
    )
    works = [item.attributes["id"] for item in page.all("li") if "main" in item.inside]
    assert works == ["hartley2004", "zhang2000"]
    addresses = [str(link.attributes["href"]) for link in page.all("a") if "li" in link.inside]
    assert [link for link in addresses if "#cite-" in link] == [
        "../first/#cite-hartley2004", "../first/#cite-zhang2000", "../first/#cite-zhang2000-2",
    ]  # fmt: skip
    assert "https://doi.org/10.1109/34.888718" in addresses


def test_a_book_that_cites_nothing_has_no_list(make_book: MakeBook) -> None:
    assert "references/index.html" not in render_site(make_book())
