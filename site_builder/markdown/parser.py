"""The Markdown of the book: CommonMark and what is added to it, in order. Each rule has a file."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache, partial
from typing import Any

from markdown_it import MarkdownIt
from markdown_it.common.normalize_url import normalizeLink
from mdit_py_plugins.dollarmath import dollarmath_plugin
from mdit_py_plugins.footnote import footnote_plugin
from mdit_py_plugins.front_matter import front_matter_plugin

from site_builder.languages.words import ENGLISH, Words
from site_builder.markdown.directives import DIRECTIVES
from site_builder.markdown.fences import directive_rule
from site_builder.markdown.role import role_rule
from site_builder.markdown.roles import ROLES
from site_builder.markdown.text.stray_marks import stray_marks_rule
from site_builder.markdown.text.typography import typography_rule


@dataclass(frozen=True, slots=True)
class Rule:
    """One rule of ours and its place among those of the parser."""

    chain: str
    """``block`` finds paragraphs, lists, …; ``inline`` works in each; ``core`` on all tokens."""
    name: str
    before: str
    """The rule that would otherwise take, or change, what is meant for this one."""
    run: Callable[..., Any]
    ends: tuple[str, ...] = ()
    """Blocks that it ends without an empty line before it."""


STANDARD = ("table", "smartquotes")
"""Rules of the parser's own that CommonMark leaves out."""

PLUGINS: tuple[Callable[[MarkdownIt], None], ...] = (
    front_matter_plugin,
    footnote_plugin,
    partial(
        dollarmath_plugin,
        allow_space=False,
        allow_digits=False,
        label_normalizer=str,  # as written; what is no label is reported
    ),
)

RULES = (
    Rule(
        "block",
        "directive",
        before="math_block",
        run=partial(directive_rule, {directive.name: directive for directive in DIRECTIVES}),
        ends=("paragraph", "reference", "blockquote", "list", "footnote_def"),
    ),
    Rule(
        "inline",
        "role",
        before="backticks",
        run=partial(role_rule, {role.name: role for role in ROLES}),
    ),
    Rule("core", "typography", before="smartquotes", run=typography_rule),
    # Before escaped characters, which are meant, are joined with the text around them.
    Rule("core", "stray_marks", before="text_join", run=stray_marks_rule),
)
"""``make_parser().get_all_rules()`` shows them among all others."""


class _Markdown(MarkdownIt):
    def normalizeLink(self, url: str) -> str:  # noqa: N802  (markdown-it's name)
        return _normalized(url)


@lru_cache(maxsize=4096)
def _normalized(url: str) -> str:
    """Remembered, as a book links to the same places again and again."""
    return normalizeLink(url)


def make_parser(words: Words = ENGLISH) -> MarkdownIt:
    """CommonMark with the book's additions, and the quotation marks of its language."""
    quotes = words("language.quotes")
    parser = _Markdown("commonmark", {"typographer": True, "html": True, "quotes": quotes})
    parser.enable(list(STANDARD))
    for plugin in PLUGINS:
        parser.use(plugin)
    for rule in RULES:
        ruler = getattr(parser, rule.chain).ruler
        ruler.before(rule.before, rule.name, rule.run, {"alt": list(rule.ends)})
    parser.inline.add_terminator_char("{")  # where a run of text stops, since a role may begin
    return parser
