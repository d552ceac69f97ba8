"""Chapters of books that nobody wrote: one has of every kind of thing as much as a real one, the
other nothing but prose.

A chapter is the same whenever it is made, and the same text for each builder: only what has a
notation of its own, a figure and a question, is written as that builder's authors write it.
"""

from collections.abc import Callable
from dataclasses import dataclass
from random import Random

SECTIONS = 5
VOCABULARY = (
    "a the of and light lens image pixel ray sensor point plane noise edge grid wave depth field "
    "angle scale shift blur sample model error value line corner world camera colour focus through "
    "into before after where which every small large exact known measured falls bends keeps shows "
    "changes remains doubles halves follows"
)
FORMULAE = (
    r"x' = f\,\frac{X}{Z} + c_x",
    r"r_d = r\,(1 + k_1 r^2 + k_2 r^4)",
    r"\begin{pmatrix} a & b \\ c & d \end{pmatrix} \begin{pmatrix} x \\ y \end{pmatrix}",
    r"\sigma^2 = \sum_{i=1}^{n} \frac{(x_i - \mu)^2}{n - 1}",
    r"L = \int_0^{\pi/2} E(\theta) \cos\theta \, d\theta",
)
CODE = """\
def step_{n}(values, scale={n}.5):
    \"\"\"One step of the chain, for all values at once.\"\"\"
    result = []
    for index, value in enumerate(values):
        if value < 0:
            raise ValueError(f"value {{index}} is {{value}}; legal: from 0")
        result.append(scale * value**2 + index)
    return sum(result) / max(len(result), 1)
"""
PICTURE = """\
<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 400 300">
  <path d="M20 {n} C120 20 240 280 380 150" fill="none" stroke="#125b9c" stroke-width="3"/>
</svg>
"""


@dataclass(frozen=True, slots=True)
class Notation:
    """How a builder's authors write what Markdown has no form for."""

    figure: str
    question: str


type Chapter = Callable[[int, int, Notation], str]
"""The text below the title of a chapter, from 1, of so many."""
DIRECTIVE_FIGURE = ":::{{figure}} {file}\n:alt: A curve.\nThe curve {n}.\n:::\n"
LIST = "{ask}\n\n- {right}: it follows.\n- {wrong}: it does not.\n"
OURS = Notation(
    DIRECTIVE_FIGURE,
    ":::{{quiz}} question-{n}\n{ask}\n- [x] {right}\n  : It follows.\n"
    "- [ ] {wrong}\n  : It does not.\n:::\n",
)
MYST = Notation(DIRECTIVE_FIGURE, LIST)
MKDOCS = Notation("![A curve.]({file})\n\nThe curve {n}.\n", LIST)


def chapter(number: int, count: int, notation: Notation) -> str:
    """The text below the title of chapter ``number`` of ``count``, from 1."""
    random = Random(number)
    parts = [
        _section(number, part, random, notation, number % count + 1)
        for part in range(1, SECTIONS + 1)
    ]
    return "\n".join(parts)


def plain_chapter(number: int, count: int, _notation: Notation) -> str:
    """As long as the others, of nothing but prose: headings, paragraphs, lists, links."""
    random = Random(number)
    following = number % count + 1
    return "\n".join(_plain_section(part, random, following) for part in range(1, SECTIONS + 1))


def title(number: int) -> str:
    return f"Part {number} of the whole"


def name(number: int) -> str:
    """Of its file, without ``.md``."""
    return f"chapter-{number:04}"


def picture_name(number: int) -> str:
    return f"images/curve-{number:04}.svg"


def picture(number: int) -> str:
    return PICTURE.format(n=number % 280)


def _section(number: int, part: int, random: Random, notation: Notation, following: int) -> str:
    some = _phrases(random)
    key = f"{number}-{part}"
    # No two alike: what was set or highlighted once must not serve twice.
    formulae = [f"{formula} + {number}_{{{part}}}" for formula in random.sample(FORMULAE, 2)]
    rows = "".join(f"| {some(2)} | {random.random():.3f} | ${n}x$ |\n" for n in range(1, 6))
    blocks = [
        f"## Section {part} on {some(3)}\n",
        f"The {some(40)}, with *{some(2)}* and **{some(1)}**, where ${formulae[0]}$.\n",
        f"Then {some(60)}; see [what follows]({name(following)}.md).\n",
        f"$$\n{formulae[1]}\n$$\n",
        f"- {some(12)}\n- {some(9)} `{some(1)}_{part}`\n- {some(11)}\n",
        f"```python\n{CODE.format(n=f'{number}{part}')}```\n",
        f"| What | Value | Times |\n|---|---|---|\n{rows}",
        f"So {some(70)}.\n",
    ]
    if part == 1:
        blocks.append(notation.figure.format(file=picture_name(number), n=number))
    if part > SECTIONS - 2:
        ask = f"What does the {some(4)} do?"
        told = {"right": f"It {some(3)}", "wrong": f"It {some(3)} not"}
        blocks.append(notation.question.format(n=key, ask=ask, **told))
    return "\n".join(blocks)


def _plain_section(part: int, random: Random, following: int) -> str:
    some = _phrases(random)
    blocks = [
        f"## Section {part} on {some(3)}\n",
        f"The {some(40)}, with *{some(2)}* and **{some(1)}**.\n",
        f"Then {some(60)}; see [what follows]({name(following)}.md).\n",
        f"### Of {some(3)}\n",
        f"- {some(12)}\n- {some(9)}\n- {some(11)}\n",
        f"Then {some(50)}, as [others](https://example.org/{part}) have it.\n",
        f"1. {some(8)}\n2. {some(14)}\n",
        f"> The {some(20)}\n",
        f"So {some(70)}.\n",
    ]
    return "\n".join(blocks)


def _phrases(random: Random) -> Callable[[int], str]:
    """Makes so many words."""
    vocabulary = VOCABULARY.split()
    return lambda count: " ".join(random.choice(vocabulary) for _ in range(count))


BOOKS: dict[str, Chapter] = {"everything": chapter, "prose": plain_chapter}
"""What is compared, each by itself: who sets no formulae is quick where there are some."""
