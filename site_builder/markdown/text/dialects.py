"""What other tools' users type, where its meaning is ours: MyST's labels, fences of backticks and
roles, equations as LaTeX and Quarto write them. It is read as if written in our form, line by line,
so that places stay right. What has another name here is said to have it (`CALLED`)."""

import re
from collections.abc import Collection, Iterator
from functools import partial

from markdown_it.rules_core import StateCore

from site_builder.diagnostics.diagnostic import TARGETS, quoted, unknown
from site_builder.document.places import chapter_id
from site_builder.markdown.text.code import PARTS

type Problem = tuple[int, *tuple[str, ...]]
"""A line, a message about it, and what follows from the mistake."""
KINDS = {
    "admonition seealso proof theorem definition lemma": "'note', 'tip', 'warning', 'key-idea', or "
    "one of [boxes] in content/book.toml",
    "solution": "'quiz', 'predict' or 'exercise' with its answers",
    "caution danger attention callout-caution callout-warning": "'warning'",
    "important callout-important": "'key-idea'",
    "hint callout-tip": "'tip'",
    "callout-note": "'note'",
    "image": "'figure'",
    "list-table csv-table": "'table'",
    "margin sidebar aside": "'note'",
    "glossary": "content/glossary.toml",
    "include": "the text itself",
    "literalinclude": "'source'",
    "code code-block": "code between '```python' and '```'",
    "code-cell python plot": "a figure, ':::{simulation}', or a block '```calc'",
    "tab-set tab-item dropdown grid card": "headings, '{.deeper}'",
    "toctree tableofcontents": "'chapters' in content/book.toml",
    "bibliography": "'{cite}`key`', of which the list is made",
    "index": "'{index}`words`'",
    "raw contents": "nothing in its place",
}
ROLE_KINDS = {
    "sub sup subscript superscript": "a formula, '$…$'",
    "abbr dfn": "'{term}`…`'",
    "kbd guilabel menuselection command file samp": "'**…**' or code",
    "download": "'[words](https://…)'",
    "eval": "'{calc}`…`'",
}
ROLES = {
    **dict.fromkeys(("eq", "numref", "doc", "ref"), "ref"),
    "cite:p": "cite",
    "cite:t": "citet",
}
CALLED = {name: here for names, here in (KINDS | ROLE_KINDS).items() for name in names.split()}
"""Directives and roles of others, and what is here in their place."""
ROLE = re.compile(rf"(?<!`)\{{({'|'.join(ROLES)}|math)\}}`([^`\n]+)`")
FENCE = re.compile(r"(`{3,}|~{3,})\{([\w:-]+)\}(.*)")
OWN_CODE = ("calc", *PARTS)
CODE = re.compile(r"\s*(`{3,}|~{3,})")
LABEL = re.compile(r"\(([\w:.-]+)\)=\s*")
TEX_LABEL = re.compile(r"(?:\\label\{|\(\\#)([^})]*)[})]")
"""In a formula; of bookdown, ``(\\#eq:law)``."""
BEGIN = re.compile(r"\\begin\{(equation|align|gather|multline|eqnarray)(\*?)\}(.*)|\\\[()()(.*)")
INSIDE = {"equation": "", "gather": "gathered", "multline": "gathered"}
CODE_OR_FORMULA = r"(?P<tick>`+)(?!`).*?(?<!`)(?P=tick)(?!`)|\$\$.*?\$\$|(?<!\\)\$(?:\\.|[^$\\])+\$"
"""Code and formulae within a line."""
TARGET = r"(?:\./)?(?:(?P<file>[\w-]+\.md))?(?:#(?P<anchor>[\w:.-]+))?"
RUNNING = re.compile(
    rf"(?P<apart>{CODE_OR_FORMULA})"
    r"|(?<!\\)\\\((?P<tex>.+?)\\\)"
    r"|(?<!\\)\\\[(?P<display>(?=\s|[^=^_\\\n]*(?:[=^_]|\\[^][]))(?:\\[^][\n]|[^\\\n])+)\\\]"
    r"|(?<![!\]\\])\[(?P<cites>@[\w:.+-]+(?:,[^][;@]*)?(?:;\s*@[\w:.+-]+(?:,[^][;@]*)?)*)\](?![(\[])"
    rf"|(?<![!\]\\])\[(?P<words>\s*|[^\]\[]*%s[^\]\[]*)\]\({TARGET}\)"
    r"|\\@ref\((?P<ref>[\w:.-]+)\)"
    r"|(?<![!\]\\])(?P<empty>\[\s*\]\([^)\s]*\))"
)
"""Formulae as LaTeX has them, Pandoc's citations, bookdown's references, and MyST's links, which
are filled with what they lead to."""
LOOKS_LIKE_TEX = re.compile(r"[\\^_=]").search
BEHIND = re.compile(r"\$\$\s*(?:\{#|\()([\w:.-]+)[})]\s*$")
BELOW = re.compile(r"\s*\(([\w:.-]+)\)=?\s*")
START = re.compile(r"(?:[\s\u200b\u2060\ufeff]|[#>*+-]+(?=\s)|\d{1,9}[.)](?=\s)|：{3,})+")
"""What makes a line a heading, an item or a directive."""
DROPPED = re.compile(r"%.*|\+\+\+(?:\s.*)?")
"""MyST's comments, and the ends of its blocks."""
GRID = re.compile(r"\+(?:[-=:]{3,}\+)+|-{2,}(?:\s+-{2,})+")
"""A line of Pandoc's tables."""
TEX_COMMENT = re.compile(r"^\s*%.*|(?<=\s)%[^\\]*[A-Za-z]{2}[^\\]*$")


