r"""Fields of a bibliography, such as ``\emph{E.~coli} at $x^2$``, as plain text, by pylatexenc."""

import re
from functools import cache
from typing import Any

RAISED = dict(zip("0123456789+-=()ni", "⁰¹²³⁴⁵⁶⁷⁸⁹⁺⁻⁼⁽⁾ⁿⁱ", strict=True))
LOWERED = dict(zip("0123456789+-=()aeoxhklmnpstij", "₀₁₂₃₄₅₆₇₈₉₊₋₌₍₎ₐₑₒₓₕₖₗₘₙₚₛₜᵢⱼ", strict=True))
SCRIPT = re.compile(r"([_^])\s*(?:\{([^{}]*)\}|(\\[a-zA-Z]+|[^\s\\{}]))")
FORMULA = re.compile(r"(?<!\\)\$(?:\\.|[^$\\])+\$")
BARE = re.compile(r"(?<!\\)[%&]")
"""Signs that stand for themselves: in a reference no comment and no column of a table begins."""
TILDE = re.compile(r"\{?\\textasciitilde(?:\s*\{\})?\}?|\\~(?:\{\})?|\$\\sim\$")
GROUP = r"\s*\{((?:[^{}]|\{[^{}]*\})*)\}"
ADDRESS = re.compile(rf"\\(?:url|nolinkurl|path){GROUP}|\\href{GROUP}{GROUP}")
FONTS = ("texttt", "textsf", "textmd", "textup", "textnormal", "mbox", "enquote", "uppercase")
SWITCHES = (
    "em", "it", "bf", "sc", "tt", "rm", "sf", "sl", "itshape", "bfseries", "scshape", "upshape",
    "normalfont", "relax",
)  # fmt: skip
SIGNS = {"textgreater": ">", "textless": "<", "textbar": "|", "TeX": "TeX", "LaTeX": "LaTeX"}


def text_of_latex(latex: str) -> str:
    """The text that LaTeX sets, without its fonts; exponents and indices as Unicode has them.
    Raises `ValueError` where it cannot be read."""
    from pylatexenc.latexwalker import LatexWalker, LatexWalkerParseError

    source = re.sub(r"\\textsu(p|b)(?:er)?script" + GROUP, r"$\\su\1{\2}$", latex)
    source = source.replace(r"$\sup{", "$^{").replace(r"$\sub{", "$_{")
    source = FORMULA.sub(_with_scripts, ADDRESS.sub(_address_and_words, source))
    parsed, writer = _reader()
    try:
        walker = LatexWalker(
            BARE.sub(r"\\\g<0>", source), latex_context=parsed, tolerant_parsing=False
        )
        text = writer.nodelist_to_text(walker.get_latex_nodes()[0])
    except LatexWalkerParseError:
        raise ValueError(r"a '$' or '{' without its end; legal: '\$' for the sign") from None
    return " ".join(str(text).split())


def web_address(text: str) -> str:
    r"""A web address, given as it stands or with LaTeX's escapes (``\%``, ``{\_}``); the first of
    several."""
    address = re.sub(r"\\([%#&_$])|[{}]", lambda match: match[1] or "", TILDE.sub("~", text))
    parts = address.split()
    several = all(re.match(r"https?://", part) for part in parts)
    return parts[0] if parts and several else address.strip()


def _address_and_words(found: re.Match[str]) -> str:
    address = web_address(found[1] or found[2]).replace("~", r"\textasciitilde{}")
    return f"{found[3]} {address}" if found[3] else address


def _with_scripts(formula: re.Match[str]) -> str:
    def script(found: re.Match[str]) -> str:
        signs, inner = RAISED if found[1] == "^" else LOWERED, (found[2] or found[3] or "").strip()
        return "".join(signs[each] for each in inner) if {*inner} <= {*signs} else found[0]

    return SCRIPT.sub(script, formula[0])


@cache
def _reader() -> tuple[Any, Any]:
    """The commands that are parsed, and the writer of text."""
    from pylatexenc import latex2text, latexwalker
    from pylatexenc.macrospec import std_macro

    def refuse(node: Any) -> str:
        raise ValueError(f"unknown command '\\{node.macroname}'; legal: plain text")

    parsed = latexwalker.get_default_latex_context_db()
    parsed.add_context_category("fonts", [std_macro(name, False, 1) for name in FONTS])
    written, spec = latex2text.get_default_latex_context_db(), latex2text.MacroTextSpec
    kept = [spec(name, discard=False) for name in FONTS]
    signs = {**dict.fromkeys(SWITCHES, ""), **SIGNS}
    replaced = [spec(name, simplify_repl=sign) for name, sign in signs.items()]
    written.add_context_category("fonts", [*kept, *replaced])
    written.set_unknown_macro_spec(spec("", simplify_repl=refuse))
    return parsed, latex2text.LatexNodes2Text(latex_context=written, math_mode="text")
