"""Headings, and the numbers and ids of a page, assigned before its text is read, which may refer to
them.

Figures, equations, tables, examples, predictions and questions are counted by chapter, in the
order of the page. An id comes from what its author wrote, never from a number, and so stays when
things move.
"""

import hashlib
import re
import unicodedata
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field
from html import unescape
from typing import Any

from markdown_it.rules_core import StateCore
from markdown_it.token import Token

from site_builder.diagnostics.diagnostic import TARGETS
from site_builder.document.places import Heading, Target, passage
from site_builder.markdown.directive import LABEL, Directive, DirectiveCall
from site_builder.markdown.parse_context import FigurePlace, ParseContext
from site_builder.markdown.text.tokens import plain_text

GIVEN = re.compile(r"\s*(?<!\\)\{([#.][^\s{}][^{}]*)\}\s*$")
BEHIND = re.compile(r"(?:\{[\w .-]+\}|\([#.][\w-]+\))$")
"""What others write, or what is misspelt, behind a heading."""
ATTRIBUTES = re.compile(r"(?:#(?P<id>\S+)\s*)?(?P<deeper>\.deeper)?\s*")
LEGAL_ATTRIBUTES = "legal: '{#id}', '{.deeper}' or '{#id .deeper}'"
DEEPER_LEVELS = (2, 3)
"""Of headings whose sections may be folded."""


def heading_ids_rule(state: StateCore) -> None:
    """Take what stands in braces at the end of each heading into the ``meta`` of its opening
    token."""
    for opening, inline in zip(state.tokens, state.tokens[1:], strict=False):
        last = inline.children[-1] if opening.type == "heading_open" and inline.children else None
        if last is None or last.type != "text" or not (found := GIVEN.search(last.content)):
            continue
        opening.meta["given"] = found[1]
        last.content = last.content[: found.start()]
        inline.content = GIVEN.sub("", inline.content)


def list_headings(tokens: Sequence[Token], context: ParseContext) -> None:
    """Give the page its list of headings, which have their ids."""
    for opening, inline, closing in zip(tokens, tokens[1:], tokens[2:], strict=False):
        if opening.type != "heading_open":
            continue
        line, level = (opening.map or [0])[0] + 1, int(opening.tag[1])
        text = plain_text(inline)
        closing.meta["title"] = "".join(map(_said, inline.children or ())).strip()
        if not text:
            context.problem(line, "heading without words; legal: '## Some words'")
        if found := BEHIND.search(text):
            message = f"{found[0]!r} behind a heading, which shows it; {LEGAL_ATTRIBUTES}"
            context.problem(line, message, spoils=TARGETS)
        if opening.markup in ("-", "="):
            expected = f"'## {text}', or an empty line above the rule"
            context.problem(line, f"{text!r} underlined is a heading; legal: {expected}")
        else:
            _check_level(level, text, line, context)
        name = str(opening.attrGet("id"))
        words, folded = passage(_without_links(inline)), bool(opening.meta["folded"])
        context.headings.append(Heading(level, name, words, deeper=folded))


def _said(child: Token) -> str:
    """Its words, of a formula those for screen readers."""
    mathml = str(child.meta.get("mathml", ""))
    words = re.search(r'alttext="([^"]*)"', mathml)
    return unescape(words[1] if words else re.sub("<[^>]*>", "", mathml)) or child.content


def _check_level(level: int, text: str, line: int, context: ParseContext) -> None:
    previous = context.headings[-1].level if context.headings else 1
    if level == 1:
        context.problem(line, f"heading '# {text}'; legal: '##' and deeper, below the title")
    elif level > previous + 1:
        expected = f"{'#' * (previous + 1)!r} or higher"
        context.problem(
            line, f"heading of level {level} below one of level {previous}; legal: {expected}"
        )


def _without_links(inline: Token) -> list[Token]:
    """A heading as it may stand inside a link of the table of contents."""
    children = [
        child
        for child in inline.children or ()
        if child.type not in ("link_open", "link_close", "footnote_ref")
        and not (child.tag == "a" and child.type in ("role_open", "role_close"))
    ]
    return [Token("inline", "", 0, children=children)]


NO_SLUG = "section"


def slug(text: str) -> str:
    """Words of a heading as an id: lower case, letters with their marks and digits, joined by
    hyphens.

    >>> slug("Zoë’s हिन्दी, or 2")
    'zoë-s-हिन्दी-or-2'
    """
    letters = unicodedata.normalize("NFC", text.lower())
    kept = (c if c.isalnum() or unicodedata.category(c)[0] == "M" else "-" for c in letters)
    return re.sub("-+", "-", "".join(kept)).strip("-") or NO_SLUG


LABEL_FORM = re.compile(r"[a-z0-9]+(-[a-z0-9]+)*")
LONGEST = 100
"""Letters of a label, which names files too."""


def number_targets(
    tokens: Sequence[Token], chapter: str, context: ParseContext
) -> tuple[Target, ...]:
    """Every thing of the page that a reference may lead to, in order. Equations and
    headings get their ids and targets here."""
    numbering = _Numbering(chapter, context)
    closed: list[bool] = []
    for index, token in enumerate(tokens):
        match token.type:
            case "directive_open":
                directive: Directive[Any] | None = token.meta["directive"]
                numbering.directive(directive, token)
                closed.append(directive is not None and not directive.body.nests)
            case "directive_close":
                closed.pop()
            case "math_block" | "math_block_label":
                numbering.equation(token, inside=any(closed))
            case "heading_open":
                numbering.heading(tokens[index : index + 3])
    return tuple(numbering.targets)


