"""One pass over a page's tokens: set formulae, gather links and headings, report the illegal."""

import re
from collections.abc import Callable, Mapping, Sequence

from markdown_it.token import Token

from site_builder.diagnostics import unknown
from site_builder.markdown.headings import list_headings
from site_builder.markdown.reading import Reading
from site_builder.markdown.role import Role
from site_builder.markdown.roles import ROLES
from site_builder.markdown.text.code import UnknownLanguageError, code_html
from site_builder.markdown.text.formula_breaks import displayed_parts, glue_formulae
from site_builder.markdown.text.math import UnsupportedTexError, to_mathml
from site_builder.markdown.text.shorthand import written_out
from site_builder.markdown.text.tokens import located, plain_text
from site_builder.page_model.places import Link, chapter_id

ROLE_NAMES = tuple(role.name for role in ROLES)
MISPLACED_OPTION = re.compile(r":[a-z_][\w-]*:[ \t]+\S+")


def annotate(tokens: Sequence[Token], reading: Reading) -> None:
    """Give formulae, code, links and headings what rendering needs; report what is illegal."""
    for token, line in located(tokens):
        if see := SEEN_TO.get(token.type):
            see(token, line, reading)
    list_headings(tokens, reading)
    glue_formulae(tokens)


def inline_html(markdown: str, line: int, reading: Reading) -> str:
    """One line of Markdown, such as a directive's title, as HTML without a paragraph."""
    env = {"references": reading.env.get("references", {})}
    tokens = reading.parser.parseInline(markdown, env)
    for _, message in env.pop("problems", ()):
        reading.problem(line, message)
    for token in tokens:
        token.map = [line - 1, line]
    annotate(tokens, reading)
    return reading.html(tokens)


def _set_formula(token: Token, line: int, reading: Reading) -> None:
    tex = token.content
    try:
        tex = written_out(tex, reading.macros)
        token.meta["mathml"] = _mathml(tex.strip(), display=token.type != "math_inline")
    except UnsupportedTexError as error:
        reading.problem(line, str(error))
    reading.formulae.append((line, tex, token.type != "math_inline"))


def _mathml(tex: str, *, display: bool) -> str:
    parts = displayed_parts(tex) if display else [tex]
    return "".join(to_mathml(part, display=display) for part in parts or [tex])


def _set_code(token: Token, line: int, reading: Reading) -> None:
    try:
        token.meta["html"] = code_html(token.content, token.info.strip())
    except UnknownLanguageError as error:
        reading.problem(line, str(error))


def _set_words(token: Token, line: int, reading: Reading) -> None:
    role: Role = token.meta["role"]
    if role.inline is not None:
        token.children = list(role.inline(token.content, line, reading))
        token.content = plain_text(token)
        return
    if role.text is None:
        return
    try:
        token.content = role.text(token.content, reading)
    except role.refuses as error:
        reading.problem(line, str(error))


def _set_link(token: Token, line: int, reading: Reading) -> None:
    role: Role = token.meta["role"]
    if role.link is None:
        return
    linked = role.link(token.meta["words"], token.meta["given"], line, reading)
    token.attrs.update(linked.attributes)
    token.meta.update(linked.meta)
    for inner in token.meta["inside"]:
        if linked.fill and inner.type == "text":
            inner.content = linked.fill(inner.content)


def _gather_link(token: Token, line: int, reading: Reading) -> None:
    """Record the author's target; point the token at the page that will be built from it."""
    target = str(token.attrGet("href") or "")
    if target.startswith(("https://", "http://")):
        token.attrSet("rel", "external")
        reading.outside.append(Link(target, line))
        return
    reading.links.append(Link(target, line))
    file, mark, anchor = target.partition("#")
    if file:
        token.attrSet("href", f"../{chapter_id(file)}/{mark}{anchor}")


def _drop_html(token: Token, line: int, reading: Reading) -> None:
    """Comments are the author's own; other HTML, which would escape every check, is let through
    only where ``book.toml`` says so."""
    markup = token.content.strip()
    if reading.raw_html and not markup.startswith("<!--"):
        return
    start = markup.partition("\n")[0][:40]
    if not markup.startswith("<!--"):
        reading.problem(line, f"raw HTML {start!r}; legal: Markdown and directives")
    elif not markup.endswith("-->"):
        message = "a comment that is not closed, or not at the end of a line"
        reading.problem(line, f"{start!r} begins {message}; legal: '<!-- … -->'")
    token.content = ""


def _check_text(token: Token, line: int, reading: Reading) -> None:
    if token.content.startswith(":") and MISPLACED_OPTION.fullmatch(token.content):
        reading.problem(
            line,
            f"option {token.content!r} in running text; "
            "legal: directly below the line that opens the directive",
        )


def _open_role(token: Token, line: int, reading: Reading) -> None:
    if token.info not in ROLE_NAMES:
        reading.problem(line, unknown("role", token.info, ROLE_NAMES))
    elif "role" in token.meta:
        _set_link(token, line, reading)


def _refuse_picture(_token: Token, line: int, reading: Reading) -> None:
    legal = "':::{figure} file' with ':alt:'"
    reading.problem(line, f"picture in running text; legal: {legal}")


SEEN_TO: Mapping[str, Callable[[Token, int, Reading], None]] = {
    "math_inline": _set_formula,
    "math_block": _set_formula,
    "math_block_label": _set_formula,
    "fence": _set_code,
    "link_open": _gather_link,
    "text": _check_text,
    "role": _set_words,
    "role_open": _open_role,
    "image": _refuse_picture,
    "html_inline": _drop_html,
    "html_block": _drop_html,
}
"""What `annotate` does with each kind of token."""
