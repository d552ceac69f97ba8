"""``{source} package.module:function``: the real code, read from its file, never a copy; without a
function, all of it."""

import ast
from pathlib import Path
from textwrap import dedent

from site_builder.diagnostics.blame import CodeError
from site_builder.diagnostics.diagnostic import unknown
from site_builder.document.blocks import Source
from site_builder.document.places import Passage
from site_builder.files.engine import book_or_engine_file
from site_builder.files.folders import folder_files
from site_builder.markdown.block_tree import CAPTION
from site_builder.markdown.directive import Argument, Directive, DirectiveCall
from site_builder.markdown.parse_context import ParseContext

type Definition = ast.FunctionDef | ast.ClassDef


def read_source(call: DirectiveCall, caption: Passage, context: ParseContext) -> Source:
    module, _, name = call.argument.partition(":")
    path, root = f"{module.replace('.', '/')}.py", context.shared.root
    file = book_or_engine_file(root, path)
    if not file.is_file() or not module.startswith("simulations."):
        raise CodeError(unknown("module", module, _modules(root / "simulations")))
    source = file.read_text(encoding="utf-8-sig", errors="replace")
    try:
        definitions = _definitions(source)
    except (SyntaxError, ValueError) as error:
        line = getattr(error, "lineno", None) or 1
        raise CodeError(f"module {module!r} is no Python: {path}:{line}") from None
    if not name:
        return Source(
            module=module,
            name=name,
            path=path,
            first_line=1,
            code=source,
            docstring=(0, 0),
            caption=caption,
        )
    if name not in definitions:
        public = [known for known in definitions if not known.startswith("_")]
        raise CodeError(unknown(f"definition in {module}", name, public))
    first, last = _span(definitions[name])
    code = dedent("\n".join(source.split("\n")[first - 1 : last])) + "\n"
    start, end = _docstring(definitions[name])
    return Source(
        module=module,
        name=name,
        path=path,
        first_line=first,
        code=code,
        docstring=(start - first, end - first),
        caption=caption,
    )


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


def _docstring(definition: Definition) -> tuple[int, int]:
    """Its first line, and the one after its last; equal where there is none."""
    opening = definition.body[0]
    if ast.get_docstring(definition, clean=False) is None:
        return opening.lineno, opening.lineno
    return opening.lineno, (opening.end_lineno or opening.lineno) + 1


def _modules(package: Path) -> list[str]:
    files = [file for name, file in folder_files(package).items() if name.endswith(".py")]
    return [
        ".".join(file.relative_to(package.parent).with_suffix("").parts)
        for file in files
        if file.stem != "__init__"
    ]


SOURCE = Directive(
    name="source",
    doc="the real code of a function, or of a whole module",
    argument=Argument("package.module:function", lacks="names no function"),
    body=CAPTION,
    read=read_source,
    template="source",
)
