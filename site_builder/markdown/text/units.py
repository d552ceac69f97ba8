r"""Numbers and units as siunitx writes them: ``\qty{3.5e-3}{\milli\metre\per\second}``.

Of siunitx: ``\num``, ``\unit`` (``\si``) and ``\qty`` (``\SI``), units by their names or as
``m.s^-1``, ``\per`` as a negative power, digits in threes from five on.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass

from site_builder.diagnostics import unknown
from site_builder.markdown.text.math import UnsupportedTexError, quoted
from site_builder.markdown.text.tex_arguments import arguments, replaced

PREFIXES = {
    "quecto": "q", "ronto": "r", "yocto": "y", "zepto": "z", "atto": "a", "femto": "f",
    "pico": "p", "nano": "n", "micro": "µ", "milli": "m", "centi": "c", "deci": "d", "deca": "da",
    "hecto": "h", "kilo": "k", "mega": "M", "giga": "G", "tera": "T", "peta": "P", "exa": "E",
    "zetta": "Z", "yotta": "Y", "ronna": "R", "quetta": "Q", "kibi": "Ki", "mebi": "Mi",
    "gibi": "Gi",
}  # fmt: skip
UNITS = {
    "metre": "m", "meter": "m", "gram": "g", "kilogram": "kg", "second": "s", "ampere": "A",
    "kelvin": "K", "mole": "mol", "candela": "cd", "hertz": "Hz", "newton": "N", "pascal": "Pa",
    "joule": "J", "watt": "W", "coulomb": "C", "volt": "V", "farad": "F", "ohm": "Ω",
    "siemens": "S", "weber": "Wb", "tesla": "T", "henry": "H", "lumen": "lm", "lux": "lx",
    "becquerel": "Bq", "gray": "Gy", "sievert": "Sv", "katal": "kat", "radian": "rad",
    "steradian": "sr", "degreeCelsius": "°C", "celsius": "°C", "degree": "°", "arcminute": "′",
    "arcsecond": "″", "minute": "min", "hour": "h", "day": "d", "litre": "L", "liter": "L",
    "tonne": "t", "hectare": "ha", "electronvolt": "eV", "dalton": "Da", "astronomicalunit": "au",
    "bel": "B", "decibel": "dB", "neper": "Np", "percent": "%", "bit": "bit", "byte": "B",
    "angstrom": "Å", "bar": "bar", "mm": "mm", "cm": "cm", "km": "km", "um": "µm", "nm": "nm",
    "kg": "kg", "ms": "ms", "Hz": "Hz", "kHz": "kHz", "MHz": "MHz", "GHz": "GHz",
}  # fmt: skip
POWERS = {"square": 2, "cubic": 3, "squared": 2, "cubed": 3}
CLOSE = {"°", "′", "″"}
"""Units that follow their number without a space."""
NUMBER = re.compile(
    r"\s*(?P<sign>[+-]?|\\pm)\s*(?P<whole>\d*)(?:[.,](?P<part>\d+))?"
    r"(?:\((?P<spread>\d+)\)|\s*(?:\+-|\\pm)\s*(?P<plus>\d+(?:[.,]\d+)?))?"
    r"(?:\s*[eE]\s*(?P<power>[+-]?\d+))?\s*"
)
WRITTEN = re.compile(
    r"(?P<over>/)?(?P<unit>[A-Za-zµΩÅ°%′″]+)(?:\^\{?(?P<power>-?\d+)\}?)?(?P<dot>[.·*~ ]|(?=/)|$)"
)
NUM, UNIT, QTY = (
    re.compile(rf"\\(?:{names})(?![A-Za-z])") for names in ("num", "unit|si", "qty|SI")
)


@dataclass(slots=True)
class Factor:
    """One unit and its power."""

    letters: str
    power: int = 1


def with_units(tex: str) -> str:
    """``tex`` with numbers and units written out. Raises `UnsupportedTexError`."""
    tex = replaced(tex, QTY, lambda _, given: _quantity(*given), 2)
    tex = replaced(tex, UNIT, lambda _, given: f"{{{_set(factors_of(given[0]))}}}", 1)
    return replaced(tex, NUM, lambda _, given: f"{{{number(given[0])}}}", 1)


def _quantity(amount: str, unit: str) -> str:
    factors = factors_of(unit)
    between = "" if factors and factors[0].letters in CLOSE else r"\,"
    value = number(amount)
    if r"\pm" in value and not value.startswith(r"\pm"):
        value = rf"\left({value}\right)" if r"\times" not in value else value
    return f"{{{value}{between}{_set(factors)}}}"


def number(text: str) -> str:
    """TeX of a number: ``1.5e-3`` as 1.5 × 10⁻³. Raises `UnsupportedTexError`."""
    found = NUMBER.fullmatch(text)
    power_alone = found and found["power"] and not found["whole"] and not found["part"]
    if not found or not (found["whole"] or found["part"] or power_alone):
        raise UnsupportedTexError(f"number {quoted(text)}; legal: '12', '-0.5', '1.5e-3', '2.0(1)'")
    sign = found["sign"].replace("\\pm", r"\pm ")
    digits = _grouped(found["whole"] or "0", found["part"] or "")
    if found["spread"]:
        digits += f"({found['spread']})"
    if found["plus"]:
        whole, _, part = found["plus"].replace(",", ".").partition(".")
        digits += rf" \pm {_grouped(whole, part)}"
        digits = rf"({digits})" if found["power"] else digits
    power = f"10^{{{found['power'].lstrip('+')}}}" if found["power"] else ""
    if power_alone:
        return sign + power
    return sign + digits + (rf" \times {power}" if power else "")


def _grouped(whole: str, part: str) -> str:
    """Digits in threes, from five on; from the decimal point in both directions."""
    if len(whole) > 4:
        first = len(whole) % 3 or 3
        whole = r"\,".join([whole[:first], *re.findall("...", whole[first:])])
    if len(part) > 4:
        part = r"\,".join(re.findall(".{1,3}", part))
    return f"{whole}.{part}" if part else whole


def factors_of(unit: str) -> list[Factor]:
    """The factors of a unit, in order. Raises `UnsupportedTexError`."""
    text = unit.strip()
    if not text:
        raise UnsupportedTexError(r"no unit; legal: '\metre\per\second', or 'm.s^-1'")
    return list(_named(text) if text.startswith("\\") else _written(text))


def _named(text: str) -> Iterator[Factor]:
    sign, power, prefix, last, rest = 1, 1, "", None, 0
    while rest < len(text):
        found = re.compile(r"\s*\\([A-Za-z]+)\s*").match(text, rest)
        if not found:
            raise UnsupportedTexError(f"unit {quoted(text)}; legal: commands such as '\\metre'")
        name, rest = found[1], found.end()
        if name == "per":
            sign = -1
        elif name in ("square", "cubic"):
            power = POWERS[name]
        elif name in POWERS and last:
            last.power *= POWERS[name]
        elif name == "tothe" and last:
            (exponent,), rest = arguments(text, rest, 1, "\\tothe")
            last.power *= _whole(exponent)
        elif name in PREFIXES:
            prefix += PREFIXES[name]
        elif name in UNITS:
            if last:
                yield last
            last = Factor(prefix + UNITS[name], sign * power)
            sign, power, prefix = 1, 1, ""
        else:
            raise UnsupportedTexError(unknown("unit", f"\\{name}", _commands()))
    if last is None or prefix or sign < 0:
        raise UnsupportedTexError(f"unit {quoted(text)} ends before its last unit")
    yield last


def _commands() -> list[str]:
    names = [*UNITS, *PREFIXES, *POWERS, "per", "tothe"]
    return [f"\\{name}" for name in names]


def _written(text: str) -> Iterator[Factor]:
    rest = 0
    while rest < len(text):
        found = WRITTEN.match(text, rest)
        if not found or (rest == 0 and found["over"]):
            raise UnsupportedTexError(f"unit {quoted(text)}; legal: 'm.s^-1', 'm/s', '\\metre'")
        rest = found.end()
        power = int(found["power"] or 1)
        yield Factor(found["unit"], -power if found["over"] else power)


def _whole(text: str) -> int:
    if not re.fullmatch(r"\s*-?\d+\s*", text):
        raise UnsupportedTexError(f"power {quoted(text)} of a unit; legal: a whole number")
    return int(text)


def _letters(unit: str) -> str:
    """In a text, ``%`` would begin a comment."""
    return r"\%" if unit == "%" else rf"\text{{{unit}}}"


def _set(factors: list[Factor]) -> str:
    return r"\,".join(
        _letters(item.letters) + (f"^{{{item.power}}}" if item.power != 1 else "")
        for item in factors
    )
