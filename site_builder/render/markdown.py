"""Passages as Markdown for notebooks: CommonMark with tables, and formulae as TeX between dollars.

Colours of ideas are left out, as no notebook has them; what links has no address stays as words.
"""

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from textwrap import indent

from markdown_it.tree import SyntaxTreeNode

from site_builder.document.places import Passage, Target
from site_builder.formulae.temml import plain_tex
from site_builder.markdown.text.code import PARTS

SPECIAL = re.compile(r"(https?://[\w./~-]+)|([\\`*_\[\]<$~])")
"""Addresses, which notebooks make links as they stand, and marks."""
AT_START = re.compile(r"^(?=(?:[-+>]|#+|=+)(?:\s|$))|^(?<=)(\d+)(?=[.)]\s)", re.MULTILINE)
"""What would begin a list, a heading or a quotation."""
MATHS = re.compile(r"((?<!\\)\$[^$]+\$)")
DISPLAYED = re.compile(r"^\$\$\n(.+?)\n\$\$$", re.MULTILINE | re.DOTALL)
LEFT, RIGHT, CENTRE = ":---", "---:", ":---:"
RULES = {"text-align:right": RIGHT, "text-align:center": CENTRE}


@dataclass(frozen=True, slots=True)
class MarkdownRenderer:
    """Makes the Markdown of passages of one page."""

    macros: Mapping[str, str]
    address: Callable[[str], str]
    """Where a link of the page leads in the notebook; nothing where it leads nowhere."""

    def __call__(self, passage: Passage) -> str:
        return self._blocks(SyntaxTreeNode(list(passage.tokens)).children)

    def _blocks(self, nodes: Iterable[SyntaxTreeNode]) -> str:
        return "\n\n".join(filter(None, map(self._block, nodes)))

    def _block(self, node: SyntaxTreeNode) -> str:
        match node.type:
            case "inline":
                return self._inline(node)
            case "paragraph":
                return AT_START.sub(r"\1\\", self._blocks(node.children))
            case "heading":
                return f"{'#' * int(node.tag[1:])} {self._blocks(node.children)}"
            case "bullet_list":
                return self._list(node, ["-"] * len(node.children))
            case "ordered_list":
                first = int(node.attrs.get("start", 1))
                return self._list(node, [f"{first + at}." for at in range(len(node.children))])
            case "blockquote":
                return quoted(self._blocks(node.children))
            case "fence" | "code_block":
                info = node.info.strip()
                return fenced(node.content, "python" if info in PARTS else info)
            case "math_block" | "math_block_label":
                return self._equation(node)
            case "table":
                return self._table(node)
            case "hr":
                return "---"
            case "footnote":
                mark = f"{node.meta['id'] + 1}. "
                return f"{mark}{indent(self._blocks(node.children), ' ' * len(mark)).lstrip()}"
            case "html_block":
                return node.content.strip()
            case "footnote_anchor":
                return ""
            case _:
                return self._blocks(node.children)

    def _inline(self, node: SyntaxTreeNode) -> str:
        return "".join(map(self._span, node.children))

    def _span(self, node: SyntaxTreeNode) -> str:
        match node.type:
            case "text":
                return escaped(node.content)
            case "softbreak":
                return "\n"
            case "hardbreak":
                return "  \n"
            case "em" | "strong":
                marks = "*" if node.type == "em" else "**"
                return f"{marks}{self._inline(node)}{marks}"
            case "code_inline":
                return code(node.content)
            case "math_inline":
                before, after = (escaped(str(node.meta.get(s, ""))) for s in ("before", "after"))
                return f"{before}${plain_tex(node.content, self.macros)}${after}"
            case "footnote_ref":
                return f"<sup>{node.meta['id'] + 1}</sup>"
            case "html_inline":
                return node.content
            case _:
                words = self._inline(node) if node.children else escaped(node.content)
                return link(words, self.address(str(node.attrs.get("href", ""))))

    def _equation(self, node: SyntaxTreeNode) -> str:
        target: Target | None = node.meta.get("target")
        tag = f" \\tag{{{target.number}}}" if target else ""
        return f"$$\n{plain_tex(node.content, self.macros)}{tag}\n$$"

    def _list(self, node: SyntaxTreeNode, marks: Sequence[str]) -> str:
        """Tight where its author left no empty lines."""
        paragraphs = [part for part in node.walk() if part.type == "paragraph"]
        between = "\n" if all(part.hidden for part in paragraphs) else "\n\n"
        items = [between.join(filter(None, map(self._block, i.children))) for i in node.children]
        return between.join(
            f"{mark} {indent(item, ' ' * (len(mark) + 1)).lstrip()}"
            for mark, item in zip(marks, items, strict=True)
        )

    def _table(self, node: SyntaxTreeNode) -> str:
        head, *body = [row.children for part in node.children for row in part.children]
        rules = [RULES.get(str(cell.attrs.get("style", "")), LEFT) for cell in head]
        rows = [[self._blocks(cell.children) for cell in row] for row in body]
        return table([self._blocks(cell.children) for cell in head], rows, rules)


def escaped(text: str) -> str:
    """Text that Markdown takes as it is."""
    return SPECIAL.sub(lambda found: found[1] or f"\\{found[2]}", text)


def code(text: str) -> str:
    """Within a line."""
    longest = max(map(len, re.findall("`+", text)), default=0)
    marks, space = "`" * (longest + 1), " " if longest else ""
    return f"{marks}{space}{text}{space}{marks}"


def fenced(text: str, language: str = "") -> str:
    marks = "`" * max(3, *(len(run) + 1 for run in re.findall("`+", text)), 3)
    return f"{marks}{language}\n{text.rstrip()}\n{marks}"


def link(words: str, address: str) -> str:
    if not address:
        return words
    return f"[{words}](<{address}>)" if re.search(r"[\s()]", address) else f"[{words}]({address})"


def quoted(markdown: str) -> str:
    """A quotation; its formulae are of one line, as notebooks find them before quotations."""
    one_line = DISPLAYED.sub(lambda found: f"$${' '.join(found[1].split())}$$", markdown)
    return "\n".join(f"> {line}".rstrip() for line in one_line.split("\n"))


def table(
    head: Sequence[str], rows: Iterable[Sequence[str]], rules: Sequence[str] | None = None
) -> str:
    """Cells are Markdown of one line; ``rules`` say where they stand in their columns."""
    lines = [head, rules or [LEFT] * len(head), *(map(_cell, row) for row in rows)]
    lines[0] = list(map(_cell, head))
    return "\n".join(f"| {' | '.join(line)} |" for line in lines)


def _cell(markdown: str) -> str:
    r"""In one line, and without bars: in formulae ``\vert``, else escaped."""
    parts = MATHS.split(" ".join(markdown.split()))
    parts[1::2] = [
        re.sub(r"(?<!\\)\|", r"\\vert ", part.replace(r"\|", r"\Vert ")) for part in parts[1::2]
    ]
    parts[::2] = [part.replace("|", r"\|") for part in parts[::2]]
    return "".join(parts)