def unknown_name(kind: str, name: str, ours: Collection[str]) -> str:
    """That there is no directive or role of this name, and what there is."""
    last = re.sub(r".*:|-(start|end)$", "", name.lower())  # of ``prf:Theorem``, ``solution-end``
    here = CALLED.get(last) or (f"'{last}'" if last != name and last in ours else "")
    found = unknown(kind, name, ours)
    return f"unknown {kind} {name!r}; legal: {here}" if here else found


def dialects_rule(ours: Collection[str], state: StateCore) -> None:
    """Before all others. ``ours``: names of directives."""
    lines = state.src.split("\n")
    problems = state.env.setdefault("problems", [])
    code = [*_code(lines, ours, problems)]
    if lines[0] == "---" and "---" in lines[1:]:  # front matter
        code[: lines.index("---", 1)] = [True] * lines.index("---", 1)
    for place, line in enumerate(lines):
        if not code[place]:
            line = START.sub(_plain_start, line, 1)
            running = partial(_running, line.lstrip()[:1] == "|", place + 1, problems)
            lines[place] = ROLE.sub(_role, RUNNING.sub(running, line))
            if LABEL.fullmatch(line):
                _label(lines, place)
    _fences(lines, code, ours)
    _equations(lines, code, problems)
    state.src = "\n".join(lines)


def _plain_start(found: re.Match[str]) -> str:
    return re.sub(r"[^\S\t]", " ", re.sub("[\u200b\u2060\ufeff]", "", found[0])).replace("：", ":")


def _code(lines: list[str], ours: Collection[str], problems: list[Problem]) -> Iterator[bool]:
    """Whether each line is code to be read, its fences included. Others' cells become plain code,
    which is reported."""
    marker, outer = "", list[str]()
    for place, line in enumerate(lines):
        if re.fullmatch(r"\s*`{3,}math\s*", line) and not marker:
            lines[place] = line = line.replace("math", "{math}")
        fence, text = CODE.match(line), line.strip()
        opens = ""
        if not marker and outer and text == outer[-1]:
            outer.pop()
        elif not marker and fence and _directive(text, ours):
            outer.append(fence[1])
        elif not marker and fence:
            opens = fence[1]
            cell = FENCE.fullmatch(text)
            if cell and cell[2] in OWN_CODE:
                lines[place] = line.replace(f"{{{cell[2]}}}", cell[2])
            elif cell:
                problems.append((place + 1, unknown_name("directive", cell[2], ours)))
                lines[place] = line.replace(f"{{{cell[2]}}}{cell[3]}", "text")
        yield bool(marker or opens)
        if marker and text.startswith(marker) and not text.strip(marker[0]):
            marker = ""
        marker = marker or opens


def _directive(text: str, ours: Collection[str]) -> bool:
    """Whether it opens or closes a directive that is fenced as code is."""
    fence = FENCE.fullmatch(text)
    return bool(fence and (fence[2] in ours or fence[2] == "math"))


