"""Nothing that an author writes puts a script into a page: it is refused with its place, or shown
as the text that it is. ``fixtures/attacks/markdown.txt`` lists what is tried."""

import re
from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from xml.etree.ElementTree import Element

import html5lib
import pytest
from playwright.sync_api import Browser
from support.static_server import serving

from site_builder.build import Options, check_site, render_site
from site_builder.diagnostics import BuildError
from site_builder.output.assets import Content, content_bytes

FIXTURE = Path(__file__).parents[1] / "fixtures" / "attacks" / "markdown.txt"
ATTACKS = tuple(
    line.translate(str.maketrans("¶→␁", "\n\t\u0001"))
    for line in FIXTURE.read_text(encoding="utf-8").splitlines()
    if not line.startswith(("# ", "#\n"))
)
SCRIPT = "<script>alert(1)</script>"
QUOTE = '"><img src=x onerror=alert(1)>'
OUTLINE = (
    'title = "T {0}"\nsubtitle = "S {0}"\nprerequisites = "P {0}"\nhero = "demo"\n'
    'hero_caption = "A caption."\nchapters = ["00-first", "01-second"]\n'
)
FIELDS = {
    "content/book.toml": OUTLINE.format(SCRIPT.replace('"', "'")),
    "content/references.bib": f"@book{{key, author = {{{SCRIPT} and {QUOTE}}}, title = {{{QUOTE}}},"
    f"\n  year = {{2000}}, publisher = {{{SCRIPT}}}}}\n",
    "content/glossary.toml": f'["{SCRIPT}"]\nsays = "A word."\nexplained = "first"\n'
    f"words = ['Glossed']\nalso = ['{QUOTE}']\n",
}
"""Titles and other texts that take no markup: shown as they are."""
ADDRESSES = ("href", "src", "action", "formaction", "srcdoc", "data", "poster", "background")
ACTIVE = ("script", "iframe", "object", "embed", "base", "style", "template", "applet", "frame")
HARMFUL = re.compile(r"[\s\x00-\x20]*(?:javascript|vbscript|data|blob|file)[\s\x00-\x20]*:", re.I)


def active(page: bytes) -> Iterator[str]:
    """All in a page that can run, load or lead anywhere by itself."""
    text = re.sub("assets/[0-9a-f]+/", "assets/", page.decode())
    root: Element = html5lib.parse(text, namespaceHTMLElements=False)
    for element in root.iter():
        tag = element.tag.rpartition("}")[2] if isinstance(element.tag, str) else ""
        if tag in ACTIVE:
            yield f"<{tag} {element.get('src') or element.get('type') or ''}>"
        for name, value in element.attrib.items():
            attribute = str(name).rpartition("}")[2].lower()
            if attribute.startswith("on"):
                yield f"{attribute}={value}"
            if attribute in ADDRESSES and HARMFUL.match(value):
                yield f"{attribute}={value}"
            if attribute == "http-equiv":
                yield f"{attribute}={value}"


def pages(site: Mapping[str, Content]) -> dict[str, bytes]:
    return {
        name: content_bytes(content) for name, content in site.items() if name.endswith(".html")
    }


def is_refused(options: Options) -> bool:
    try:
        check_site(options)
    except BuildError:
        return True
    return False


SHOWN = (
    "&lt;script&gt;alert(1)&lt;/script&gt;",
    "`<script>alert(1)</script>`",
    "```text\n</code></pre><script>alert(1)</script>\n```",
    "$\\text{a word} \\lt x$",
    "[x](https://a.example/'onmouseover='alert(1)')",
    '[x](https://a.example/ "title\\" onmouseover=\\"alert(1)")',
    '<https://a.example/"onmouseover="alert(1)>',
    "{index}`&lt;img src=x onerror=alert(1)&gt;`",
    "{ray}`<script>alert(1)</script>`",
    ':::{figure} images/plan.svg\n:alt: "><script>alert(1)</script>\nWords.\n:::',
    ":::{quiz} calm\nWhich `</script><script>alert(1)</script>`?\n"
    "- [x] `</script><script>alert(1)</script>`\n  : `<!--<script>`\n- [ ] c\n  : d\n:::",
    ":::{simulation} demo\nA caption with `<script>alert(1)</script>`.\n:::",
)
"""What is legal, and holds as text what an attack holds as markup."""


