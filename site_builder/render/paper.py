"""Passages as XHTML for paper: the PDF and the e-book, where nothing can be pressed."""

from html import escape

from markdown_it.token import Token

from site_builder.render.screen import RULES, PassageRenderer, renderer_with


def paper_renderer() -> PassageRenderer:
    return renderer_with(
        {
            **RULES,
            "heading_close": heading_close,
            "table_open": table_open,
            "link_open": plain_open,
            "role_open": plain_open,
        }
    )


def heading_close(token: Token) -> str:
    return f"</{token.tag}></div>\n"


def table_open(_token: Token) -> str:
    return '<div class="table-wrapper"><table>\n'


def plain_open(token: Token) -> str:
    """Without the attributes that are for scripts."""
    attributes = (
        f' {name}="{escape(str(value))}"'
        for name, value in token.attrs.items()
        if not name.startswith(("data-", "aria-"))
    )
    return f"<{token.tag}{''.join(attributes)}>"
