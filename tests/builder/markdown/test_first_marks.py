"""Rules are asked only where their marks stand; what comes out is what all rules together make."""

from random import Random
from typing import Any

import pytest
from markdown_it import MarkdownIt

from site_builder.markdown import parser as made
from site_builder.markdown.first_marks import BLOCK_MARKS, INLINE_MARKS
from site_builder.markdown.parser import make_parser

LINES = (
    "", "", "", "Words of a text.", "words, and more", "- an item", "-", "- f---", "* a star",
    "+ plus", "  - inside", "      far in", "1. first", "12) twelfth", "3.none", "# A heading",
    "## Another ##", "#none", "***", "---", "- - -", "===", "___", "> a quotation",
    ">> a deeper one",
    ">", "> - item in it", "```", "```python", "~~~", "    code", "\tcode", ":::{note} Title",
    ":::", "::::", ":option: value", "$$", "$$x$$", "$x$ and $5", "[^1]: a note", "[a]: https://b.c",
    "[a]", "see[^1]", "<div>", "<!-- gone -->", "<https://a.b/%7Bx%7D>", "| a | b |", "|---|---|",
    "| 1 | 2 |", "a | b", "--|--", "*soft* and **hard**", "_a_b_ *c", "`code` and ``",
    "{ref}`place`",
    "{ref}`words <place>`", "![p](q.png)", "[l](m.md) [n]", "&amp; &nothing; &#64;", "\\* \\(x\\)",
    "^[inline note]", "'quoted' \"words\"", "5 mm--or ... not", "chapter 3", "chapter ٣",
    "two  ", "ends\\", "[ ] task", ": defined", "٣. other digits", "\N{NO-BREAK SPACE}space", "...",
)  # fmt: skip


@pytest.fixture
def plain(monkeypatch: pytest.MonkeyPatch) -> MarkdownIt:
    """A parser that asks every rule everywhere."""
    with monkeypatch.context() as patched:
        patched.setattr(made, "ask_by_marks", lambda _parser: None)
        return make_parser()


def told(parser: MarkdownIt, text: str) -> tuple[object, ...]:
    env: dict[str, Any] = {}
    tokens = [token.as_dict() for token in parser.parse(text, env)]
    return tokens, env.get("problems"), env.get("references")


def test_any_text_is_parsed_as_by_all_rules(plain: MarkdownIt) -> None:
    random, quick = Random(7), make_parser()
    for _ in range(600):
        text = "\n".join(random.choices(LINES, k=random.randrange(1, 14)))
        begin = random.choice(("", "---\ntitle: A\n---\n\n", " "))
        end = random.choice(("", "\n", "\r\n\r\n", "   "))
        assert told(quick, begin + text + end) == told(plain, begin + text + end), text


def test_every_rule_is_named_as_the_parser_has_it(plain: MarkdownIt) -> None:
    rules = plain.get_active_rules()
    assert set(BLOCK_MARKS) <= set(rules["block"])
    assert set(INLINE_MARKS) <= set(rules["inline"])
    others = {*rules["block"]} - {*BLOCK_MARKS}, {*rules["inline"]} - {*INLINE_MARKS}
    assert others == ({"table", "code", "lheading", "paragraph"}, {"text"})
