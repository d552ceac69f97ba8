"""Passages as HTML for the screen, and as XHTML for paper: PDF and e-book, where nothing can be
pressed. Only tokens that markdown-it renders otherwise have a rule."""

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from html import escape

from markdown_it import MarkdownIt
from markdown_it.renderer import RendererProtocol
from markdown_it.token import Token
from markdown_it.utils import EnvType, OptionsDict
from markupsafe import Markup
from mdit_py_plugins.footnote import footnote_plugin

from site_builder.document.places import Passage, Target
from site_builder.languages.words import Words
from site_builder.markdown.text.code import code_html

type Rules = Mapping[str, Callable[[Token], str]]
"""HTML of a token by its type."""
LINK = re.compile(r"<a\b[^>]*>.*?</a>", re.DOTALL)
SPOKEN = re.compile(r'(?<=<math )alttext=("[^"]*")')


@dataclass(frozen=True, slots=True)
class PassageRenderer:
    """A renderer of markdown-it with rules of one medium."""

    markdown: MarkdownIt

    def __call__(self, passage: Passage) -> Markup:
        tokens, options = list(passage.tokens), self.markdown.options
        html = str(self.markdown.renderer.render(tokens, options, {})).strip()
        return Markup(LINK.sub(lambda link: named(link[0]), html))


def named(html: str) -> Markup:
    """Words that name something, with labels on their formulae: of MathML, browsers put nothing
    into a name."""
    return Markup(SPOKEN.sub(r"aria-label=\1 \g<0>", html))


def screen_renderer(words: Words) -> PassageRenderer:
    """``words`` are those of the interface."""
    return renderer_with(
        {
            **RULES,
            "heading_close": partial(heading_close, words),
            "table_open": partial(table_open, words),
            "footnote_ref": partial(footnote_reference, words),
            "footnote_anchor": partial(footnote_anchor, words),
            "footnote_block_open": partial(footnotes_open, words),
        }
    )


def renderer_with(rules: Rules) -> PassageRenderer:
    markdown = MarkdownIt("commonmark").use(footnote_plugin)
    for kind, html in rules.items():
        markdown.add_render_rule(kind, _render_rule(html))
    markdown.add_render_rule("role", role)
    return PassageRenderer(markdown)


def _render_rule(html: Callable[[Token], str]) -> Callable[..., str]:
    """``html`` with the signature of markdown-it's rules."""

    def rule(
        _renderer: RendererProtocol,
        tokens: Sequence[Token],
        index: int,
        _o: OptionsDict,
        _e: EnvType,
    ) -> str:
        return html(tokens[index])

    return rule


def formula(token: Token) -> str:
    """In a line of text, together with the stop, bracket or unit at its side; empty where it could
    not be set, which is reported."""
    mathml, meta = mathml_of(token), token.meta
    if "before" not in meta and "after" not in meta:
        return mathml
    before, after = escape(meta.get("before", "")), escape(meta.get("after", ""))
    return f'<span class="nowrap">{before}{mathml}{after}</span>'


def mathml_of(token: Token) -> str:
    return str(token.meta.get("mathml", ""))


def equation(token: Token) -> str:
    """Its number is the link to it."""
    target: Target | None = token.meta.get("target")
    formula = f'<div class="formula">{mathml_of(token)}</div>'
    if target is None:
        return f'<div class="equation">{formula}</div>\n'
    return (
        f'<div class="equation" id="{target.id}">{formula}'
        f'<a class="numbered" href="#{target.id}" aria-label="{target.name}">({target.number})</a>'
        "</div>\n"
    )


def heading_open(token: Token) -> str:
    return f'<div class="heading"><{token.tag} id="{token.attrGet("id")}">'


def heading_close(words: Words, token: Token) -> str:
    """After it a link to the section, which is no part of the heading's name."""
    target: Target = token.meta["target"]
    label = escape(words("frame.link_to", title=token.meta.get("title", target.title)))
    link = f'<a class="anchor" href="#{target.id}" aria-label="{label}"></a>'
    return f"</{token.tag}>{link}</div>\n"


def footnote_reference(words: Words, token: Token) -> str:
    number = token.meta["id"] + 1
    label = escape(words("frame.footnote", number=number))
    return (
        f'<sup class="footnote-ref"><a href="#fn{number}" id="fnref{_reference(token)}"'
        f' role="doc-noteref" aria-label="{label}">[{number}]</a></sup>'
    )


def _reference(token: Token) -> str:
    """A reference to a footnote, in its id: ``1``; ``1:1`` for the next one to the same note."""
    number, again = token.meta["id"] + 1, token.meta.get("subId", 0)
    return f"{number}:{again}" if again > 0 else f"{number}"


def footnote_anchor(words: Words, token: Token) -> str:
    """The way back from a note."""
    place = f"{token.meta['id'] + 1}-{token.meta.get('subId', 0) + 1}"
    label = escape(words("frame.back_to_reference", number=place))
    return (
        f' <a href="#fnref{_reference(token)}" class="footnote-backref" role="doc-backlink"'
        f' aria-label="{label}">↩\ufe0e</a>'
    )


def footnotes_open(words: Words, _token: Token) -> str:
    label = escape(words("frame.footnotes"))
    return (
        f'<section class="footnotes" role="doc-endnotes"'
        f' aria-label="{label}">\n<ol class="footnotes-list">\n'
    )


def code(token: Token) -> str:
    return code_html(token.content, token.info.strip())


def table_open(words: Words, _token: Token) -> str:
    """A wrapper that scrolls on narrow screens; focusable, so that it can by keyboard."""
    label = escape(words("frame.table"))
    return f'<div class="table-wrapper" tabindex="0" role="group" aria-label="{label}"><table>\n'


def table_close(_token: Token) -> str:
    return "</table></div>\n"


def role(
    renderer: RendererProtocol,
    tokens: Sequence[Token],
    index: int,
    options: OptionsDict,
    env: EnvType,
) -> str:
    """What a role made of its words."""
    token = tokens[index]
    if token.children:
        return str(renderer.render(token.children, options, env))
    return escape(token.content)


RULES: Rules = {
    "math_inline": formula,
    "math_block": equation,
    "math_block_label": equation,
    "fence": code,
    "heading_open": heading_open,
    "table_close": table_close,
}
"""Rules of every medium in HTML."""


def paper_renderer() -> PassageRenderer:
    return renderer_with(
        {
            **RULES,
            "heading_close": lambda token: f"</{token.tag}></div>\n",
            "table_open": lambda _: '<div class="table-wrapper"><table>\n',
            "footnote_block_open": lambda _: '<section class="footnotes">\n<ol>\n',
            "link_open": opening_tag,
            "role_open": opening_tag,
        }
    )


def opening_tag(token: Token) -> str:
    """Without the attributes that are for scripts."""
    attributes = (
        f' {name}="{escape(str(value))}"'
        for name, value in token.attrs.items()
        if not name.startswith(("data-", "aria-"))
    )
    return f"<{token.tag}{''.join(attributes)}>"
