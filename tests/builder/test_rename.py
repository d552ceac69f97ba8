"""A chapter and a section under other names: the book stays without mistakes, and old addresses
lead on."""

from pathlib import Path

import pytest
from support.html_outline import read_html
from support.little_book import OUTLINE, SECOND, MakeBook, diagnostics, rendered

from site_builder.build import load
from site_builder.scaffold.rename import rename

BODY = """\
## Near

{ref}`second`, {ref}`there <second#a-section>`, [far](01-second.md#a-section), {ref}`a-section`.

:::{simulation} demo
A {ref}`near`, [near](#near).
:::
"""
SECOND_AFTER = SECOND.replace("---\n\n", "before:\n  - first: all of it\n---\n\n", 1)
FILES = {
    "content/book.toml": f"{OUTLINE}[starts]\nsecond = 'second#a-section'\n[parts]\nA = 'first'\n",
    "content/01-second.md": f"{SECOND_AFTER}\n{{ref}}`first#near`, a {{term}}`bend` of $q$.\n",
    "content/glossary.toml": '["bend"]\nsays = "It bends."\nexplained = "second#a-section"\n',
    "content/symbols.toml": '[second]\nq = ["a length"]\n',
    "content/search.toml": '"first#near" = ["close by"]\n',
    "content/news.toml": '[[entry]]\ndate = 2026-11-22\ntitle = "N"\nsays = "S"\n'
    'chapter = "second"\n',
}


@pytest.fixture
def book(make_book: MakeBook, monkeypatch: pytest.MonkeyPatch) -> MakeBook:
    """As its command reads it, with the scene of the tests."""
    options = make_book(BODY, FILES)
    monkeypatch.setattr("site_builder.scaffold.rename.load", lambda _: load(options))
    return lambda: options


def sources(root: Path) -> dict[str, str]:
    files = sorted((root / "content").rglob("*.[mt]*"))
    return {file.relative_to(root).as_posix(): file.read_text("utf-8") for file in files}


def test_a_renamed_book_has_no_mistake_and_its_old_addresses_lead_on(book: MakeBook) -> None:
    options = book()
    assert diagnostics(options) == []
    for old, new in (("first", "begin"), ("second#a-section", "end"), ("begin#near", "close")):
        said = rename(options.root, old, new)
        assert "content/book.toml" in said or "#" in old
        assert diagnostics(options) == []
    site = rendered(options)
    for path in ("first/", "embed/first/figure-demo/"):
        (link,) = read_html(site[f"{path}index.html"]).all("a")
        there = (Path("/") / path / link["href"]).resolve().as_posix().removeprefix("/")
        assert there == path.replace("first", "begin").removesuffix("/")
    for path, old in (("begin/", "near"), ("second/", "a-section")):
        assert f'id="{old}"' in site[f"{path}index.html"].decode()
    assert not [path for path in site if path.endswith("sitemap.xml")]


def test_renamed_back_the_sources_are_as_they_were(book: MakeBook) -> None:
    before = sources(book().root)
    rename(book().root, "first", "begin")
    rename(book().root, "begin", "first")
    after = sources(book().root)
    assert {**after, "content/book.toml": ""} == {**before, "content/book.toml": ""}
    assert after["content/book.toml"].startswith(before["content/book.toml"])


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("frist", "begin", "unknown chapter 'frist'; did you mean 'first'"),
        ("first#naer", "close", "unknown section of first 'naer'"),
        ("first", "second", "'second' is taken"),
        ("first#near", "figure-demo", "'figure-demo' is taken"),
        ("first", "glossary", "'glossary' is taken"),
        ("first", "01-begin", "no number first"),
        ("first#near", "second#close", "is in another chapter"),
        ("first", "Begin it", "legal: small letters"),
    ],
)
def test_a_name_that_is_not_there_or_taken_changes_nothing(
    old: str, new: str, message: str, book: MakeBook
) -> None:
    before = sources(book().root)
    with pytest.raises(ValueError, match=message):
        rename(book().root, old, new)
    assert sources(book().root) == before
