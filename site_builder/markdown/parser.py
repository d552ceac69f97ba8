"""One Markdown file to one `Chapter`: parse, annotate, split into blocks."""

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

from markdown_it import MarkdownIt
from markdown_it.renderer import RendererProtocol
from markdown_it.token import Token
from markdown_it.utils import EnvType, OptionsDict
from mdit_py_plugins.dollarmath import dollarmath_plugin
from mdit_py_plugins.footnote import footnote_plugin
from mdit_py_plugins.front_matter import front_matter_plugin

from simulations.engine.scene import Scene
from site_builder.book import Chapter
from site_builder.diagnostics import Diagnostics
from site_builder.markdown.blocks import read_blocks
from site_builder.markdown.directives.callout import TITLES, read_callout
from site_builder.markdown.directives.example import read_example
from site_builder.markdown.directives.extremes import read_extremes
from site_builder.markdown.directives.figure import read_illustration
from site_builder.markdown.directives.ladder import read_ladder, read_ladder_table
from site_builder.markdown.directives.quiz import read_quiz
from site_builder.markdown.directives.simulation import read_simulation
from site_builder.markdown.directives.source import read_listing
from site_builder.markdown.directives.stage_costs import read_stage_cost_table
from site_builder.markdown.directives.table import read_table, table_plugin
from site_builder.markdown.fences import directive_plugin
from site_builder.markdown.front_matter import read_front_matter
from site_builder.markdown.inline import annotate, chapter_id
from site_builder.markdown.reading import PAGE_IDS, Construct, Reading
from site_builder.markdown.role import roles_plugin
from site_builder.markdown.text.stray_marks import stray_marks_plugin
from site_builder.markdown.text.typography import typography_plugin
from site_builder.markdown.text_role import TEXT_ROLES, text_role
from site_builder.measured.measurements import Measurements

CONSTRUCTS: Mapping[str, Construct] = {
    "simulation": read_simulation,
    "quiz": read_quiz,
    **dict.fromkeys(TITLES, read_callout),
    "example": read_example,
    "source": read_listing,
    "figure": read_illustration,
    "table": read_table,
    "extremes": read_extremes,
    "ladder": read_ladder,
    "ladder-table": read_ladder_table,
    "stage-costs": read_stage_cost_table,
}
"""Every directive, and what reads it."""


def make_parser() -> MarkdownIt:
    """CommonMark with the book's additions."""
    parser = MarkdownIt("commonmark", {"typographer": True, "html": True})
    parser.enable("smartquotes")
    parser.use(front_matter_plugin).use(footnote_plugin).use(directive_plugin)
    parser.use(dollarmath_plugin, allow_labels=False, allow_space=False, allow_digits=False)
    parser.use(table_plugin).use(roles_plugin).use(typography_plugin).use(stray_marks_plugin)
    for name in TEXT_ROLES:
        parser.use(text_role, name)
    parser.add_render_rule("math_inline", _formula)
    parser.add_render_rule("math_block", _equation)
    parser.add_render_rule("fence", _code)
    return parser


def read_chapter(
    text: str,
    path: str,
    number: int,
    *,
    root: Path,
    problems: Diagnostics,
    load_scene: Callable[[str], Scene],
    measurements: Measurements,
) -> Chapter:
    """The chapter in ``text``; mistakes go to ``problems`` and reading goes on."""
    parser = make_parser()
    reading = Reading(path, root, problems, load_scene, parser, CONSTRUCTS, measurements)
    tokens = parser.parse(text, reading.env)
    for line, message in reading.env.pop("problems", ()):
        reading.problem(line, message)
    matter = read_front_matter(tokens, reading)
    annotate(tokens, reading)
    body = read_blocks(tokens, reading)
    return Chapter(
        number=number,
        id=chapter_id(path),
        path=path,
        title=matter["title"],
        summary=matter["summary"],
        body=body,
        headings=tuple(reading.headings),
        anchors=frozenset(reading.ids) - set(PAGE_IDS),
        links=tuple(reading.links),
    )


def _formula(
    _renderer: RendererProtocol, tokens: Sequence[Token], index: int, _o: OptionsDict, _e: EnvType
) -> str:
    return str(tokens[index].meta.get("mathml", ""))


def _equation(
    renderer: RendererProtocol, tokens: Sequence[Token], index: int, o: OptionsDict, e: EnvType
) -> str:
    return f'<div class="equation">{_formula(renderer, tokens, index, o, e)}</div>\n'


def _code(
    _renderer: RendererProtocol, tokens: Sequence[Token], index: int, _o: OptionsDict, _e: EnvType
) -> str:
    return str(tokens[index].meta.get("html", ""))
