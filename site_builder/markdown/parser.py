"""The Markdown of the book: CommonMark and what is added to it, in order. Each rule has a file."""

from functools import partial

from markdown_it import MarkdownIt
from mdit_py_plugins.dollarmath import dollarmath_plugin
from mdit_py_plugins.footnote import footnote_plugin
from mdit_py_plugins.front_matter import front_matter_plugin

from site_builder.languages.words import ENGLISH, Words
from site_builder.markdown.directives import DIRECTIVES
from site_builder.markdown.fences import directive_rule
from site_builder.markdown.role import role_rule
from site_builder.markdown.roles import ROLES
from site_builder.markdown.text.heading_ids import heading_ids_rule
from site_builder.markdown.text.stray_marks import stray_marks_rule
from site_builder.markdown.text.typography import typography_rule

ENDED_BY_DIRECTIVES = ["paragraph", "reference", "blockquote", "list", "footnote_def"]
"""Blocks that need no empty line before a directive."""


def make_parser(words: Words = ENGLISH) -> MarkdownIt:
    """CommonMark with the book's additions, and the quotation marks of its language."""
    quotes = words("language.quotes")
    parser = MarkdownIt("commonmark", {"typographer": True, "html": True, "quotes": quotes})
    parser.enable(["table", "smartquotes"])
    parser.use(front_matter_plugin).use(footnote_plugin)
    # Labels as written: what is no label is reported.
    parser.use(dollarmath_plugin, allow_space=False, allow_digits=False, label_normalizer=str)
    # Each before the rule that would otherwise take, or change, what is meant for it.
    directives = partial(directive_rule, {directive.name: directive for directive in DIRECTIVES})
    roles = partial(role_rule, {role.name: role for role in ROLES})
    parser.block.ruler.before("math_block", "directive", directives, {"alt": ENDED_BY_DIRECTIVES})
    parser.inline.ruler.before("backticks", "role", roles)
    parser.inline.add_terminator_char("{")  # where a run of text stops, since a role may begin
    parser.core.ruler.before("smartquotes", "typography", typography_rule)
    parser.core.ruler.before("typography", "heading_ids", heading_ids_rule)
    # Before escaped characters, which are meant, are joined with the text around them.
    parser.core.ruler.before("text_join", "stray_marks", stray_marks_rule)
    return parser
