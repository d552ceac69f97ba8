"""The name of something new, in all the ways in which it is written."""

import keyword
import re
from dataclasses import dataclass

FORM = re.compile(r"[a-z][a-z0-9]*(-[a-z0-9]+)*")


class ScaffoldError(ValueError):
    """Something new cannot be made."""


@dataclass(frozen=True, slots=True)
class Name:
    """``falling-ball``: lower case, with hyphens."""

    text: str

    @property
    def module(self) -> str:
        return self.text.replace("-", "_")

    @property
    def constant(self) -> str:
        return self.module.upper()

    @property
    def class_name(self) -> str:
        return "".join(word.capitalize() for word in self.text.split("-"))

    @property
    def title(self) -> str:
        return " ".join(word.capitalize() for word in self.text.split("-"))

    @property
    def words(self) -> str:
        return self.text.replace("-", " ")


def read_name(kind: str, text: str) -> Name:
    """Raises `ScaffoldError`."""
    if not FORM.fullmatch(text):
        expected = "small letters and digits, with hyphens between words, as in 'falling-ball'"
        raise ScaffoldError(f"{kind} {text!r}; legal: {expected}")
    if keyword.iskeyword(text):
        raise ScaffoldError(f"{kind} {text!r} is a word of Python's own; legal: any other name")
    return Name(text)