@dataclass(slots=True)
class _Numbering:
    chapter: str
    context: ParseContext
    targets: list[Target] = field(default_factory=list)
    counts: Counter[str] = field(default_factory=Counter)
    folded: int = 0
    """Level of the heading whose section is a deeper one; 0 outside of such."""

    def directive(self, directive: Directive[Any] | None, token: Token) -> None:
        if directive is None or directive.numbered is None:
            return
        call: DirectiveCall = token.meta["call"]
        numbered, label = directive.numbered, call.text(LABEL.name)
        counted = False
        if label:
            name = self._labelled(label, call.options[LABEL.name].line, call.name)
        elif numbered.again:
            name = self.context.free_id(numbered.id(call), call.line)
            counted = name != numbered.id(call)
        else:
            name = self.context.take_id(numbered.id(call), call.line, call.name)
        self.context.placed[call.line] = self._count(
            numbered.kind,
            name,
            call.line,
            labelled=bool(label),
            counted=counted,
            called=numbered.label,
        )
        if call.name == "simulation":
            first, last = token.map or (0, 0)
            lines = (first + 1, last + 1)
            place = FigurePlace(name, call.argument, lines, call.text("with"))
            self.context.figures.append(place)

    def equation(self, token: Token, *, inside: bool) -> None:
        """``inside`` of a question or caption it carries no number: it belongs to that."""
        line, label = (token.map or [0])[0] + 1, str(token.info or "")
        if inside:
            if label:
                expected = "on a formula of the running text"
                where = "in a question or caption"
                self.context.problem(line, f"label {label!r} {where}; legal: {expected}")
            return
        if label:
            name = self._labelled(label, line, "equation")
        else:
            digest = hashlib.sha256("".join(token.content.split()).encode()).hexdigest()
            name = self.context.free_id(f"equation-{digest[:6]}", line)
        token.meta["target"] = self._count("Equation", name, line, labelled=bool(label))

    def heading(self, tokens: Sequence[Token]) -> None:
        opening, inline, closing = tokens
        line, text = (opening.map or [0])[0] + 1, plain_text(inline)
        self._read_attributes(opening, line)
        name = self._heading_id(opening, text, line)
        opening.attrSet("id", name)
        shown = self.context.shared.words("labels.section", title=text)
        target = Target(
            kind="Section",
            chapter=self.chapter,
            id=name,
            number="",
            title=text,
            line=line,
            name=shown,
            deeper=self.folded > 0,
        )
        closing.meta["target"] = target
        self.targets.append(target)

    def _read_attributes(self, opening: Token, line: int) -> None:
        """The heading's id, whether it begins a deeper section, and whether it stands in one."""
        given, level = opening.meta.get("given", ""), int(opening.tag[1])
        if not opening.level and level <= self.folded:
            self.folded = 0
        found = ATTRIBUTES.fullmatch(given)
        if not found:
            self.context.problem(line, f"{{{given}}} after a heading; {LEGAL_ATTRIBUTES}")
        elif found["deeper"] and (fault := self._fold_error(opening, level)):
            expected = "'##' or '###' at the margin, in no other deeper section"
            self.context.problem(line, f"a deeper section {fault}; legal: {expected}")
        else:
            opening.meta |= {"deeper": bool(found["deeper"]), "id": found["id"] or ""}
            self.folded = level if found["deeper"] else self.folded
        opening.meta["folded"] = self.folded > 0

    def _fold_error(self, opening: Token, level: int) -> str:
        if opening.level:
            return "inside a directive, list or quotation"
        if self.folded:
            return "inside another"
        return "" if level in DEEPER_LEVELS else f"of level {level}"

    def _heading_id(self, opening: Token, text: str, line: int) -> str:
        given = str(opening.meta.get("id", ""))
        if given and slug(given) != given:
            expected = "small letters, digits and hyphens"
            self.context.problem(line, f"heading id {given!r}; legal: {expected}")
        if not given and slug(text) == NO_SLUG:
            return self.context.free_id(NO_SLUG, line)
        return self.context.take_id(given or slug(text), line, "heading")

    def _labelled(self, label: str, line: int, kind: str) -> str:
        if not LABEL_FORM.fullmatch(label) or len(label) > LONGEST:
            expected = f"small letters, digits and hyphens, at most {LONGEST}"
            spoils = (f"unknown target {slug(label)!r}", f"did you mean {label!r}")
            self.context.problem(line, f"label {label!r}; legal: {expected}", spoils=spoils)
        return self.context.take_id(label, line, kind)

    def _count(
        self,
        kind: str,
        name: str,
        line: int,
        *,
        labelled: bool,
        counted: bool = False,
        called: str = "",
    ) -> Target:
        self.counts[kind] += 1
        number = f"{self.context.position.mark}.{self.counts[kind]}"
        label = called or self.context.shared.words.label(kind)
        shown = f"{label} ({number})" if kind == "Equation" else f"{label} {number}"
        target = Target(
            kind=kind,
            chapter=self.chapter,
            id=name,
            number=number,
            title="",
            line=line,
            labelled=labelled,
            name=shown,
            counted=counted,
            deeper=self.folded > 0,
        )
        self.targets.append(target)
        return target
