"""Annotate a page's tokens: set formulae, gather links and headings, report mistakes."""

import re
from collections.abc import Callable, Mapping, Sequence
from itertools import pairwise
from urllib.parse import unquote

from markdown_it.token import Token

from site_builder.diagnostics.blame import raised_by_code
from site_builder.diagnostics.diagnostic import nearest
from site_builder.document.book import OUTLINE
from site_builder.document.places import Link, Passage, chapter_id, passage
from site_builder.formulae.temml import UnsupportedTexError, to_mathml
from site_builder.markdown.calculation import BLOCK, IN_FORMULA, compute_formula, define_names
from site_builder.markdown.numbering import list_headings
from site_builder.markdown.parse_context import ParseContext, Shared
from site_builder.markdown.role import Role
from site_builder.markdown.roles import ROLES
from site_builder.markdown.text.code import code_html
from site_builder.markdown.text.dialects import unknown_name
from site_builder.markdown.text.tokens import displayed_parts, glue_formulae, located, plain_text

DEFINITION = re.compile(
    r"\\(?:(?:re|provide)?newcommand|[gex]?def|DeclareMathOperator)\*?\s*\{?\\([A-Za-z]+)"
)
ROLE_NAMES = tuple(role.name for role in ROLES)
UNIT = re.compile(r"(?:\u00a0|(?=°$))(\S+)$")
BARE_ROLE = re.compile(r"\{([\w-]+)\}(?!`)")
BARE_KEY = re.compile(r"(\[-?)?(?<![\w@.])@([\w:.+-]*\w)")


def annotate(tokens: Sequence[Token], context: ParseContext) -> None:
    """Give formulae, code, links and headings what rendering needs; report what is illegal."""
    for token, line in located(tokens):
        if handle := HANDLERS.get(token.type):
            handle(token, line, context)
    for token, line in located(tokens):
        _check_units(token, line, context)
    list_headings(tokens, context)
    glue_formulae(tokens)


def inline_passage(markdown: str, line: int, context: ParseContext) -> Passage:
    """One line of Markdown, such as a directive's title, without a paragraph."""
    env = {"references": context.env.get("references", {})}
    tokens = context.shared.parser.parseInline(markdown, env)
    for _, message, *spoils in env.pop("problems", ()):
        context.problem(line, message, spoils=tuple(spoils))
    for token in tokens:
        token.map = [line - 1, line]
    annotate(tokens, context)
    return passage(tokens)


def _set_formula(token: Token, line: int, context: ParseContext) -> None:
    if definition := DEFINITION.match(token.content.strip()):
        name = definition[1]
        message = (
            f"'\\{name}' is defined in a formula; legal: {name} = '…' in [macros] of {OUTLINE}"
        )
        context.problem(line, message, spoils=(f"unsupported TeX command '\\{name}'",))
        return
    tex = compute_formula(token.content, line, context)
    if IN_FORMULA.search(token.content) and not tex:
        return
    token.content = tex
    context.formulae.append((line, tex, token.type != "math_inline"))
    try:
        token.meta["mathml"] = _mathml(token, context.shared)
    except UnsupportedTexError as error:
        context.problem(line + error.above, str(error))


def _mathml(formula: Token, shared: Shared) -> str:
    tex, display = formula.content, formula.type != "math_inline"
    parts = displayed_parts(tex) if display else [tex.strip()]
    mathml = ""
    for part in parts or [tex]:
        try:
            mathml += to_mathml(
                part,
                display=display,
                macros=shared.macros,
                language=shared.words.language,
                colours=shared.colours,
            )
        except UnsupportedTexError as error:
            above = tex.count("\n", 0, tex.find(part))
            raise UnsupportedTexError(str(error), above + error.above) from None
    return mathml


def _set_code(token: Token, line: int, context: ParseContext) -> None:
    if token.info.strip() == BLOCK:
        define_names(token, line, context)
        return
    try:
        code_html("", token.info.strip())
    except ValueError as error:
        context.problem(line, str(error))


