"""The book in print, as an e-book and as notebooks, and its passages as Markdown."""

import io
import posixpath
import re
import zipfile
from base64 import b64decode
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path
from typing import Any
from urllib.parse import unquote, urldefrag
from xml.etree import ElementTree
from xml.etree.ElementTree import Element, fromstring

import nbformat
import numpy as np
import pytest
from markdown_it import MarkdownIt
from mdit_py_plugins.dollarmath import dollarmath_plugin
from pypdf import PdfReader
from support.little_book import FIXTURES, OUTLINE, MakeBook
from support.places import ROOT

from simulations.engine.controls import Choice, Slider, Toggle
from simulations.engine.drawing import line
from simulations.engine.frame import Frame
from simulations.engine.stages import Outputs
from site_builder.__main__ import main
from site_builder.build import check_site, load
from site_builder.document.blocks import Prose, contents
from site_builder.editions.compose import compose, shown_values
from site_builder.editions.epub import FOLDER, book_style, make_epub
from site_builder.editions.notebooks.notebook import make_notebooks
from site_builder.editions.pdf import (
    PageNumberError,
    UnsettledError,
    anchor_pages,
    fill,
    make_pdf,
    pdf_printer,
    print_until_stable,
    volume,
)
from site_builder.editions.tree import elements, is_external, parse, words
from site_builder.figures import initial_frames as prerendered_frames
from site_builder.output.writer import content_bytes
from site_builder.pages.environment import render_template
from site_builder.programs import chromium
from site_builder.render.markdown import MarkdownRenderer, code, quoted, table

BODY = (FIXTURES / "pages.md").read_text(encoding="utf-8")
TOKENS = {"static/css/tokens.css": (ROOT / "static/css/tokens.css").read_text(encoding="utf-8")}
PARTED = OUTLINE + '[parts]\nMotion = "second"\n'


def epub(make_book: MakeBook, body: str, files: dict[str, str | None]) -> zipfile.ZipFile:
    options = make_book(body, {**TOKENS, **files})
    return zipfile.ZipFile(io.BytesIO(make_epub(compose(options), options.root)))


def test_every_link_of_an_e_book_leads_to_a_file_and_an_element(make_book: MakeBook) -> None:
    book = epub(make_book, BODY, {"content/book.toml": PARTED})
    names = [name for name in book.namelist() if name.endswith(".xhtml")]
    pages = {name: ElementTree.fromstring(book.read(name)) for name in names}
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


def test_pictures_with_equal_names_in_two_folders_are_both_packed(make_book: MakeBook) -> None:
    drawing = '<svg xmlns="http://www.w3.org/2000/svg"><desc>{}</desc></svg>\n'
    files = {f"content/images/{name}/plan b.svg": drawing.format(name) for name in ("one", "two")}
    figures = (f":::{{figure}} {name[8:]}\n:alt: A plan\nA plan.\n:::\n\n" for name in files)
    book = epub(make_book, "".join(figures) * 2, {**files})
    pictures = [name for name in book.namelist() if name.endswith(".svg")]
    assert pictures == [f"{FOLDER}images/plan-b.svg", f"{FOLDER}images/plan-b-2.svg"]
    shown = [re.findall("<desc>(.*)</desc>", book.read(name).decode()) for name in pictures]
    assert shown == [["one"], ["two"]]


def test_raster_of_a_drawing_is_a_file_in_the_e_book(make_book: MakeBook) -> None:
    book = epub(make_book, ":::{illustration} similar-triangles\nPlan.\n\n1. A.\n2. B.\n:::\n", {})
    assert book.read(f"{FOLDER}images/drawing.png").startswith(b"\x89PNG")
    assert not any(b"data:" in book.read(name) for name in book.namelist())


def test_e_book_names_its_authors_and_cover(make_book: MakeBook) -> None:
    outline = (
        f'{OUTLINE}hero = "demo"\nhero_caption = "The demo."\n[imprint]\ndoi = "10.1000/182"\n'
        'authors = ["A. Lovelace 0000-0002-1825-0097", "C. & B."]\n'
    )
    book = epub(make_book, "Text.\n", {"content/book.toml": outline})
    package = ElementTree.fromstring(book.read(f"{FOLDER}book.opf"))
    creators = package.iter("{http://purl.org/dc/elements/1.1/}creator")
    assert [creator.text for creator in creators] == ["A. Lovelace", "C. & B."]
    items = package.iter("{http://www.idpf.org/2007/opf}item")
    covers = [item.get("media-type") for item in items if item.get("properties") == "cover-image"]
    assert covers == ["image/png"]
    assert b"ORCID 0000-0002-1825-0097" in book.read(f"{FOLDER}title.xhtml")


def test_style_of_an_e_book_has_no_css_variables() -> None:
    assert "var(" not in book_style(ROOT, {"heat": ("#ad4209", "#f79c63")})


