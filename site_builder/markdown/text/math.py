"""TeX to MathML, at build time. What Temml cannot set is an error, never garbled output."""

import re
from collections.abc import Mapping, Sequence

from simulations.engine import frame
from site_builder.cache.results import cached
from site_builder.diagnostics.diagnostic import unknown
from site_builder.files.folders import file_hash
from site_builder.formulae.temml import SOURCES, TexError, common_tex, set_tex

COLOURS = (*frame.ROLES[1:], "muted")
"""Roles of colours that a formula may name; frames also have the empty role."""
INSTEAD = {"tag": "a label behind the formula", "qty": r"'\pu{1.5 m}'"}
"""Commands of Temml with no meaning, or another than is likely meant; what is legal instead."""
EMPTY = r"a formula that shows nothing; legal: '$…$' around one, or '\$' for the sign itself"
UNKNOWN = re.compile(r"(?:Unsupported function name|Undefined control sequence): (\\\w+|\S+)")


type Macros = Mapping[str, str]
"""TeX commands of the book's own, without their backslashes, and what each stands for."""
NO_MACROS: Macros = {}
SPOKEN = "en"
"""The language in which formulae have words."""


class UnsupportedTexError(ValueError):
    """The formula cannot be set; the message names the part."""


def to_mathml(
    tex: str,
    *,
    display: bool,
    macros: Macros = NO_MACROS,
    language: str = SPOKEN,
    colours: Sequence[str] = (),
) -> str:
    """A ``<math>`` element, in English with words as ``alttext``. Besides `COLOURS` it may name
    the book's own. Raises `UnsupportedTexError`."""
    sources = tuple(file_hash(file) for file in SOURCES)
    named = _as_classes(tex, (*COLOURS, *colours))
    bodies = {name: _as_classes(body, (*COLOURS, *colours)) for name, body in macros.items()}
    return _to_mathml(named, display, language == SPOKEN, bodies, sources)


@cached
def _to_mathml(tex: str, display: bool, spoken: bool, macros: Macros, _sources: object) -> str:
    if not tex.strip():
        raise UnsupportedTexError(EMPTY)
    for name, legal in INSTEAD.items():
        if re.search(rf"\\{name}(?![A-Za-z])", tex):
            raise UnsupportedTexError(rf"\{name} in {quoted(tex)}; legal: {legal}")
    bodies = {f"\\{name}": common_tex(body) for name, body in macros.items()}
    try:
        mathml = set_tex(common_tex(tex), display=display, spoken=spoken, macros=bodies)
    except TexError as error:
        raise UnsupportedTexError(_in_words(str(error), tex)) from error
    if not re.search(r">[^<\s]", mathml):
        raise UnsupportedTexError(EMPTY)
    return mathml


def quoted(tex: str) -> str:
    r"""TeX as its author wrote it, on one line: ``'\frac{a}{b}'``, its backslashes single."""
    return f"'{' '.join(tex.split())}'"


def _as_classes(tex: str, colours: Sequence[str]) -> str:
    """With its colours as classes."""

    def named(match: re.Match[str]) -> str:
        if match[1] not in colours:
            raise UnsupportedTexError(unknown("colour role", match[1], colours))
        return rf"\class{{role-{match[1]}}}"

    return re.sub(r"\\role\{([\w-]*)\}", named, tex)


def _in_words(message: str, tex: str) -> str:
    """Temml's message, with the formula."""
    if found := UNKNOWN.match(message):
        return f"unsupported TeX command '{found[1]}' in {quoted(tex)}"
    return f"cannot set {quoted(tex)}: {message[:1].lower()}{message[1:]}"
