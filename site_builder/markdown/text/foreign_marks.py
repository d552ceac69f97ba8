"""Marks that mean something in other kinds of Markdown, or in TeX, and here would be printed as
they stand, without a word."""

import re
from collections.abc import Iterator, Sequence
from itertools import pairwise

from markdown_it.token import Token

from site_builder.markdown.text.suspects import (
    Suspect,
    has_one,
    marks_of,
    possible,
    suspicious,
)

FOREIGN = (
    (("@",), r"(\[-?@[^\]\n]+\])", "is no citation; legal: '{cite}`KEY`'"),
    (
        ("@",),
        r"(?<![\w.])(@(?:fig|sec|eq|tbl|thm|lst)[-:][\w-]+)",
        "is no reference; legal: '{ref}`TARGET`'",
    ),
    (
        ("{",),
        r"(\{\{[^}\n]*\}\}|\{%[^}\n]*%\})",
        "is no template here; legal: the words themselves",
    ),
    (
        ("{",),
        r"(?<!\\)(\{(?:[#.][\w:-]+|\w+=)[^}\n]*\})",
        "gives nothing an id or a class; legal: ':label:' in a directive, '(label)' behind a "
        "displayed formula",
    ),
    (("~",), r"(~~[^~\s][^~\n]*~~)", "strikes nothing out; legal: without these words"),
    (("=",), r"(==[^=\s](?:[^=\n]*[^=\s])?==)", "marks nothing; legal: '**…**'"),
    (
        ("^", "~"),
        r"(\w\^[^\s^]+\^|\w~[^\s~]+~)",
        "raises or lowers nothing; legal: a formula, '$x^2$'",
    ),
    (("[",), r"(\[\[[^\]\n]+\]\])", "leads nowhere; legal: '{ref}`TARGET`'"),
    (
        ("[",),
        r"(\[(?:toc|TOC|_TOC_)\])",
        "makes no contents; legal: nothing, they stand on every page",
    ),
    (("!",), r"(\[!\w+\])", "opens no callout; legal: ':::{note}'"),
    (("!",), r"^(!!!+ ?\w+)", "opens no callout; legal: ':::{note}'"),
    (
        ("#",),
        r"^(#{2,6}\w[^\n]*|#[A-Za-z][^\n]*)",
        "is no heading; legal: a space behind the '#'",
    ),
    (("*",), r"^(\*\[[^\]\n]+\]:)", "explains no abbreviation; legal: a term of the glossary"),
    (
        ("]",),
        r"^(\[[^\]\n^]+\]:\s*\S+)",
        "is no address of a link; legal: '[words]: https://…'",
    ),
    (("<",), r"(<[A-Za-z][\w+.-]*:[^>\s]*>)", "leads nowhere; legal: '<https://…>'"),
    (("&",), r"(&[A-Za-z][A-Za-z0-9]+;)", "is no character; legal: the character itself"),
    (
        (":",),
        r"(?<=\s)(:[a-z][a-z_]+:)(?=\s|$)",
        "is no picture; legal: the character itself",
    ),
    (
        (":",),
        r"^(:[a-z][\w-]*:)(?:$|\s+\S+\s)",
        "is no option here; legal: directly below the line that opens the directive",
    ),
    (
        ("\\",),
        r"(\\(?:cite[pt]?|ref|eqref|label|footnote|newpage|begin|end|section|subsection|textbf"
        r"|textit|emph|url|href|includegraphics)\b(?:\{[^}\n]*\})?)",
        "is TeX outside of a formula; legal: Markdown, roles and directives",
    ),
)
"""What of them is found in running text, and what would be legal; first what all that a pattern
fits has in it."""
SUSPECTS = tuple(
    Suspect(marks, re.compile(pattern), expected) for marks, pattern, expected in FOREIGN
)
OLD_ROLE = re.compile(r"(:[a-z]+:)$")
TASK = re.compile(r"\[[ xX?]\](?:\s|$)")
DEFINITION = re.compile(r"^: +\S")
MARKS = ("[", "\n", "`", "\\")
"""One of these is in a paragraph of which more is seen than patterns."""
HOLE = "\ufffc"
QUESTIONS = ("quiz", "predict")
"""Directives in which marks of answers, and replies below them, have a meaning."""


