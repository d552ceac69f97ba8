"""What other tools' users type, where its meaning is ours: MyST's labels, fences of backticks and
roles, equations as LaTeX and Quarto write them. It is read as if written in our form, line by line,
so that places stay right. What has another name here is said to have it (`CALLED`)."""

import re
from collections.abc import Collection, Iterator
from functools import partial

from markdown_it.rules_core import StateCore

from site_builder.diagnostics.diagnostic import TARGETS, quoted, unknown
from site_builder.document.places import chapter_id

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
    "list-table": "'table'",
    "code code-block": "code between '```python' and '```'",
    "code-cell python plot": "a figure, ':::{simulation}', or a block '```calc'",
    "tab-set tab-item dropdown grid card": "headings, '{.deeper}'",
    "toctree tableofcontents": "'chapters' in content/book.toml",
    "bibliography": "'{cite}`key`', of which the list is made",
    "index": "'{index}`words`'",
    "raw contents": "nothing in its place",
}
CALLED = {name: here for names, here in KINDS.items() for name in names.split()}
"""Directives of others, and what is here in their place."""
ROLES = {
    **dict.fromkeys(("eq", "numref", "doc", "ref"), "ref"),
    "cite:p": "cite",
    "cite:t": "citet",
}
ROLE = re.compile(rf"(?<!`)\{{({'|'.join(ROLES)}|math)\}}`([^`\n]+)`")
FENCE = re.compile(r"(`{3,}|~{3,})\{([\w:-]+)\}(.*)")
CODE = re.compile(r"\s*(`{3,}|~{3,})")
LABEL = re.compile(r"\(([\w:.-]+)\)=\s*")
TEX_LABEL = re.compile(r"\\label\{([^}]*)\}")
BEGIN = re.compile(r"\\begin\{(equation|align|gather|multline|eqnarray)(\*?)\}(.*)|\\\[()()(.*)")
INSIDE = {"equation": "", "gather": "gathered", "multline": "gathered"}
COMMAND = re.compile(r"\\(cite\w*|(?:eq)?ref|begin|end|label|textbf|emph|footnote)\{[^}\n]*\}")
CODE_OR_FORMULA = r"(?P<tick>`+)(?!`).*?(?<!`)(?P=tick)(?!`)|\$\$.*?\$\$|(?<!\\)\$(?:\\.|[^$\\])+\$"
APART = re.compile(CODE_OR_FORMULA)
"""Code and formulae within a line."""
TARGET = r"(?:(?P<file>[\w-]+\.md))?(?:#(?P<anchor>[\w:.-]+))?"
RUNNING = re.compile(
    rf"(?P<apart>{CODE_OR_FORMULA})"
    r"|(?<!\\)\\\((?P<tex>.+?)\\\)"
    r"|(?<!\\)\\\[(?P<display>(?=\s|[^=^_\\\n]*(?:[=^_]|\\[^][]))(?:\\[^][\n]|[^\\\n])+)\\\]"
    rf"|(?<![!\]\\])\[(?P<words>\s*|[^\]\[]*%s[^\]\[]*)\]\({TARGET}\)"
    r"|(?<![!\]\\])(?P<empty>\[\s*\]\([^)\s]*\))"
)
"""Formulae as LaTeX has them, and MyST's links, which are filled with what they lead to."""
LOOKS_LIKE_TEX = re.compile(r"[\\^_=]").search
AFTER = re.compile(r"\$\$\s*\{#([\w:.-]+)\}\s*$")


def unknown_directive(name: str, ours: Collection[str]) -> str:
    """That there is none of this name, and what there is."""
    last = re.sub(r".*:|-(start|end)$", "", name.lower())  # of ``prf:Theorem``, ``solution-end``
    here = CALLED.get(last) or (f"'{last}'" if last != name and last in ours else "")
    found = unknown("directive", name, ours)
    return f"unknown directive {name!r}; legal: {here}" if here else found


def dialects_rule(ours: Collection[str], state: StateCore) -> None:
    """Before all others. ``ours``: names of directives."""
    lines = state.src.split("\n")
    problems = state.env.setdefault("problems", [])
    code = [*_code(lines, ours, problems)]
    for place, line in enumerate(lines):
        if not code[place]:
            line = RUNNING.sub(partial(_running, "|" in line, place + 1, problems), line)
            lines[place] = AFTER.sub(lambda found: f"$$ ({_ours(found[1])})", ROLE.sub(_role, line))
            if LABEL.fullmatch(line):
                _label(lines, place)
    _equations(lines, code, problems)
    _fences(lines, code, ours)
    state.src = "\n".join(lines)


