"""``{source} package.module:function``: the real code, read from its file, never a copy."""

import ast
from collections.abc import Sequence
from pathlib import Path
from textwrap import dedent

from markdown_it.token import Token

from site_builder.book import Listing
from site_builder.diagnostics import unknown
from site_builder.markdown.blocks import check_options, read_html
from site_builder.markdown.fences import Directive
from site_builder.markdown.reading import Reading
from site_builder.markdown.text.code import code_html

type Definition = ast.FunctionDef | ast.ClassDef


def read_listing(directive: Directive, body: Sequence[Token], reading: Reading) -> Listing | None:
    check_options(directive, (), reading)
    caption_html = read_html(directive, body, reading)
    module, colon, name = directive.argument.partition(":")
    if not (module and colon and name):
        reading.problem(
            directive.line,
            f"{{source}} {directive.argument!r}; legal: ':::{{source}} package.module:function'",
        )
        return None
    path = f"{module.replace('.', '/')}.py"
    file = reading.root / path
    if not file.is_file() or not module.startswith("simulations."):
        reading.problem(
            directive.line, unknown("module", module, _modules(reading.root / "simulations"))
        )
        return None
    source = file.read_text(encoding="utf-8")
    definitions = _definitions(source)
    if name not in definitions:
        public = [known for known in definitions if not known.startswith("_")]
        reading.problem(directive.line, unknown(f"definition in {module}", name, public))
        return None
    first, last = _span(definitions[name])
    code = dedent("\n".join(source.splitlines()[first - 1 : last])) + "\n"
    return Listing(module, name, path, first, code_html(code, "python"), caption_html)


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
