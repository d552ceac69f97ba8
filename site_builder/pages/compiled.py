"""Templates compiled: kept, since to compile those of one page takes longer than to fill them."""

import marshal
from types import CodeType
from typing import Any

from jinja2 import Environment

from site_builder.kept.keeper import kept_as


class KeptEnvironment(Environment):
    """Compiles each template once on each machine."""

    def compile(  # type: ignore[override]  # of its overloads we use one
        self,
        source: str,
        name: str | None = None,
        filename: str | None = None,
        raw: bool = False,  # noqa: ARG002
        defer_init: bool = False,  # noqa: ARG002
    ) -> CodeType:
        def make() -> bytes:
            compiled: Any = super(KeptEnvironment, self).compile(source, name, filename)
            return marshal.dumps(compiled)

        code: CodeType = marshal.loads(kept_as("template", (source, name, filename), make)[0])
        return code
