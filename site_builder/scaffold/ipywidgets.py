"""Calls of ipywidgets' ``interact`` in a notebook, and their controls as those of a scene."""

import ast
import json
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from site_builder.markdown.numbering import slug

CALLS = ("interact", "interactive", "interact_manual", "interactive_output")

type Given = tuple[ast.expr, ast.expr | None]
"""What stands for an argument in the call, and its default in the function."""


def interacting(
    tree: ast.Module, functions: Mapping[str, ast.FunctionDef]
) -> Iterator[tuple[str, dict[str, Given]]]:
    """Names of functions that ipywidgets calls, with what is given for each of their arguments."""
    decorators = [
        (call, node.name)
        for node in ast.walk(tree)
        if isinstance(node, ast.FunctionDef)
        for call in node.decorator_list
    ]
    above = {id(call) for call, _ in decorators}
    plain = [(node, "") for node in ast.walk(tree) if isinstance(node, ast.Call)]
    for call, own in (*decorators, *(each for each in plain if id(each[0]) not in above)):
        function = call.func if isinstance(call, ast.Call) else call
        name = getattr(function, "attr", getattr(function, "id", ""))
        if name not in CALLS:
            continue
        first, words = (call.args[:1], call.keywords) if isinstance(call, ast.Call) else ([], [])
        target = own or getattr(first[0] if first else None, "id", "")
        defaults = _defaults(functions.get(target))
        given = {word.arg: word.value for word in words if word.arg}
        controls = defaults if name == "interactive_output" else {**defaults, **given}
        yield (
            target or "figure",
            {each: (value, defaults.get(each)) for each, value in controls.items()},
        )


def _defaults(function: ast.FunctionDef | None) -> dict[str, ast.expr]:
    if function is None:
        return {}
    values, names = function.args.defaults, [arg.arg for arg in function.args.args]
    return dict(zip(names[len(names) - len(values) :], values, strict=True))


def control(name: str, value: ast.expr, default: ast.expr | None = None) -> str:
    """An argument of our figure for what ipywidgets makes a control of; empty where none is like
    it."""
    label = json.dumps(name.replace("_", " ").strip().capitalize(), ensure_ascii=False)
    if isinstance(value, ast.Call):
        kind = getattr(value.func, "attr", getattr(value.func, "id", ""))
        words = {word.arg: word.value for word in value.keywords if word.arg}
        if kind in ("Dropdown", "RadioButtons", "ToggleButtons", "SelectionSlider", "Select"):
            return control(name, words["options"]) if "options" in words else ""
        if kind in ("Checkbox", "ToggleButton"):
            return control(name, words.get("value", ast.Constant(value=False)))
        if (
            "Slider" not in kind
            and "BoundedText" not in kind
            and kind not in ("IntText", "FloatText")
        ):
            return ""
        low, high, step, start = (_literal(words.get(k)) for k in ("min", "max", "step", "value"))
        whole = kind.startswith(("Int", "BoundedInt"))
        low, high = (
            (0 if low is None else low),
            ((100 if whole else 10.0) if high is None else high),
        )
        return _slider(name, label, (low, high, step), start, whole=whole)
    given = _literal(value)
    if isinstance(given, bool):
        return f"{name.strip('_')}: bool = toggle({label}, {given})"
    if isinstance(given, dict | list) and given:
        options = [str(each) for each in given]
        named = {slug(each): each for each in options}
        return f"{name.strip('_')}: str = choice({label}, {named!r})"
    if isinstance(given, int | float):
        low, high = sorted((-given, 3 * given)) if given else (0, 1)
        return _slider(name, label, (low, high, None), given, whole=isinstance(given, int))
    if isinstance(given, tuple) and len(given) in (2, 3):
        whole = all(isinstance(each, int) for each in given)
        start = _literal(default)
        start = start if isinstance(start, int | float) else None
        return _slider(name, label, (*given, None)[:3], start, whole=whole)
    return ""


def _slider(name: str, label: str, ends: Sequence[Any], start: Any, *, whole: bool) -> str:
    low, high, step = ends
    if not all(isinstance(each, int | float) for each in (low, high)) or not low < high:
        return ""
    step = step or (1 if whole else 0.1)
    start = (low + high) / 2 if start is None else min(max(start, low), high)
    start = low + step * int((start - low) / step + 1e-9)
    kind = "int" if whole else "float"
    values = ", ".join(
        repr(each if whole else round(float(each), 9)) for each in (start, low, high, step)
    )
    return f"{name.strip('_')}: {kind} = slider({label}, {values})"


def _literal(value: ast.expr | None) -> Any:
    """The value; None where it is computed. Arithmetic on numbers is done."""
    if value is None:
        return None
    try:
        return ast.literal_eval(value)
    except (ValueError, TypeError):
        pass
    if isinstance(value, ast.BinOp):
        left, right = _literal(value.left), _literal(value.right)
        both = isinstance(left, int | float) and isinstance(right, int | float)
        if both and isinstance(value.op, ast.Div) and right:
            return left / right
        return left * right if both and isinstance(value.op, ast.Mult) else None
    if isinstance(value, ast.Tuple):
        return tuple(map(_literal, value.elts))
    is_pi = isinstance(value, ast.Attribute) and value.attr == "pi"
    return 3.141592654 if is_pi else None