def own_label(label: str) -> str:
    """``fig:Two_words`` as a label of ours: ``fig-two-words``."""
    return "-".join(re.findall("[a-z0-9]+", label.lower()))


def _role(found: re.Match[str]) -> str:
    name, text = found.groups()
    if name == "math":
        return f"${text}$"
    words, _, target = text.rpartition("<")
    if name.startswith("cite") or (name == "ref" and not re.search("[:_]", target)):
        return f"{{{ROLES[name]}}}`{text}`"
    target = chapter_id(target.strip("/.> ")) if name == "doc" else target.rstrip("> ")
    own = "#".join(map(own_label, target.split("#")))
    words = words.replace("{number}", "%s") if name == "numref" else words
    return f"{{ref}}`{words}<{own}>`" if words else f"{{ref}}`{own}`"


def _running(in_table: bool, line: int, problems: list[Problem], found: re.Match[str]) -> str:
    """What `RUNNING` finds, in our form. In a row of a table a bar would end the cell."""
    apart, tex, display, words = found.group("apart", "tex", "display", "words")
    if apart:
        return _without_bars(apart) if in_table else apart
    if found["ref"]:
        return f"{{ref}}`{own_label(found['ref'])}`"
    if found["cites"]:
        return f"{{cite}}`{found['cites'].replace('@', '')}`"
    if tex or display:
        return f"${tex.strip()}$" if tex else f"$${display.strip()}$$"
    file, anchor = found.group("file", "anchor")
    if file or anchor:
        target = "#".join(filter(None, (file and chapter_id(file), anchor and own_label(anchor))))
        shown = words.strip()
        return f"{{ref}}`{shown} <{target}>`" if shown else f"{{ref}}`{target}`"
    message = f"{quoted(found[0])} is a link without words; legal: '[words](…)', '[](#label)'"
    problems.append((line, message))
    return "words"


def _without_bars(apart: str) -> str:
    if apart[0] == "`":
        return re.sub(r"(?<!\\)\|", r"\|", apart)
    is_formula = apart[1] != " " and apart[-2] != " "  # and no two prices
    return apart.replace("\\|", "\\Vert{}").replace("|", "\\vert{}") if is_formula else apart


def _label(lines: list[str], place: int) -> None:
    """Give it to the heading, formula or directive below."""
    found = LABEL.fullmatch(lines[place])
    below = next((n for n in (place + 1, place + 2) if lines[n : n + 1] and lines[n].strip()), 0)
    name, text = own_label(found[1]) if found else "", lines[below].strip()
    if text.startswith("#") and not text.endswith("}"):
        lines[place], lines[below] = "", f"{text} {{#{name}}}"
    elif text.startswith("$$"):
        ends = [n for n in range(below, len(lines)) if lines[n].strip().endswith("$$")]
        end = next((n for n in ends if n > below or text.count("$$") == 2), below)
        lines[place], lines[end] = "", f"{lines[end].rstrip()} ({name})"
    elif BEGIN.match(text):
        lines[place], lines[below] = "", f"{text}\\label{{{name}}}"
    elif text.startswith((":::{", "```{", "~~~{")):
        lines[place : below + 1] = [*[""] * (below - place - 1), text, f":label: {name}"]


def _equations(lines: list[str], code: list[bool], problems: list[Problem]) -> None:
    """Environments outside of dollars; other commands there, and tables as grids, are reported."""
    end = -1
    for place, line in enumerate(lines):
        text = line.strip()
        if code[place] or place <= end:
            continue
        if text.startswith("$$") and text.count("$$") > 1:
            _finish_formula(lines, place, place, problems)
            continue
        if text.startswith("$$"):
            blank = next((n for n in range(place, len(lines)) if not lines[n].strip()), len(lines))
            end = next((n for n in range(place + 1, blank) if "$$" in lines[n]), -1)
            if end < 0:
                later = next((n for n in range(blank, len(lines)) if "$$" in lines[n]), 0)
                between = [text for text in lines[blank:later] if text.strip()]
                end = later if later and all(map(LOOKS_LIKE_TEX, between)) else blank - 1
                _drop_formula(lines, place, end, problems)
            else:
                _finish_formula(lines, place, end, problems)
            continue
        if DROPPED.fullmatch(text):
            lines[place] = ""
            continue
        if GRID.fullmatch(text):
            blanks = (n for n in range(place, len(lines)) if not lines[n].strip())
            end = next(blanks, len(lines)) - 1
            lines[place : end + 1] = [""] * (end + 1 - place)
            message = f"{quoted(text)} begins no table"
            problems.append((place + 1, f"{message}; legal: rows '| … | … |' below '|---|---|'"))
            continue
        begin = BEGIN.fullmatch(text)
        name, star, rest = (
            (begin[n] or begin[n + 3] or "" for n in (1, 2, 3)) if begin else [""] * 3
        )
        closing = f"\\end{{{name}{star}}}" if name else "\\]"
        ends = (n for n in range(place, len(lines)) if closing in lines[n])
        if begin and (last := next(ends, -1)) >= place:
            end, inside = last, INSIDE.get(name, "aligned") if name else ""
            lines[place] = f"$${inside and f'\\begin{{{inside}}}'}{rest}"
            body, _, behind = lines[end].partition(closing)
            lines[end] = f"{body}{inside and f'\\end{{{inside}}}'}$${behind}"
            _finish_formula(lines, place, end, problems)
            continue


