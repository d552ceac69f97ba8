"""Nothing that an author writes puts a script into a page: it is refused with its place, or shown
as the text that it is. ``fixtures/attacks/markdown.txt`` lists what is tried."""

import re
from collections import Counter
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Browser
from support.html_outline import read_html
from support.little_book import diagnostics, rendered
from support.static_server import serving

from site_builder.build import Options

FIXTURE = Path(__file__).parents[1] / "fixtures" / "attacks" / "markdown.txt"
ATTACKS = tuple(
    line.translate(str.maketrans("¶→␁", "\n\t\u0001"))
    for line in FIXTURE.read_text(encoding="utf-8").splitlines()
    if not line.startswith(("# ", "#\n"))
)
SCRIPT = "<script>alert(1)</script>"
DRAWING = f'<svg xmlns="http://www.w3.org/2000/svg">{SCRIPT}</svg>'
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
    for element in read_html(re.sub(b"assets/[0-9a-f]+/", b"assets/", page)).elements:
        if element.tag in ACTIVE:
            source = element.attributes.get("src") or element.attributes.get("type") or ""
            yield f"<{element.tag} {source}>"
        for name, value in element.attributes.items():
            harmful = name.rpartition(":")[2] in ADDRESSES and HARMFUL.match(value or "")
            if harmful or name.startswith("on") or name == "http-equiv":
                yield f"{name}={value}"


def pages(options: Options) -> dict[str, bytes]:
    return {name: page for name, page in rendered(options).items() if name.endswith(".html")}


def is_refused(options: Options) -> bool:
    return any(found.fails for found in diagnostics(options))


QUIZ = ":::{quiz} calm\nA?\n- [x] b\n  : c\n- [ ] d\n  : e\n:::\n"
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


def test_each_attack_is_refused_or_legal_text(make_book: Callable[..., Options]) -> None:
    plain = Counter(active(pages(make_book(QUIZ))["first/index.html"]))
    harm: dict[str, Counter[str]] = {}
    for attack in ATTACKS:
        options = make_book(f"{attack}\n")
        if not is_refused(options):
            page = pages(options)["first/index.html"]
            harm[attack] = Counter(active(page)) - plain
    assert len(harm) > 10, "some are legal"
    assert {attack: found for attack, found in harm.items() if found} == {}


@pytest.fixture
def hostile(make_book: Callable[..., Options]) -> Options:
    """A book in order whose texts look like markup everywhere."""
    body = "{cite}`key` and Glossed.\n\n" + "\n\n".join(SHOWN)
    return make_book(body + "\n", FIELDS)


def test_texts_that_look_like_markup_stay_texts(
    hostile: Options, make_book: Callable[..., Options]
) -> None:
    site = pages(hostile)
    words = "".join(page.decode() for page in site.values())
    assert words.count("&lt;script&gt;") > 5
    mild = make_book(
        f"{{cite}}`key` and Glossed.\n\n{QUIZ}\n:::{{simulation}} demo\nA caption.\n:::\n",
        {name: text.replace(SCRIPT, "x").replace(QUOTE, "y") for name, text in FIELDS.items()},
    )
    plain = pages(mild)
    for name, page in site.items():
        assert Counter(active(page)) - Counter(active(plain[name])) == Counter(), name


@pytest.mark.browser
def test_in_a_browser_nothing_of_it_runs(
    hostile: Options, chromium: Browser, tmp_path: Path
) -> None:
    site = rendered(hostile)
    for name, content in site.items():
        (tmp_path / "site" / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / "site" / name).write_bytes(content)
    alarms: list[str] = []
    # Without the policy, which would stop it in any case.
    with serving(tmp_path / "site") as server, chromium.new_context(bypass_csp=True) as context:
        context.add_init_script("globalThis.alert = (said) => { globalThis.ran = said; };")
        page = context.new_page()
        page.on("dialog", lambda dialog: alarms.append(dialog.message))
        for name in (name for name in site if name.endswith(".html")):
            page.goto(server.url + name)
            page.mouse.move(200, 200)
            assert page.evaluate("globalThis.ran") is None, name
    assert alarms == []


@pytest.mark.parametrize(
    ("body", "files"),
    [
        ("<div class=own>Text</div>\n\nA <b>bold</b> word.\n", {}),
        (":::{download} data/own.HTML\n:::\n", {"content/data/own.HTML": SCRIPT}),
        ("Text.\n", {"content/images/own.svg": DRAWING}),
    ],
    ids=["text", "page among the downloads", "drawing"],
)
def test_html_is_refused_unless_the_author_trusts_it(
    make_book: Callable[..., Options], body: str, files: dict[str, str]
) -> None:
    for trust, refused in (("", True), ("raw_html = false", True), ("raw_html = true", False)):
        outline = f"{OUTLINE.format('x')}[trust]\n{trust}\n"
        options = make_book(body, {**files, "content/book.toml": outline})
        assert is_refused(options) is refused
    assert (b"A <b>bold</b> word." in rendered(options)["first/index.html"]) is (not files)
