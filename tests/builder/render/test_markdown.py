"""Passages as Markdown: read again, it says the same."""

from collections.abc import Callable

import pytest
from markdown_it import MarkdownIt
from mdit_py_plugins.dollarmath import dollarmath_plugin

from site_builder.build import Options, load
from site_builder.document.blocks import Prose, contents
from site_builder.render.markdown import MarkdownRenderer, code, quoted, table

SIGNS = r"A \*star\*, a \_line\_, a [bracket], 2 < 3, \$5, \# 1, a \`tick\` and a \\ back slash."
READ_AGAIN = MarkdownIt("commonmark").enable("table").use(dollarmath_plugin)


@pytest.fixture
def written(make_book: Callable[..., Options]) -> Callable[[str], str]:
    """The Markdown of a body's prose; links lead nowhere but out."""
    macros = {"R": r"\role{ray}{\bm{R}}"}
    render = MarkdownRenderer(macros, lambda href: href if ":" in href else "")

    def write(body: str) -> str:
        loaded = load(make_book(body))
        assert not loaded.problems.found
        return "\n\n".join(
            render(prose.words) for prose in contents(loaded.book.chapters[0].body, Prose)
        )

    return write


def shown(markdown: str) -> str:
    return str(READ_AGAIN.render(markdown))


@pytest.mark.parametrize(
    "body",
    [
        SIGNS,
        "1\\. is no list, and neither is\n\\- this, or\n\\# that.",
        "- One\n- Two\n  - Three\n\n4. Four\n\n   More of it.\n5. Five",
        "> Words that *another* said, in **two**\n> lines.",
        "```python\nx = '```'\n```",
        "Call `f(a|b)`, or ``a`b``.",
        "| Left | Right |\n|:---|---:|\n| one \\| two | `c\\|d` |",
    ],
)
def test_what_is_written_shows_what_the_author_wrote(
    written: Callable[[str], str], body: str
) -> None:
    assert shown(written(body)) == shown(body)


def test_formulae_have_their_numbers_and_the_commands_of_the_book(
    written: Callable[[str], str],
) -> None:
    body = "In $\\role{ray}{x} \\in \\R$, (half of $a$).\n\n$$\nx^2\n$$ (eq-square)\n"
    assert written(body) == (
        r"In $\def\R{{\boldsymbol{R}}}{x} \in \R$, (half of $a$)." "\n\n$$\nx^2 \\tag{0.1}\n$$"
    )


def test_a_link_without_an_address_is_its_words(written: Callable[[str], str]) -> None:
    body = "See [the second](01-second.md) and [a host](https://host/a_b)."
    assert written(body) == "See the second and [a host](https://host/a_b)."


def test_a_bar_ends_no_cell_and_stays_in_formulae() -> None:
    row = table(["a"], [[r"$|x| = \|y\|$ | z"]]).splitlines()[-1]
    assert row == r"| $\vert x\vert  = \Vert y\Vert $ \| z |"


def test_formulae_within_quotations_are_of_one_line() -> None:
    assert quoted("So\n\n$$\na\n= b\n$$") == "> So\n>\n> $$a = b$$"


def test_code_with_ticks_has_more_around_it() -> None:
    assert code("a`b") == "`` a`b ``"
