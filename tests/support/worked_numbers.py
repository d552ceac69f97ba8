"""Numbers that a chapter works out in its own text, and where they stand in its source.

Each chapter has a module ``tests/content/numbers_NN.py``: ``CHAPTER`` is its file, ``WORKED`` its
calculations, functions that compute again with the models and yield the phrases in which the
results stand; ``GIVEN`` lists the other numbers of the text, those that the author chose.
"""

import re
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path

CONTENT = Path(__file__).resolve().parents[2] / "content"
type Says = Iterator[str]
type Calculation = Callable[[], Says]

CODE = re.compile(r"^(```+).*?^\1$", re.MULTILINE | re.DOTALL)
NOT_TEXT = re.compile(
    r"""^:{3,}\{(?:simulation|quiz|source|ladder|extremes|stage-costs|figure)\}.*$
    |  ^:(?!default)[a-z_]\w*:.*$  # an option; but the reason for a default is text
    |  \{[\w-]+\}`[^`\n]*`         # a role: its number is computed already
    |  (?<=\])\([^)\s]*\)          # the target of a link
    """,
    re.MULTILINE | re.VERBOSE,
)
NUMBER = re.compile(r"(?<![\w.])\d+(?:(?:\\,|\u202f| )\d{3}(?!\d))*(?:\.\d+)?(?!\w)")


def source(chapter: str) -> str:
    """The chapter as written; no-break spaces count as spaces."""
    return (CONTENT / f"{chapter}.md").read_text(encoding="utf-8").replace("\u00a0", " ")


def telling_numbers(text: str) -> list[str]:
    """The numbers of a text that may be results: with a decimal point, or from three digits on.

    Thousands that are set apart are joined: ``10 000`` is ``10_000``.
    """
    found = (
        match[0].replace(" ", "_")
        for match in NUMBER.finditer(NOT_TEXT.sub(" ", CODE.sub(" ", text)))
    )
    return [number for number in found if "." in number or len(re.sub(r"\D", "", number)) > 2]


def without(phrases: Iterable[str], text: str) -> str:
    """The text with all phrases taken out, longest first."""
    for phrase in sorted(phrases, key=len, reverse=True):
        text = text.replace(phrase, " … ")
    return text
