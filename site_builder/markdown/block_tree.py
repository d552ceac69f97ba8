"""Make a tree of blocks from a flat list of tokens: prose, and directives checked against their
declarations. Also the bodies that several directives share."""

import re
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from markdown_it.token import Token

from site_builder.diagnostics.blame import CodeError, raised_by_code
from site_builder.diagnostics.diagnostic import UNREAD, unknown
from site_builder.document.blocks import Block, Deeper, Prose
from site_builder.document.places import Passage, passage
from site_builder.markdown.content_files import file_error
from site_builder.markdown.directive import Body, Directive, DirectiveCall, OptionLine, OptionValue
from site_builder.markdown.parse_context import ParseContext
from site_builder.markdown.text.tokens import end_of_element


def checked(
    directive: Directive[Any], call: DirectiveCall, context: ParseContext
) -> DirectiveCall | None:
    """The call with legal options only and with their defaults; None where its argument is missing
    or illegal. Everything illegal is reported."""
    options = _checked_options(directive, call, context)
    if fault := _argument_error(directive, call, context):
        context.problem(call.line, fault, spoils=UNREAD)
        return None
    return replace(call, options=options)


def _argument_error(directive: Directive[Any], call: DirectiveCall, context: ParseContext) -> str:
    """What is wrong with the argument; nothing where nothing is."""
    argument, given, fence = directive.argument, call.argument, f":::{{{call.name}}}"
    if argument is None:
        fault = f"{{{call.name}}} with an argument, {given!r}; legal: {fence!r}, no more"
        return fault if given else ""
    if argument.expected is not None and given not in argument.expected:
        return unknown(argument.kind, given, argument.expected)
    if argument.lacks and not given:
        return f"{{{call.name}}} {argument.lacks}; legal: '{fence} {argument.form}'"
    return file_error(given, context.content, argument.file) if argument.file else ""


def _checked_options(
    directive: Directive[Any], call: DirectiveCall, context: ParseContext
) -> dict[str, OptionValue]:
    declared = {option.name: option for option in directive.options}
    options: dict[str, OptionValue] = {}
    for name, given in call.options.items():
        fault = ""
        if name in declared:
            fault = _option_error(declared[name], given.text, call, context)
        elif not directive.more_options:
            fault = unknown(f"option of {{{call.name}}}", name, declared)
        if fault:
            spoils = (f"unknown target {given.text!r}", f"{call.name} {call.argument!r}")
            context.problem(given.line, fault, spoils=spoils)
        else:
            options[name] = given
    for option in directive.options:
        if option.required and not (option.name in call.options and call.text(option.name)):
            message = f"{{{call.name}}} has no ':{option.name}:'; legal: {option.doc}"
            context.problem(call.line, message)
        if option.expected:
            options.setdefault(option.name, OptionValue(option.expected[0], call.line))
    return options


def _option_error(
    option: OptionLine, given: str, call: DirectiveCall, context: ParseContext
) -> str:
    if option.expected and given not in option.expected:
        return unknown(f"{option.name} of {call.name}", given, option.expected)
    if option.form and given and not re.fullmatch(option.form, given):
        return f"{option.name} {given!r}; legal: {option.doc}"
    return file_error(given, context.content, option.file) if option.file and given else ""


def read_page(tokens: Sequence[Token], context: ParseContext) -> tuple[Block, ...]:
    """All tokens of a page as blocks, in order; each deeper section is one."""
    headings = {heading.id: heading for heading in context.headings}
    blocks: list[Block] = []
    read_to = 0
    for start, token in enumerate(tokens):
        if token.type == "heading_open" and token.meta.get("deeper"):
            blocks += read_blocks(tokens[read_to:start], context)
            read_to = _end_of_section(tokens, start)
            inside = read_blocks(tokens[start + 3 : read_to], context)
            content = Deeper(headings[str(token.attrGet("id"))])
            blocks.append(Block("deeper", content, inside))
    return (*blocks, *read_blocks(tokens[read_to:], context))