def foreign_marks(tokens: Sequence[Token], source: str) -> Iterator[tuple[int, str]]:
    """Line and message of each; ``source`` is what the tokens are of."""
    around: list[str] = []
    suspects = possible(SUSPECTS, source)
    marks = marks_of(suspects)
    all_marks = (*marks, *MARKS)
    for token in tokens:
        match token.type:
            case "directive_open":
                around.append(token.meta["call"].name)
            case "directive_close":
                around.pop()
            case "inline":
                if not has_one(token.content, all_marks):
                    continue
                line = (token.map or [0])[0] + 1
                asked = any(name in QUESTIONS for name in around)
                for below, said in _in_paragraph(token, suspects, marks, asked=asked):
                    yield line + below, said


def _runs(children: Sequence[Token]) -> Iterator[str]:
    """The text of each line, `HOLE` in the place of all that is more than text."""
    if len(children) == 1 and children[0].type == "text":
        yield children[0].content
        return
    run = ""
    for child in children:
        if child.type in ("softbreak", "hardbreak"):
            yield run
            run = ""
        elif child.type == "text" or (child.type == "text_special" and len(child.content) == 2):
            run += child.content  # a backslash that escapes nothing is kept with its letter
        else:
            run += HOLE
    yield run


def _in_paragraph(
    inline: Token, suspects: Sequence[Suspect], marks: Sequence[str], *, asked: bool
) -> Iterator[tuple[int, str]]:
    """What is seen of several parts of a paragraph, each with the lines above it."""
    children, content = inline.children or [], inline.content
    if not asked and TASK.match(content):
        expected = "an answer of ':::{quiz}', or a list without marks"
        yield 0, f"{content[:3]!r} marks nothing outside of a question; legal: {expected}"
    for below, run in enumerate(_runs(children)):
        for what, expected in suspicious(run, suspects, marks):
            yield below, f"'{what}' {expected}"
    if "\n" in content:
        for below, line in enumerate(content.split("\n")[1:], start=1):
            if not asked and DEFINITION.match(line.lstrip()):
                expected = "a term in bold, or an empty line above"
                yield below, f"{line.strip()[:30]!r} defines nothing; legal: {expected}"
    if "`" in content:
        yield from _old_roles(children)
    if "\\" in content:
        yield from _tex_brackets(children)


def _old_roles(children: Sequence[Token]) -> Iterator[tuple[int, str]]:
    below = 0
    for child, following in pairwise(children):
        if child.type in ("softbreak", "hardbreak"):
            below += 1
        role = OLD_ROLE.search(child.content) if child.type == "text" else None
        if role and following.type == "code_inline":
            name = role[1].strip(":")
            yield below, f"'{role[1]}`…`' is no role; legal: '{{{name}}}`…`'"


def _tex_brackets(children: Sequence[Token]) -> Iterator[tuple[int, str]]:
    r"""``\(x\)``, and ``\[x\]`` that stands alone, which Markdown takes for brackets."""
    opened: str = ""
    below = 0
    for place, child in enumerate(children):
        if child.type in ("softbreak", "hardbreak"):
            below += 1
        if child.type != "text_special":
            continue
        if child.markup == r"\(" or (child.markup == r"\[" and place == 0):
            opened = child.markup
        elif opened and child.markup == {r"\(": r"\)", r"\[": r"\]"}[opened]:
            expected = "'$…$'" if opened == r"\(" else "'$$…$$'"
            yield below, f"'{opened}…{child.markup}' makes no formula; legal: {expected}"
            opened = ""