def test_printed_volume_has_unique_ids_valid_links_and_answers_last(make_book: MakeBook) -> None:
    composed = compose(make_book(BODY, {"content/book.toml": PARTED}))
    chapter, _, answers = composed.sections
    assert "for a reason" not in words(chapter.article)
    assert "Yes, for a reason" in words(answers.article)
    names = {element.tag for element in elements(chapter.article)}
    assert names.isdisjoint({"button", "input", "select", "script", "noscript", "details"})
    whole = volume(composed)
    ids = [element.attrib["id"] for element in whole.iter() if "id" in element.attrib]
    assert len(ids) == len(set(ids))
    assert all(name.isascii() for name in ids)
    inside = {link for link in links(whole) if not is_external(link)}
    assert inside <= {f"#{name}" for name in ids}
    assert len(inside) > 10
    nav = parse(render_template("editions/epub-nav.html", composed.book, composed=composed))
    (part,) = (item for item in elements(nav, "li") if item.find("{*}span") is not None)
    assert links(part) == ["second.xhtml", "second.xhtml#a-section"]
    contents = next(elements(whole, kind="volume-contents"))
    assert [child.tag for child in contents][:4] == ["h1", "ol", "h2", "ol"]
    assert links(contents[3]) == ["#second", "#second.a-section"]


def links(element: Element) -> list[str]:
    return [link.attrib["href"] for link in elements(element, "a")]


@pytest.mark.parametrize("pictures", [True, False])
def test_printed_figure_shows_several_values_of_its_main_control(
    make_book: MakeBook, *, pictures: bool
) -> None:
    options = make_book(":::{simulation} demo\n:k1: 0.1\nA caption.\n:::\n")
    demo = options.load_scene("demo")

    def follow(settings: Any, outputs: Outputs) -> Frame:
        frame = demo.draw(settings, outputs)
        if pictures:
            raster = np.full((4, 6, 4), 128 + round(200 * settings.k1), np.uint8)
            return replace(frame, panels=(replace(frame.panels[0], raster=raster),))
        turned = replace(frame.panels[1], overlay=line((0, 0), (100 * settings.k1, 10)))
        return replace(frame, panels=(frame.panels[0], turned))

    composed = compose(replace(options, load_scene=lambda _id: replace(demo, draw=follow)))
    article = composed.sections[0].article
    values = [words(item) for item in elements(article, kind="multiple-value")]
    assert values == ["Distortion: −0.20 px", "Distortion: 0.10 px", "Distortion: 0.30 px"]
    rows = elements(article, kind="multiple")
    shown = {str(image.get("src")).removeprefix("../") for row in rows for image in row.iter("img")}
    assert len(shown) == (3 if pictures else 0)
    assert shown <= set(composed.files)


@pytest.mark.browser
def test_page_numbers_in_the_pdf_are_correct(make_book: MakeBook) -> None:
    composed = compose(make_book(BODY))
    with ThreadPoolExecutor() as aside:  # no two Playwrights in one thread
        pdf = aside.submit(lambda: make_pdf(composed, pdf_printer())).result()
    reader = PdfReader(io.BytesIO(pdf))
    pages = anchor_pages(pdf)
    printed = [" ".join(page.extract_text().split()) for page in reader.pages]
    assert f"(p. {pages['second']})" in printed[pages["first"] - 1].replace("\xa0", " ")
    assert "for a reason" in printed[pages["answers"] - 1]
    assert len({pages[name] for name in ("first", "second", "answers")}) == 3
    titles = [str(entry["/Title"]) for entry in reader.outline if isinstance(entry, dict)]
    assert titles[:3] == ["Contents", "First", "Second"]


NUMBER = "(p.\N{NO-BREAK SPACE}{page})"
NUMBERED = f'<p><span data-page-of="a"/> <span data-page-of="b" data-page-as="{NUMBER}"/></p>'


def test_typesetting_repeats_until_page_numbers_are_stable() -> None:
    """Here the page numbers, once known, move a line to the next page."""

    def numbers() -> Iterator[dict[str, int]]:
        yield from ({"a": 1, "b": 2}, {"a": 1, "b": 3}, {"a": 1, "b": 3})

    answers = numbers()
    pdf = print_until_stable(
        fromstring(NUMBERED), lambda document: document, lambda _: next(answers)
    )
    assert "(p.\N{NO-BREAK SPACE}3)" in pdf.decode()
    with pytest.raises(PageNumberError, match="b"):
        fill(fromstring(NUMBERED), {"a": 7})
    pages = iter(range(1, 100))
    with pytest.raises(UnsettledError):
        print_until_stable(
            fromstring(NUMBERED), lambda text: text, lambda _: dict.fromkeys("ab", next(pages))
        )


SLIDER = Slider(name="k1", label="k₁", default=0, minimum=-0.5, maximum=0.5, step=0.01)
MENU = Choice(name="m", label="M", default="a", options={name: name for name in "abcdef"})


