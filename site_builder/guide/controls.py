"""The table of the kinds of controls, made of the functions by which scenes state them."""

from collections.abc import Callable
from importlib import import_module
from inspect import Parameter, getdoc, signature

from simulations.engine.controls import KINDS

MARK = "[controls]\n"
"""Where the table stands in a page of the guide."""


def controls_table() -> str:
    """A row for each: how it is written, and its documentation."""
    rows = []
    for kind in KINDS:
        stated = getattr(import_module(f"simulations.engine.controls.{kind}.kind"), kind)
        doc = (getdoc(stated) or "").replace("\n", " ").replace("``", "`")
        rows.append(f"| `{kind}({_parameters(stated)})` | {doc} |\n")
    return f"| Control | Is |\n|---|---|\n{''.join(rows)}"


def _parameters(stated: Callable[..., object]) -> str:
    parameters = signature(stated).parameters.values()
    return ", ".join(str(each.replace(annotation=Parameter.empty)) for each in parameters)