def _set_words(token: Token, line: int, context: ParseContext) -> None:
    role: Role = token.meta["role"]
    if role.inline is not None:
        words = " ".join(token.content.split())
        token.children = list(role.inline(words, line, context))
        token.content = plain_text(token)
        return
    if role.text is None:
        return
    try:
        token.content = role.text(token.content, context)
    except role.refuses as error:
        context.problem(line, str(error), raised_by_code(error))


def _set_link(token: Token, line: int, context: ParseContext) -> None:
    role: Role = token.meta["role"]
    if role.link is None:
        return
    linked = role.link(token.meta["words"], token.meta["given"], line, context)
    token.attrs.update(linked.attributes)
    token.meta.update(linked.meta)
    for inner in token.meta["inside"]:
        if linked.fill and inner.type == "text":
            inner.content = linked.fill(inner.content)


def _gather_link(token: Token, line: int, context: ParseContext) -> None:
    """Record the author's target; point the token at the page that will be built from it."""
    target = str(token.attrGet("href") or "").removeprefix("./")
    if target.startswith(("https://", "http://")):
        token.attrSet("rel", "external")
        return
    file, mark, anchor = target.partition("#")
    context.links.append(Link(f"{file}{mark}{unquote(anchor)}", line))
    if file:
        token.attrSet("href", f"../{chapter_id(file)}/{mark}{anchor}")


def _drop_html(token: Token, line: int, context: ParseContext) -> None:
    """Drop comments; report other HTML, which no check covers, unless ``book.toml`` trusts it."""
    markup = token.content.strip()
    if context.shared.raw_html and not markup.startswith("<!--"):
        return
    start = markup.partition("\n")[0][:40]
    if markup.startswith("</"):  # what it ends is reported
        token.content = ""
    elif not markup.startswith("<!--"):
        context.problem(line, f"raw HTML {start!r}; legal: Markdown and directives")
    elif not markup.endswith("-->"):
        message = "a comment that is not closed, or not at the end of a line"
        context.problem(line, f"{start!r} begins {message}; legal: '<!-- … -->'")
    token.content = ""


def _open_role(token: Token, line: int, context: ParseContext) -> None:
    names = (*ROLE_NAMES, *context.shared.colours)
    if token.info not in names:
        context.problem(line, unknown_name("role", token.info, names))
    elif "role" in token.meta:
        _set_link(token, line, context)


def _check_units(inline: Token, line: int, context: ParseContext) -> None:
    """Report units behind numbers that have them."""
    for number, text in pairwise(inline.children or ()):
        has = UNIT.search(number.content) if number.type == "role" else None
        if (
            has
            and text.type == "text"
            and re.match(rf"\s*{re.escape(has[1])}(?![\w/])", text.content)
        ):
            name = number.meta["role"].name
            message = f"{has[1]!r} behind a {{{name}}} that has it; legal: the role alone"
            context.problem(line, message)


def _refuse_bare_roles(token: Token, line: int, context: ParseContext) -> None:
    for name in BARE_ROLE.findall(token.content):
        if name in ROLE_NAMES or name in context.shared.colours:
            context.problem(line, f"'{{{name}}}' alone is no role; legal: '{{{name}}}`words`'")
    works = context.shared.bibliography
    for bracket, key in BARE_KEY.findall(token.content):
        if meant := key if key in works or bracket else nearest(key, works, 0.8):
            message = f"'{bracket}@{key}' cites nothing; legal: '{{citet}}`{meant}`'"
            context.problem(line, message, spoils=(f"work {meant!r} is cited nowhere",))


def _refuse_picture(_token: Token, line: int, context: ParseContext) -> None:
    expected = "':::{figure} file' with ':alt:'"
    context.problem(line, f"picture in running text; legal: {expected}")


HANDLERS: Mapping[str, Callable[[Token, int, ParseContext], None]] = {
    "math_inline": _set_formula,
    "math_block": _set_formula,
    "math_block_label": _set_formula,
    "fence": _set_code,
    "link_open": _gather_link,
    "role": _set_words,
    "role_open": _open_role,
    "text": _refuse_bare_roles,
    "image": _refuse_picture,
    "html_inline": _drop_html,
    "html_block": _drop_html,
}
"""What `annotate` calls for each kind of token."""