def _end_of_section(tokens: Sequence[Token], start: int) -> int:
    """The index of the next heading of the level of the one at ``start``, or of a higher one, or
    of the page's footnotes."""
    for index, token in enumerate(tokens[start + 1 :], start + 1):
        is_heading = token.type == "heading_open" and not token.level
        if token.type == "footnote_block_open" or (is_heading and token.tag <= tokens[start].tag):
            return index
    return len(tokens)


def read_blocks(tokens: Sequence[Token], context: ParseContext) -> tuple[Block, ...]:
    """Tokens at one level of nesting as blocks, in order."""
    if not any(token.type == "directive_open" for token in tokens):
        words = passage(tokens)
        return (Block("prose", Prose(words)),) if words else ()
    blocks: list[Block] = []
    prose: list[Token] = []

    def end_prose() -> None:
        if words := passage(prose):
            blocks.append(Block("prose", Prose(words)))
        prose.clear()

    position = 0
    while position < len(tokens):
        end = end_of_element(tokens, position)
        element = tokens[position:end]
        if element[0].type == "directive_open":
            end_prose()
            if block := _read_directive(element, context):
                blocks.append(block)
        else:
            prose.extend(_without_directives(element, context))
        position = end
    end_prose()
    return tuple(blocks)


def _read_directive(element: Sequence[Token], context: ParseContext) -> Block | None:
    directive: Directive[Any] | None = element[0].meta["directive"]
    call: DirectiveCall = element[0].meta["call"]
    if directive is None:  # of an unknown name, which is reported
        return None
    expected = checked(directive, call, context)
    body = directive.body.read(call, element[1:-1], context)
    try:
        content = directive.read(expected, body, context) if expected else None
    except CodeError as error:
        context.problem(call.line, str(error), raised_by_code(error), UNREAD)
        return None
    if content is None:
        return None
    inside = body if directive.body.nests else ()
    return Block(directive.template, content, inside, context.placed.get(call.line))


def _without_directives(element: Sequence[Token], context: ParseContext) -> list[Token]:
    """Prose; a directive inside a list or quotation, which has no place there, is reported."""
    for token in element:
        if token.type == "directive_open":
            call: DirectiveCall = token.meta["call"]
            context.problem(
                call.line,
                f"directive {{{call.name}}} inside a list or quotation; "
                "legal: at the margin, or inside a callout or example",
            )
            return []
    return list(element)


def plain_tokens(
    call: DirectiveCall, tokens: Sequence[Token], context: ParseContext
) -> Sequence[Token]:
    """The tokens as they are; a directive among them, which would not be shown, is reported."""
    inner = next((token for token in tokens if token.type == "directive_open"), None)
    if inner is not None:
        found: DirectiveCall = inner.meta["call"]
        where = f"directive {{{found.name}}} inside {{{call.name}}}"
        context.problem(found.line, f"{where}; legal: plain Markdown")
    return tokens


def _passage(call: DirectiveCall, tokens: Sequence[Token], context: ParseContext) -> Passage:
    return passage(plain_tokens(call, tokens, context))


def _inner_blocks(
    call: DirectiveCall, tokens: Sequence[Token], context: ParseContext
) -> tuple[Block, ...]:
    if not tokens:
        context.problem(call.line, f"{{{call.name}}} is empty; legal: some text")
    return read_blocks(tokens, context)


def _nothing(call: DirectiveCall, tokens: Sequence[Token], context: ParseContext) -> None:
    if tokens:
        context.problem(call.line, f"{{{call.name}}} with a body; legal: nothing below its options")


CAPTION = Body("a caption", _passage)
"""Plain Markdown, or nothing; the reader gets a `Passage`."""
BLOCKS = Body("text and other directives", _inner_blocks, nests=True)
"""Anything, but something; the template gets it as ``inside``."""
NO_BODY = Body("nothing", _nothing)
