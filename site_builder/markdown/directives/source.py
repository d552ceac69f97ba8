"""``{source} package.module:function``: the real code, read from its file, never a copy."""

import ast
from pathlib import Path
from textwrap import dedent

from site_builder.book_root import is_engine, own_or_engine
from site_builder.diagnostics import unknown
from site_builder.markdown.bodies import CAPTION
from site_builder.markdown.directive import Argument, Directive, DirectiveCall
from site_builder.markdown.parse_context import ParseContext
from site_builder.page_model.blocks import Source
from site_builder.page_model.passage import Passage

FORM = "package.module:function"
type Definition = ast.FunctionDef | ast.ClassDef


def read_source(call: DirectiveCall, caption: Passage, context: ParseContext) -> Source | None:
    module, _, name = call.argument.partition(":")
    path = f"{module.replace('.', '/')}.py"
    source = _text_of(module, name, path, call, context)
    if source is None:
        return None
    try:
        definitions = _definitions(source)
    except (SyntaxError, ValueError) as error:
        line = getattr(error, "lineno", None) or 1
        context.problem(call.line, f"module {module!r} is no Python: {path}:{line}")
        return None
    if name not in definitions:
        public = [known for known in definitions if not known.startswith("_")]
        context.problem(call.line, unknown(f"definition in {module}", name, public))
        return None
    first, last = _span(definitions[name])
    code = dedent("\n".join(source.splitlines()[first - 1 : last])) + "\n"
    return Source(module, name, path, first, code, caption)


def _text_of(
    module: str, name: str, path: str, call: DirectiveCall, context: ParseContext
) -> str | None:
    """The module's file, or None and a diagnostic."""
    if not (module and name):
        expected = f"':::{{source}} {FORM}'"
        context.problem(call.line, f"{{source}} {call.argument!r}; legal: {expected}")
        return None
    file = (
        own_or_engine(context.shared.root, path)
        if is_engine(module)
        else context.shared.root / path
    )
    if not file.is_file() or not module.startswith("simulations."):
        modules = _modules(context.shared.root / "simulations")
        context.problem(call.line, unknown("module", module, modules))
        return None
    return file.read_text(encoding="utf-8", errors="replace")


def _definitions(source: str) -> dict[str, Definition]:
    """Functions and classes of a module, and methods as ``Class.method``."""
    found: dict[str, Definition] = {}
    for node in ast.parse(source).body:
        if isinstance(node, ast.FunctionDef | ast.ClassDef):
            found[node.name] = node
        if isinstance(node, ast.ClassDef):
            methods = (item for item in node.body if isinstance(item, ast.FunctionDef))
            found |= {f"{node.name}.{method.name}": method for method in methods}
    return found


def _span(definition: Definition) -> tuple[int, int]:
    """First and last line, decorators included."""
    first = min([definition.lineno, *(item.lineno for item in definition.decorator_list)])
    return first, definition.end_lineno or first


def _modules(package: Path) -> list[str]:
    files = sorted(package.rglob("*.py")) if package.is_dir() else []
    return [
        ".".join(file.relative_to(package.parent).with_suffix("").parts)
        for file in files
        if file.stem != "__init__"
    ]


SOURCE = Directive(
    name="source",
    doc="the real code of a function",
    argument=Argument(FORM, lacks="names no function"),
    body=CAPTION,
    read=read_source,
    template="source",
)