def test_printed_values_of_a_control_surround_the_present_one() -> None:
    assert shown_values(SLIDER, 0.1) == [-0.2, 0.1, 0.3]
    for now in (-0.5, -0.33, 0.0, 0.47, 0.5):
        values = shown_values(SLIDER, now)
        assert (len(values), now in values, sorted(values)) == (3, True, list(values))
        assert all(SLIDER.reaches(float(value)) for value in values)
    for name in MENU.options:
        values = shown_values(MENU, name)
        assert (len(values), name in values) == (4, True)


def test_prerendered_values_span_the_slider_and_include_its_start() -> None:
    values = prerendered_frames.shown_values(SLIDER, 0.33)
    assert (values[0], values[-1], len(values)) == (-0.5, 0.5, prerendered_frames.FRAMES + 1)
    assert 0.33 in values
    assert all(SLIDER.reaches(float(value)) for value in values)
    coarse = Slider(name="s", label="S", default=1, minimum=0, maximum=3, step=1)
    assert prerendered_frames.shown_values(coarse, 1) == (0, 1, 2, 3)
    assert prerendered_frames.shown_values(MENU, "b") == tuple("abcdef")
    box = Toggle(name="t", label="T", default=True)
    assert prerendered_frames.shown_values(box, True) == (True,)


@pytest.mark.parametrize("missing", [{"pypdf"}, {"Chromium"}, {"playwright", "pypdf", "Chromium"}])
def test_all_missing_requirements_of_a_pdf_are_listed_at_once(
    missing: set[str], monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(chromium, "find_spec", lambda name: name not in missing)
    browser = None if "Chromium" in missing else Path("chromium")
    monkeypatch.setattr(chromium, "find_chromium", lambda: browser)
    assert main(["pdf"]) == 1
    (message,) = capsys.readouterr().err.splitlines()
    named = re.sub(r"\(.*?\)", "", message)
    assert {name for name in ("playwright", "pypdf", "Chromium") if name in named} == missing
    assert ("textbook-builder[pdf]" in message) == bool(missing - {"Chromium"})


SIGNS = r"A \*star\*, a \_line\_, a [bracket], 2 < 3, \$5, \# 1, a \`tick\` and a \\ back slash."
READ_AGAIN = MarkdownIt("commonmark").enable("table").use(dollarmath_plugin)


@pytest.mark.parametrize("address", ["", "https://host/book/"])
def test_notebook_has_frames_and_links_to_a_site_with_an_address(
    make_book: MakeBook, address: str
) -> None:
    body = "See {ref}`second`.\n\n:::{simulation} demo\n:k1: 0.25\n:tier: fast\nPull it.\n:::\n\n"
    options = replace(make_book(body), address=address)
    files = make_notebooks(check_site(options), options.root)
    notebook = nbformat.reads(content_bytes(files["first.ipynb"]).decode(), as_version=4)
    nbformat.validate(notebook)
    (figure,) = (cell for cell in notebook.cells if cell.source.startswith('figure("demo"'))
    (output,) = figure.outputs
    assert output.data["text/plain"] == "Shows k1 of 0.25 in tier fast."
    assert b64decode(output.data["image/png"]).startswith(b"\x89PNG")
    (text,) = (cell.source for cell in notebook.cells if cell.source.startswith("See "))
    assert (f"]({address}second/)" in text) if address else "](" not in text


def test_only_an_earlier_folder_of_notebooks_is_replaced(
    run: Callable[..., int], tmp_path: Path
) -> None:
    out, full = tmp_path / "out", tmp_path / "full"
    full.mkdir()
    (full / "thesis.txt").touch()
    assert [run("notebooks", "--out", str(folder)) for folder in (out, out, full)] == [0, 0, 1]
    assert (out / "first.ipynb").is_file()
    assert [file.name for file in full.iterdir()] == ["thesis.txt"]


@pytest.mark.parametrize(
    "body",
    [
        SIGNS,
        "1\\. is no list, and neither is\n\\- this, or\n\\# that.",
        "- One\n- Two\n  - Three\n\n4. Four\n\n   More of it.\n5. Five",
        "> Words that *another* said, in **two**\n> lines.",
        "```python\nx = '```'\n```",
        "Call `f(a|b)`, or ``a`b``.",
        "| Left | Right |\n|:---|---:|\n| one \\| two | `c\\|d` |",
    ],
)
def test_markdown_of_a_passage_renders_like_its_source(make_book: MakeBook, body: str) -> None:
    render = MarkdownRenderer({}, lambda _href: "")
    chapter = load(make_book(body)).book.chapters[0]
    written = "\n\n".join(render(prose.words) for prose in contents(chapter.body, Prose))
    assert READ_AGAIN.render(written) == READ_AGAIN.render(body)


def test_bars_backticks_and_formulae_are_escaped_in_markdown() -> None:
    row = table(["a"], [[r"$|x| = \|y\|$ | z"]]).splitlines()[-1]
    assert row == r"| $\vert x\vert  = \Vert y\Vert $ \| z |"
    assert quoted("So\n\n$$\na\n= b\n$$") == "> So\n>\n> $$a = b$$"
    assert code("a`b") == "`` a`b ``"
