"""The check of one directive in a text against its declaration."""

import re
from dataclasses import replace
from typing import Any

from site_builder.diagnostics.diagnostic import unknown
from site_builder.markdown.content_files import fault_of_file
from site_builder.markdown.directive import Directive, DirectiveCall, OptionLine, OptionValue
from site_builder.markdown.parse_context import ParseContext


def checked(
    directive: Directive[Any], call: DirectiveCall, context: ParseContext
) -> DirectiveCall | None:
    """The call with legal options only and with their defaults; None where its argument is missing
    or illegal. Everything illegal is reported."""
    options = _checked_options(directive, call, context)
    if fault := _fault_of_argument(directive, call, context):
        context.problem(call.line, fault)
        return None
    return replace(call, options=options)


def _fault_of_argument(
    directive: Directive[Any], call: DirectiveCall, context: ParseContext
) -> str:
    """What is wrong with the argument; nothing where nothing is."""
    argument, given, fence = directive.argument, call.argument, f":::{{{call.name}}}"
    if argument is None:
        fault = f"{{{call.name}}} with an argument, {given!r}; legal: {fence!r}, no more"
        return fault if given else ""
    if argument.expected is not None and given not in argument.expected:
        return unknown(argument.kind, given, argument.expected)
    if argument.lacks and not given:
        return f"{{{call.name}}} {argument.lacks}; legal: '{fence} {argument.form}'"
    return fault_of_file(given, context.content, argument.file) if argument.file else ""


def _checked_options(
    directive: Directive[Any], call: DirectiveCall, context: ParseContext
) -> dict[str, OptionValue]:
    declared = {option.name: option for option in directive.options}
    options: dict[str, OptionValue] = {}
    for name, given in call.options.items():
        fault = ""
        if name in declared:
            fault = _fault_of_option(declared[name], given.text, call, context)
        elif not directive.more_options:
            fault = unknown(f"option of {{{call.name}}}", name, declared)
        if fault:
            context.problem(given.line, fault)
        else:
            options[name] = given
    for option in directive.options:
        if option.required and not (option.name in call.options and call.text(option.name)):
            message = f"{{{call.name}}} has no ':{option.name}:'; legal: {option.doc}"
            context.problem(call.line, message)
        if option.expected:
            options.setdefault(option.name, OptionValue(option.expected[0], call.line))
    return options


def _fault_of_option(
    option: OptionLine, given: str, call: DirectiveCall, context: ParseContext
) -> str:
    if option.expected and given not in option.expected:
        return unknown(f"{option.name} of {call.name}", given, option.expected)
    if option.form and given and not re.fullmatch(option.form, given):
        return f"{option.name} {given!r}; legal: {option.doc}"
    return fault_of_file(given, context.content, option.file) if option.file and given else ""
