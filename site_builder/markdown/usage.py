"""One use of a directive against what the directive says of itself."""

from dataclasses import replace
from typing import Any

from site_builder.diagnostics import unknown
from site_builder.markdown.directive import Directive, OptionLine, OptionValue, Use
from site_builder.markdown.reading import Reading


def checked(directive: Directive[Any], use: Use, reading: Reading) -> Use | None:
    """The use with legal options only and with their defaults; None where it lacks its argument
    or has one that is not legal. Everything illegal is reported."""
    options = _checked_options(directive, use, reading)
    fault = _fault_of_argument(directive, use)
    if fault:
        reading.problem(use.line, fault)
        return None
    return replace(use, options=options)


def _fault_of_argument(directive: Directive[Any], use: Use) -> str:
    """What is wrong with the argument; nothing where nothing is."""
    argument, given, fence = directive.argument, use.argument, f":::{{{use.name}}}"
    if argument is None:
        legal = f"{fence!r}, no more"
        return f"{{{use.name}}} with an argument, {given!r}; legal: {legal}" if given else ""
    if argument.legal and given not in argument.legal:
        return unknown(argument.kind, given, argument.legal)
    if argument.lacks and not given:
        return f"{{{use.name}}} {argument.lacks}; legal: '{fence} {argument.form}'"
    return ""


def _checked_options(
    directive: Directive[Any], use: Use, reading: Reading
) -> dict[str, OptionValue]:
    declared = {option.name: option for option in directive.options}
    options: dict[str, OptionValue] = {}
    for name, given in use.options.items():
        option = declared.get(name)
        if option is None and not directive.more_options:
            reading.problem(given.line, unknown(f"option of {{{use.name}}}", name, declared))
        elif option and option.legal and given.text not in option.legal:
            reading.problem(given.line, unknown(f"{name} of {use.name}", given.text, option.legal))
        else:
            options[name] = given
    for option in directive.options:
        _complete(option, options, use, reading)
    return options


def _complete(
    option: OptionLine, options: dict[str, OptionValue], use: Use, reading: Reading
) -> None:
    """Report a required option that is missing or empty; set the default of one left out."""
    if option.required and not (option.name in options and options[option.name].text):
        reading.problem(use.line, f"{{{use.name}}} has no ':{option.name}:'; legal: {option.says}")
    if option.legal:
        options.setdefault(option.name, OptionValue(option.legal[0], use.line))