def _code(lines: list[str], ours: Collection[str], problems: list[Problem]) -> Iterator[bool]:
    """Whether each line is code to be read, its fences included. Others' cells become plain code,
    which is reported."""
    marker, outer = "", list[str]()
    for place, line in enumerate(lines):
        fence, text = CODE.match(line), line.strip()
        opens = ""
        if not marker and outer and text == outer[-1]:
            outer.pop()
        elif not marker and fence and _directive(text, ours):
            outer.append(fence[1])
        elif not marker and fence:
            opens = fence[1]
            if cell := FENCE.fullmatch(text):
                problems.append((place + 1, unknown_directive(cell[2], ours)))
                lines[place] = line.replace(f"{{{cell[2]}}}{cell[3]}", "text")
        yield bool(marker or opens)
        if marker and text.startswith(marker) and not text.strip(marker[0]):
            marker = ""
        marker = marker or opens


def _directive(text: str, ours: Collection[str]) -> bool:
    """Whether it opens or closes a directive that is fenced as code is."""
    fence = FENCE.fullmatch(text)
    return bool(fence and (fence[2] in ours or fence[2] == "math"))


def _ours(label: str) -> str:
    return "-".join(re.findall("[a-z0-9]+", label.lower()))


def _role(found: re.Match[str]) -> str:
    name, text = found.groups()
    if name == "math":
        return f"${text}$"
    words, _, target = text.rpartition("<")
    if name.startswith("cite") or (name == "ref" and not re.search("[:_]", target)):
        return f"{{{ROLES[name]}}}`{text}`"
    own = "#".join(map(_ours, target.rstrip("> ").split("#")))
    is_plain = name in ("eq", "numref") or not words
    return f"{{ref}}`{own}`" if is_plain else f"{{ref}}`{words}<{own}>`"


def _running(in_table: bool, line: int, problems: list[Problem], found: re.Match[str]) -> str:
    """What `RUNNING` finds, in our form. In a table the bar of a norm would end a cell."""
    apart, tex, display, words = found.group("apart", "tex", "display", "words")
    if apart:
        return apart.replace("\\|", "\\Vert{}") if in_table and apart[0] == "$" else apart
    if tex or display:
        return f"${tex.strip()}$" if tex else f"$${display.strip()}$$"
    file, anchor = found.group("file", "anchor")
    if file or anchor:
        target = "#".join(filter(None, (file and chapter_id(file), anchor and _ours(anchor))))
        shown = words.strip().replace("%s", "{number}")
        return f"{{ref}}`{shown} <{target}>`" if shown else f"{{ref}}`{target}`"
    message = f"{quoted(found[0])} is a link without words; legal: '[words](…)'"
    problems.append((line, message))
    return "words"


def _label(lines: list[str], place: int) -> None:
    """Give it to the heading, formula or directive below."""
    found = LABEL.fullmatch(lines[place])
    below = next((n for n in (place + 1, place + 2) if lines[n : n + 1] and lines[n].strip()), 0)
    name, text = _ours(found[1]) if found else "", lines[below].strip()
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
    """Environments outside of dollars; other commands there are reported."""
    end = -1
    for place, line in enumerate(lines):
        text = line.strip()
        if code[place] or place <= end:
            continue
        if text.startswith("$$") and text.count("$$") == 1:
            blank = next((n for n in range(place, len(lines)) if not lines[n].strip()), len(lines))
            end = next((n for n in range(place + 1, blank) if "$$" in lines[n]), -1)
            if end < 0:
                later = next((n for n in range(blank, len(lines)) if "$$" in lines[n]), 0)
                between = [text for text in lines[blank:later] if text.strip()]
                end = later if later and all(map(LOOKS_LIKE_TEX, between)) else blank - 1
                _drop_formula(lines, place, end, problems)
            continue
        begin = BEGIN.fullmatch(text)
        name, star, rest = (
            (begin[n] or begin[n + 3] or "" for n in (1, 2, 3)) if begin else [""] * 3
        )
        closing = f"\\end{{{name}{star}}}" if name else "\\]"
        ends = (n for n in range(place, len(lines)) if lines[n].rstrip().endswith(closing))
        if begin and (last := next(ends, -1)) >= place:
            end, inside = last, INSIDE.get(name, "aligned") if name else ""
            labels = TEX_LABEL.findall("\n".join(lines[place : end + 1]))
            lines[place] = f"$${inside and f'\\begin{{{inside}}}'}{rest}"
            body = lines[end].rstrip().removesuffix(closing)
            label = f" ({_ours(labels[0])})" if labels else ""
            lines[end] = f"{body}{inside and f'\\end{{{inside}}}'}$${label}"
            for n in range(place, end + 1):
                lines[n] = TEX_LABEL.sub("", lines[n])
            continue
        commands = [found[0] for found in COMMAND.finditer(APART.sub("", line))]
        for command in dict.fromkeys(each.replace(r"\end{", r"\begin{") for each in commands):
            said = "'{cite}`key`', '{ref}`TARGET`', Markdown, or between '$$'"
            problems.append((place + 1, f"{quoted(command)} outside of a formula; legal: {said}"))


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
                closing.append((marker, f"$$ ({_ours(label[1])})" if label else "$$"))
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
