"""One pass over a page's tokens: set formulae, gather links and headings, report the illegal."""

import re
from collections.abc import Iterator, Sequence
from itertools import pairwise
from pathlib import PurePosixPath

from markdown_it.token import Token

from site_builder.book import Heading, Link
from site_builder.diagnostics import unknown
from site_builder.markdown.reading import Reading, slug
from site_builder.markdown.roles.measured import measured_text
from site_builder.markdown.roles.readout import ReadoutError
from site_builder.markdown.text.code import UnknownLanguageError, code_html
from site_builder.markdown.text.formula_breaks import displayed_parts, glue_formulae
from site_builder.markdown.text.math import ROLES, UnsupportedTexError, to_mathml
from site_builder.markdown.text_role import TEXT_ROLES
from site_builder.measured.measurements import MeasurementError

MISPLACED_OPTION = re.compile(r":[a-z_][\w-]*:[ \t]+\S+")


def annotate(tokens: Sequence[Token], reading: Reading) -> None:
    """Give formulae, code, links and headings what rendering needs; report what is illegal."""
    for token, line in located(tokens):
        match token.type:
            case "math_inline" | "math_block":
                _set_formula(token, line, reading)
            case "fence":
                _set_code(token, line, reading)
            case "link_open":
                _gather_link(token, line, reading)
            case "text" if MISPLACED_OPTION.fullmatch(token.content):
                reading.problem(
                    line,
                    f"option {token.content!r} in running text; "
                    "legal: directly below the line that opens the directive",
                )
            case kind if kind in TEXT_ROLES:
                _set_number(token, line, reading)
            case "role_open" if token.info not in ROLES:
                reading.problem(line, unknown("role", token.info, (*ROLES, *TEXT_ROLES)))
            case "image":
                reading.problem(
                    line, "picture in running text; legal: ':::{figure} file' with ':alt:'"
                )
            case "html_inline" | "html_block":
                _drop_html(token, line, reading)
    _name_headings(tokens, reading)
    glue_formulae(tokens)


def located(tokens: Sequence[Token]) -> Iterator[tuple[Token, int]]:
    """All tokens, those inside paragraphs included, each with its line counted from 1."""
    line = 1
    for token in tokens:
        line = token.map[0] + 1 if token.map else line
        yield token, line
        offset = 0
        for child in token.children or ():
            yield child, line + offset
            is_break = child.type in ("softbreak", "hardbreak")
            offset += 1 if is_break else child.content.count("\n")


def _set_formula(token: Token, line: int, reading: Reading) -> None:
    try:
        token.meta["mathml"] = _mathml(token.content.strip(), display=token.type == "math_block")
    except UnsupportedTexError as error:
        reading.problem(line, str(error))


def _mathml(tex: str, *, display: bool) -> str:
    parts = displayed_parts(tex) if display else [tex]
    return "".join(to_mathml(part, display=display) for part in parts or [tex])


def _set_code(token: Token, line: int, reading: Reading) -> None:
    try:
        token.meta["html"] = code_html(token.content, token.info.strip())
    except UnknownLanguageError as error:
        reading.problem(line, str(error))


def _set_number(token: Token, line: int, reading: Reading) -> None:
    try:
        if token.type == "measured":
            token.content = measured_text(token.content, reading.measurements)
        else:
            token.content = reading.readouts.text(token.content)
    except (MeasurementError, ReadoutError) as error:
        reading.problem(line, str(error))


def _gather_link(token: Token, line: int, reading: Reading) -> None:
    """Record the author's target; point the token at the page that will be built from it."""
    target = str(token.attrGet("href") or "")
    if target.startswith(("https://", "http://")):
        token.attrSet("rel", "external")
        return
    reading.links.append(Link(target, line))
    file, mark, anchor = target.partition("#")
    if file:
        token.attrSet("href", f"../{chapter_id(file)}/{mark}{anchor}")


def chapter_id(file: str) -> str:
    """``lens-distortion`` for ``04-lens-distortion.md``."""
    return PurePosixPath(file).stem.lstrip("0123456789").lstrip("-") or "unnamed"


def _drop_html(token: Token, line: int, reading: Reading) -> None:
    """Comments are the author's own; other HTML would escape every check."""
    markup = token.content.strip()
    start = markup.partition("\n")[0][:40]
    if not markup.startswith("<!--"):
        reading.problem(line, f"raw HTML {start!r}; legal: Markdown and directives")
    elif not markup.endswith("-->"):
        message = "a comment that is not closed, or not at the end of a line"
        reading.problem(line, f"{start!r} begins {message}; legal: '<!-- … -->'")
    token.content = ""


def _name_headings(tokens: Sequence[Token], reading: Reading) -> None:
    for opening, inline in pairwise(tokens):
        if opening.type != "heading_open":
            continue
        line, level = (opening.map or [0])[0] + 1, int(opening.tag[1])
        text = plain_text(inline)
        if not text:
            reading.problem(line, "heading without words; legal: '## Some words'")
        if opening.markup in ("-", "="):
            legal = f"'## {text}', or an empty line above the rule"
            reading.problem(line, f"{text!r} underlined is a heading; legal: {legal}")
        previous = reading.headings[-1].level if reading.headings else 1
        if level == 1:
            reading.problem(line, f"heading '# {text}'; legal: '##' and deeper, below the title")
        elif level > previous + 1:
            reading.problem(
                line, f"heading of level {level} below one of level {previous}; legal: "
                f"{'#' * (previous + 1)!r} or higher",
            )  # fmt: skip
        name = reading.take_id(slug(text), line, "heading")
        opening.attrSet("id", name)
        reading.headings.append(Heading(level, name, reading.html(_without_links(inline))))


def _without_links(inline: Token) -> list[Token]:
    """A heading as it may stand inside a link of the table of contents."""
    children = [
        child
        for child in inline.children or ()
        if child.type not in ("link_open", "link_close", "footnote_ref")
    ]
    return [Token("inline", "", 0, children=children)]


def plain_text(inline: Token) -> str:
    """The words of a paragraph or heading, without markup."""
    parts = (
        " " if child.type in ("softbreak", "hardbreak") else child.content
        for child in inline.children or ()
    )
    return "".join(parts).strip()
