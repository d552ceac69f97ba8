"""The e-book is whole: well-formed, every link resolves, every file is listed."""

import io
import posixpath
import re
import zipfile
from collections.abc import Callable
from pathlib import Path
from urllib.parse import unquote, urldefrag
from xml.etree import ElementTree

import pytest

from site_builder.build import Options
from site_builder.editions.compose import compose
from site_builder.editions.epub import FOLDER, make_epub
from site_builder.editions.epub_style import book_style
from site_builder.output.light_theme import resolve

ROOT = Path(__file__).parents[3]
TOKENS = (ROOT / "static" / "css" / "tokens.css").read_text(encoding="utf-8")
OPF = "{http://www.idpf.org/2007/opf}"
NCX = "{http://www.daisy.org/z3986/2005/ncx/}"


@pytest.fixture
def book(make_book: Callable[..., Options], body: str) -> zipfile.ZipFile:
    options = make_book(body + "A formula, $x^2$.\n", {"static/css/tokens.css": TOKENS})
    return zipfile.ZipFile(io.BytesIO(make_epub(compose(options), options.root)))


def texts(book: zipfile.ZipFile) -> dict[str, ElementTree.Element]:
    """Parsing them is the test that they are well-formed."""
    names = [name for name in book.namelist() if name.endswith(".xhtml")]
    return {name: ElementTree.fromstring(book.read(name)) for name in names}


def contents_of(book: zipfile.ZipFile) -> list[ElementTree.Element]:
    """The items of its package."""
    return list(ElementTree.fromstring(book.read(f"{FOLDER}book.opf")).iter(f"{OPF}item"))


def test_its_first_file_tells_what_it_is_and_is_not_packed(book: zipfile.ZipFile) -> None:
    head = book.infolist()[0]
    assert (head.filename, head.compress_type) == ("mimetype", zipfile.ZIP_STORED)
    assert book.read("mimetype") == b"application/epub+zip"


def test_every_address_leads_to_a_file_and_an_element(book: zipfile.ZipFile) -> None:
    pages = texts(book)
    ids = {name: {element.get("id") for element in page.iter()} for name, page in pages.items()}
    for name, page in pages.items():
        for element in page.iter():
            for address in filter(None, (element.get("href"), element.get("src"))):
                if re.match("[a-z]+:", address):
                    continue
                path, fragment = urldefrag(address)
                file = posixpath.normpath(posixpath.join(FOLDER, unquote(path))) if path else name
                assert file in book.namelist(), f"{name}: {address}"
                assert not fragment or fragment in ids[file], f"{name}: {address}"


def test_readers_of_epub_2_find_every_part_but_the_title(book: zipfile.ZipFile) -> None:
    contents = ElementTree.fromstring(book.read(f"{FOLDER}toc.ncx"))
    targets = [link.get("src") for link in contents.iter(f"{NCX}content")]
    parts = {name.removeprefix(FOLDER) for name in texts(book)} - {"title.xhtml", "nav.xhtml"}
    assert set(targets) == parts
    spine = ElementTree.fromstring(book.read(f"{FOLDER}book.opf")).find(f"{OPF}spine")
    assert spine is not None
    items = {item.get("id"): item for item in contents_of(book)}
    assert items[spine.get("toc")].get("href") == "toc.ncx"


def test_every_file_is_listed_once_and_marked_for_what_is_in_it(book: zipfile.ZipFile) -> None:
    package = ElementTree.fromstring(book.read(f"{FOLDER}book.opf"))
    items = {item.get("href"): item for item in package.iter(f"{OPF}item")}
    files = {name.removeprefix(FOLDER) for name in book.namelist() if name.startswith(FOLDER)}
    assert set(map(unquote, map(str, items))) == files - {"book.opf"}
    assert items["first.xhtml"].get("properties") == "mathml svg"
    assert items["nav.xhtml"].get("properties") == "nav"


def test_pictures_of_one_name_in_two_folders_are_two(make_book: Callable[..., Options]) -> None:
    drawing = '<svg xmlns="http://www.w3.org/2000/svg"><desc>{}</desc></svg>\n'
    files = {f"content/images/{name}/plan b.svg": drawing.format(name) for name in ("one", "two")}
    figures = (f":::{{figure}} {name[8:]}\n:alt: A plan\nA plan.\n:::\n\n" for name in files)
    options = make_book("".join(figures) * 2, {**files, "static/css/tokens.css": TOKENS})
    book = zipfile.ZipFile(io.BytesIO(make_epub(compose(options), options.root)))
    pictures = [name for name in book.namelist() if name.endswith(".svg")]
    assert pictures == [f"{FOLDER}images/plan-b.svg", f"{FOLDER}images/plan-b-2.svg"]
    assert [re.findall("<desc>(.*)</desc>", book.read(name).decode()) for name in pictures] == [
        ["one"],
        ["two"],
    ]


def test_it_names_its_authors_and_its_cover(make_book: Callable[..., Options]) -> None:
    outline = (
        'title = "T"\nsubtitle = "S"\nprerequisites = "P"\nchapters = ["00-first"]\n'
        'hero = "demo"\nhero_caption = "The demo."\n[imprint]\ndoi = "10.1000/182"\n'
        'authors = ["A. Lovelace 0000-0002-1825-0097", "C. & B."]\n'
    )
    files = {"content/book.toml": outline, "content/01-second.md": None}
    options = make_book(files={**files, "static/css/tokens.css": TOKENS})
    book = zipfile.ZipFile(io.BytesIO(make_epub(compose(options), options.root)))
    package = ElementTree.fromstring(book.read(f"{FOLDER}book.opf"))
    creators = package.iter("{http://purl.org/dc/elements/1.1/}creator")
    assert [creator.text for creator in creators] == ["A. Lovelace", "C. & B."]
    covers = [
        item for item in package.iter(f"{OPF}item") if item.get("properties") == "cover-image"
    ]
    assert [item.get("media-type") for item in covers] == ["image/png"]
    assert b"ORCID 0000-0002-1825-0097" in book.read(f"{FOLDER}title.xhtml")


def test_variables_are_resolved_to_the_light_theme() -> None:
    assert resolve("a { color: var(--ink); }", {"--ink": "#123"}) == "a { color: #123; }"


def test_the_style_of_an_e_book_has_no_variables() -> None:
    assert "var(" not in book_style(ROOT, {"heat": ("#ad4209", "#f79c63")})