def _finish_formula(lines: list[str], place: int, end: int, problems: list[Problem]) -> None:
    """Drop its comments; take in a label within it, or on the line below."""
    labels = TEX_LABEL.findall("\n".join(lines[place : end + 1]))
    if labels and lines[end].rstrip().endswith("$$"):
        lines[end] = f"{lines[end].rstrip()} ({labels[0]})"
    lines[end] = BEHIND.sub(lambda found: f"$$ ({own_label(found[1])})", lines[end])
    for n in range(place, end + 1):
        for second in set(TEX_LABEL.findall(lines[n])) & {*labels[1:]}:
            message = f"second label {second!r} of a formula, whose rows have one number"
            spoils = f"unknown target {own_label(second)!r}"
            problems.append((n + 1, f"{message}; legal: a formula of its own", spoils))
        lines[n] = TEX_LABEL.sub("", lines[n])
        lines[n] = TEX_COMMENT.sub("", lines[n])
        if not lines[n]:  # which would end the formula
            lines[place : n + 1] = ["", *lines[place:n]]
    below = BELOW.fullmatch(lines[end + 1]) if end + 1 < len(lines) else None
    if below and lines[end].endswith("$$"):
        lines[end : end + 2] = [f"{lines[end]} ({own_label(below[1])})", ""]


def _drop_formula(lines: list[str], place: int, end: int, problems: list[Problem]) -> None:
    """Report a ``$$`` without its other end, and drop what would be read as text: the lines to the
    empty one, and those above that look like TeX."""
    expected = "a second '$$', with no empty line between"
    problems.append((place + 1, f"'$$' opens or closes no formula; legal: {expected}", *TARGETS))
    first = place
    while first and lines[first - 1].strip() and LOOKS_LIKE_TEX(lines[first - 1]):
        first -= 1
    lines[first : end + 1] = [""] * (end + 1 - first)
    above = [one for one in problems if first < one[0] <= place]
    problems[:] = [one for one in problems if one not in above]


def _fences(lines: list[str], code: list[bool], ours: Collection[str]) -> None:
    closing: list[tuple[str, str]] = []
    for place, line in enumerate(lines):
        text = line.strip()
        if code[place]:
            continue
        if closing and text == closing[-1][0]:
            lines[place] = closing.pop()[1]
        elif (fence := FENCE.fullmatch(text)) and _directive(text, ours):
            marker, name, rest = fence.groups()
            if name == "math":
                label = re.fullmatch(r":label:\s*(\S+)", lines[place + 1].strip())
                lines[place : place + 2] = ["", "$$"] if label else ["$$", lines[place + 1]]
                closing.append((marker, f"$$ ({own_label(label[1])})" if label else "$$"))
            else:
                lines[place] = f"{':' * len(marker)}{{{name}}}{rest}"
                closing.append((marker, ":" * len(marker)))
                _options(lines, place + 1)


def _options(lines: list[str], first: int) -> None:
    """Options between ``---``, as lines of our form."""
    if lines[first : first + 1] == ["---"] and "---" in lines[first + 1 :]:
        end = lines.index("---", first + 1)
        pairs = (line.partition(":") for line in lines[first + 1 : end])
        options = [f":{name.strip()}: {value.strip()}" for name, _, value in pairs]
        lines[first : end + 1] = [*options, "", ""]
