r"""The symbols of a formula: letters, with the accents above and the index below them.

``f_x``, ``\mathbf{t}``, ``\hat{\mathbf{n}}``, ``r_{\text{fold}}``. Words, names of functions,
differentials and primes are no part of a symbol.
"""

import re
from functools import cache

GREEK = (
    "alpha", "beta", "gamma", "delta", "epsilon", "varepsilon", "zeta", "eta", "theta", "kappa",
    "lambda", "mu", "nu", "xi", "pi", "rho", "sigma", "tau", "phi", "varphi", "chi", "psi", "omega",
    "Gamma", "Delta", "Theta", "Lambda", "Sigma", "Phi", "Psi", "Omega", "ell",
)  # fmt: skip
OVER = ("mathbf", "boldsymbol", "mathcal", "hat", "bar", "tilde", "dot", "vec")
"""Commands that make a symbol out of a symbol."""
GROUP = r"\{(?:[^{}]|\{(?:[^{}]|\{[^{}]*\})*\})*\}"
LETTER = rf"(?:[A-Za-z]|\\(?:{'|'.join(GREEK)})(?![A-Za-z]))"
WORDS = re.compile(
    r"\\(?:text|mathrm|operatorname\*?|begin|end|role|mathit|texttt)\s*\{[^{}]*\}'?"
    r"(?:_(?:\{[^{}]*\}|\w))?|\\math(?:rm|sf)\s*(?:[A-Za-z]|\{T\})"
)
"""Among them an upright d, and the mark of a transpose."""
NO_SYMBOLS = re.compile(
    r"\\\\\s*\[[^]]*\]|\\begin\{array\}\s*\{[^{}]*\}|\\(?:[hv]space|color|ce|pu)\s*\{[^{}]*\}"
    r"|\\textcolor\s*\{[^{}]*\}|\\[hmk]?kern?\s*[\d.]+\s*(?:em|ex|mu|pt)"
)
"""Lengths, columns, colours and formulae of chemistry."""
WORD_IN_INDEX = re.compile(r"_(?:\{([^{}]*?))?\\(?:text|mathrm)\{([^{}]*)\}(?(1)\})")
DIFFERENTIAL = re.compile(rf"(?:(?<=\\[,;!])|(?<=frac\{{)|(?<=\}}\{{))\s*d(?=\s*{LETTER})")
SYMBOL = re.compile(
    rf"(?P<over>\\(?:{'|'.join(OVER)})(?![A-Za-z])\s*(?:{GROUP}|{LETTER})|\\Delta\s*{LETTER}|{LETTER})"
    rf"(?:'|\^\\prime)*(?:_(?P<index>{GROUP}|\\text\s*{GROUP}|\\?[A-Za-z]+|\d))?"
    r"|\\[A-Za-z]+"
)


@cache
def symbols_of(tex: str) -> tuple[str, ...]:
    """Each symbol as often as it stands there, in the spelling of `spelt`."""
    text = NO_SYMBOLS.sub(" ", tex)
    text = WORD_IN_INDEX.sub(lambda found: f"_{{{found[1] or ''}«{found[2].strip()}»}}", text)
    text = DIFFERENTIAL.sub("", WORDS.sub(" ", text))
    found = (match for match in SYMBOL.finditer(text) if match["over"])
    return tuple(_joined(_bare(match["over"]), match["index"]) for match in found)


def spelt(symbol: str) -> str:
    r"""A symbol as an author writes it in the spelling of `symbols_of`: ``\bar x`` is ``\bar{x}``.
    Nothing where it is not one symbol."""
    found = symbols_of(symbol)
    return found[0] if len(found) == 1 else ""


def _bare(base: str) -> str:
    command = re.match(rf"\\({'|'.join(OVER)})(?![A-Za-z])\s*(.*)", base, re.DOTALL)
    if not command:
        return base
    return f"\\{command[1]}{{{_bare(command[2].strip('{} '))}}}"


def _joined(base: str, index: str | None) -> str:
    if index is None:
        return base
    inner = index[1:-1] if index.startswith("{") else index
    inner = re.sub(r"\s+", "", inner)
    return f"{base}_{{{inner}}}"


@cache
def covers(declared: str, symbol: str) -> bool:
    r"""Whether a declared symbol also explains another: ``h_{11}`` explains ``h_{32}``, ``t_x``
    explains ``t_y``, ``x`` and ``\mathbf{x}`` explain ``x_0``."""
    base, _, index = symbol.partition("_")
    given, _, other = declared.partition("_")
    if not index or not other:
        bases = (base, f"\\mathbf{{{base}}}", f"\\hat{{\\mathbf{{{base}}}}}")
        return declared == symbol or (bool(index) and declared in bases)
    alike = bool(_kind(index)) and _kind(index) == _kind(other)
    return base == given and (index == other or alike)


def _kind(index: str) -> str:
    """The part of an index that counts; nothing of one that names."""
    inner = index.strip("{}")
    if re.fullmatch(r"\d+", inner):
        return "digits"
    return "axes" if inner in ("x", "y", "z") else ""
