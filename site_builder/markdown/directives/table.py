"""Tables: each in a wrapper that scrolls on narrow screens; ``{table} Caption`` gives it a name."""

from collections.abc import Sequence

from markdown_it import MarkdownIt
from markdown_it.renderer import RendererProtocol
from markdown_it.token import Token
from markdown_it.utils import EnvType, OptionsDict

from site_builder.book import CaptionedTable
from site_builder.markdown.blocks import check_options, read_html
from site_builder.markdown.fences import Directive
from site_builder.markdown.reading import Reading


def table_plugin(parser: MarkdownIt) -> None:
    parser.enable("table")
    parser.add_render_rule("table_open", _open)
    parser.add_render_rule("table_close", _close)


def _open(
    _renderer: RendererProtocol, _t: Sequence[Token], _i: int, _o: OptionsDict, _e: EnvType
) -> str:
    # Focusable, so that it can be scrolled by keyboard.
    return '<div class="table-wrapper" tabindex="0" role="group" aria-label="Table"><table>\n'


def _close(
    _renderer: RendererProtocol, _t: Sequence[Token], _i: int, _o: OptionsDict, _e: EnvType
) -> str:
    return "</table></div>\n"


def read_table(
    directive: Directive, body: Sequence[Token], reading: Reading
) -> CaptionedTable | None:
    check_options(directive, (), reading)
    if not directive.argument:
        reading.problem(directive.line, "{table} has no caption; legal: ':::{table} Caption'")
    if [token.type for token in body if token.level == body[0].level] != [
        "table_open",
        "table_close",
    ]:
        found = (
            "more than a table" if any(token.type == "table_open" for token in body) else "no table"
        )
        reading.problem(directive.line, f"{{table}} holds {found}; legal: one table, nothing else")
        return None
    return CaptionedTable(
        reading.inline_html(directive.argument, directive.line),
        read_html(directive, body, reading),
    )
