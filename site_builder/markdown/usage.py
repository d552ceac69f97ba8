"""One use of a directive against what the directive says of itself."""

from dataclasses import replace
from typing import Any

from site_builder.diagnostics import unknown
from site_builder.markdown.directive import Directive, DirectiveCall, OptionLine, OptionValue
from site_builder.markdown.parse_context import ParseContext


def checked(
    directive: Directive[Any], call: DirectiveCall, context: ParseContext
) -> DirectiveCall | None:
    """The use with legal options only and with their defaults; None where it lacks its argument
    or has one that is not legal. Everything illegal is reported."""
    options = _checked_options(directive, call, context)
    fault = _fault_of_argument(directive, call)
    if fault:
        context.problem(call.line, fault)
        return None
    return replace(call, options=options)


def _fault_of_argument(directive: Directive[Any], call: DirectiveCall) -> str:
    """What is wrong with the argument; nothing where nothing is."""
    argument, given, fence = directive.argument, call.argument, f":::{{{call.name}}}"
    if argument is None:
        expected = f"{fence!r}, no more"
        return f"{{{call.name}}} with an argument, {given!r}; legal: {expected}" if given else ""
    if argument.expected and given not in argument.expected:
        return unknown(argument.kind, given, argument.expected)
    if argument.lacks and not given:
        return f"{{{call.name}}} {argument.lacks}; legal: '{fence} {argument.form}'"
    return ""


def _checked_options(
    directive: Directive[Any], call: DirectiveCall, context: ParseContext
) -> dict[str, OptionValue]:
    declared = {option.name: option for option in directive.options}
    options: dict[str, OptionValue] = {}
    for name, given in call.options.items():
        option = declared.get(name)
        if option is None and not directive.more_options:
            context.problem(given.line, unknown(f"option of {{{call.name}}}", name, declared))
        elif option and option.expected and given.text not in option.expected:
            context.problem(
                given.line, unknown(f"{name} of {call.name}", given.text, option.expected)
            )
        else:
            options[name] = given
    for option in directive.options:
        _complete(option, options, call, context)
    return options


def _complete(
    option: OptionLine, options: dict[str, OptionValue], call: DirectiveCall, context: ParseContext
) -> None:
    """Report a required option that is missing or empty; set the default of one left out."""
    if option.required and not (option.name in options and options[option.name].text):
        context.problem(call.line, f"{{{call.name}}} has no ':{option.name}:'; legal: {option.doc}")
    if option.expected:
        options.setdefault(option.name, OptionValue(option.expected[0], call.line))