@pytest.mark.parametrize("attack", ATTACKS)
def test_an_attack_is_refused_or_legal_text(make_book: Callable[..., Options], attack: str) -> None:
    options = make_book(f"{attack}\n")
    if not is_refused(options):
        plain = pages(render_site(make_book("Text.\n")))["first/index.html"]
        page = pages(render_site(options))["first/index.html"]
        assert Counter(active(page)) - Counter(active(plain)) == Counter()


@pytest.fixture
def hostile(make_book: Callable[..., Options]) -> Options:
    """A book in order whose texts look like markup everywhere."""
    body = "{cite}`key` and Glossed.\n\n" + "\n\n".join(SHOWN)
    return make_book(body + "\n", FIELDS)


def test_texts_that_look_like_markup_stay_texts(
    hostile: Options, make_book: Callable[..., Options]
) -> None:
    site = pages(render_site(hostile))
    words = "".join(page.decode() for page in site.values())
    assert words.count("&lt;script&gt;") > 5
    mild = make_book(
        "{cite}`key` and Glossed.\n\n:::{quiz} calm\nA?\n- [x] b\n  : c\n- [ ] d\n  : e\n:::\n\n"
        ":::{simulation} demo\nA caption.\n:::\n",
        {name: text.replace(SCRIPT, "x").replace(QUOTE, "y") for name, text in FIELDS.items()},
    )
    plain = pages(render_site(mild))
    for name, page in site.items():
        assert Counter(active(page)) - Counter(active(plain[name])) == Counter(), name


@pytest.mark.browser
def test_in_a_browser_nothing_of_it_runs(
    hostile: Options, chromium: Browser, tmp_path: Path
) -> None:
    site = render_site(hostile)
    for name, content in site.items():
        (tmp_path / "site" / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / "site" / name).write_bytes(content_bytes(content))
    alarms: list[str] = []
    # Without the policy, which would stop it in any case.
    with serving(tmp_path / "site") as server, chromium.new_context(bypass_csp=True) as context:
        context.add_init_script("globalThis.alert = (said) => { globalThis.ran = said; };")
        page = context.new_page()
        page.on("dialog", lambda dialog: alarms.append(dialog.message))
        for name in pages(site):
            page.goto(server.url + name)
            page.mouse.move(200, 200)
            assert page.evaluate("globalThis.ran") is None, name
    assert alarms == []


def test_where_the_author_trusts_the_html_it_is_let_through(
    make_book: Callable[..., Options],
) -> None:
    outline = OUTLINE.format("x") + "[trust]\nraw_html = true\n"
    body = "<div class=own>Text</div>\n\nA <b>bold</b> word.\n"
    page = pages(render_site(make_book(body, {"content/book.toml": outline})))["first/index.html"]
    assert b"<div class=own>Text</div>" in page
    assert b"A <b>bold</b> word." in page


def test_without_that_word_it_is_refused(make_book: Callable[..., Options]) -> None:
    for said in ("", "[trust]\nraw_html = false\n"):
        outline = OUTLINE.format("x") + said
        assert is_refused(make_book("A <b>bold</b> word.\n", {"content/book.toml": outline}))


def test_a_page_among_the_downloads_is_refused_unless_trusted(
    make_book: Callable[..., Options],
) -> None:
    body = ":::{download} data/own.HTML\n:::\n"
    files = {"content/data/own.HTML": SCRIPT, "content/book.toml": OUTLINE.format("x")}
    assert is_refused(make_book(body, files))
    files["content/book.toml"] += "[trust]\nraw_html = true\n"
    assert not is_refused(make_book(body, files))


def test_a_drawing_that_could_run_is_refused_unless_trusted(
    make_book: Callable[..., Options],
) -> None:
    drawing = f'<svg xmlns="http://www.w3.org/2000/svg">{SCRIPT}</svg>'
    files = {"content/images/own.svg": drawing, "content/book.toml": OUTLINE.format("x")}
    assert is_refused(make_book("Text.\n", files))
    files["content/book.toml"] += "[trust]\nraw_html = true\n"
    assert not is_refused(make_book("Text.\n", files))
