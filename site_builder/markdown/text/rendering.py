"""The HTML of single tokens that plain Markdown does not have, or has otherwise."""

from collections.abc import Sequence
from html import escape

from markdown_it.renderer import RendererProtocol
from markdown_it.token import Token
from markdown_it.utils import EnvType, OptionsDict

from site_builder.languages.words import Words
from site_builder.page_model.places import Target


def formula(token: Token) -> str:
    """In a line of text; nothing where it could not be set, which is reported."""
    return str(token.meta.get("mathml", ""))


def equation(token: Token) -> str:
    """Its number is the link to it."""
    target: Target | None = token.meta.get("target")
    if target is None:
        return f'<div class="equation"><div class="formula">{formula(token)}</div></div>\n'
    return (
        f'<div class="equation" id="{target.id}"><div class="formula">{formula(token)}</div>'
        f'<a class="numbered" href="#{target.id}" aria-label="{target.name}">({target.number})</a>'
        "</div>\n"
    )


def heading_open(token: Token) -> str:
    return f'<div class="heading"><{token.tag} id="{token.attrGet("id")}">'


def heading_close(words: Words, token: Token) -> str:
    """With a link to the section beside it, which is no part of the heading's name."""
    target: Target = token.meta["target"]
    label = escape(words("frame.link_to", title=target.title))
    link = f'<a class="anchor" href="#{target.id}" aria-label="{label}"></a>'
    return f"</{token.tag}>{link}</div>\n"


def code(token: Token) -> str:
    return str(token.meta.get("html", ""))


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
    """What a role put in the place of its words."""
    token = tokens[index]
    if token.children:
        return str(renderer.render(token.children, options, env))
    return escape(token.content)
