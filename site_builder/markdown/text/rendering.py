"""The HTML of single tokens that plain Markdown does not have, or has otherwise."""

from html import escape

from markdown_it.token import Token


def formula(token: Token) -> str:
    """In a line of text; nothing where it could not be set, which is reported."""
    return str(token.meta.get("mathml", ""))


def equation(token: Token) -> str:
    return f'<div class="equation">{formula(token)}</div>\n'


def code(token: Token) -> str:
    return str(token.meta.get("html", ""))


def table_open(_token: Token) -> str:
    """A wrapper that scrolls on narrow screens; focusable, so that it can by keyboard."""
    return '<div class="table-wrapper" tabindex="0" role="group" aria-label="Table"><table>\n'


def table_close(_token: Token) -> str:
    return "</table></div>\n"


def words(token: Token) -> str:
    """What a role put in the place of its words."""
    return escape(token.content)
