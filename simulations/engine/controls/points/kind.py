"""Lists of points in a picture, such as the ends of lines drawn over it."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Self

from simulations.engine.controls.control import ControlError, Value, setting

type Point = tuple[float, float]
"""Shares of the picture's width and height, from its upper left corner."""

DECIMALS = 5


@dataclass(frozen=True, slots=True)
class PointLists:
    """The value of the control, which is written as ``corner_3;0.1,0.2_0.5,0.6;;``."""

    picture: str = ""
    """Picture in which the points lie: a word that the scene chooses."""
    touched: int = 0
    """Number of the point that was moved last in its list."""
    lists: tuple[tuple[Point, ...], ...] = ()

    @classmethod
    def from_text(cls, text: str) -> Self:
        """Raises `ValueError` for any other form."""
        head, *lists = text.split(";")
        picture, _, touched = head.partition("_")
        points = tuple(tuple(map(_point, entry.split("_") if entry else ())) for entry in lists)
        return cls(picture, int(touched or 0), points)

    @property
    def text(self) -> str:
        head = f"{self.picture}_{self.touched}" if self.touched else self.picture
        lists = ("_".join(f"{_share(x)},{_share(y)}" for x, y in points) for points in self.lists)
        return ";".join((head, *lists))


def _point(pair: str) -> Point:
    x, y = map(float, pair.split(","))
    if not (0.0 <= x <= 1.0 and 0.0 <= y <= 1.0):
        raise ValueError(f"point {pair}; legal: 0 to 1")
    return x, y


def _share(value: float) -> str:
    """Within 0 to 1, without trailing zeros."""
    text = f"{min(max(value, 0.0), 1.0):.{DECIMALS}f}"
    return text.rstrip("0").rstrip(".")


@dataclass(frozen=True, slots=True, kw_only=True)
class Points:
    """Lists of points (``input[type=text]``, hidden), which handles add and move."""

    name: str
    label: str
    lists: int
    """How many lists there are."""
    most: int
    """Most points of a list."""
    buttons: Mapping[str, str]
    """Handle that a button pulls, to the text of the button."""
    default: str = ""
    """Written like `PointLists`; each scene decides what no points at all mean."""

    kind = "points"
    types = (str,)

    def __post_init__(self) -> None:
        self.check(self.default)

    @property
    def legal(self) -> str:
        return f"{self.lists} lists of at most {self.most} points, such as ';0.1,0.2_0.5,0.6'"

    def check(self, raw: object) -> str:
        try:
            if not isinstance(raw, str):
                raise ValueError("no text")
            found = PointLists.from_text(raw)
            longest = max((len(points) for points in found.lists), default=0)
            if len(found.lists) > self.lists or longest > self.most:
                raise ValueError("too many")
            if not (found.picture.isalnum() or found.picture == "") or found.touched < 0:
                raise ValueError("no word")
        except ValueError as error:
            raise ControlError(f"{self.name}: {raw!r} ({error}); legal: {self.legal}") from None
        return raw

    clamp = check

    def details(self) -> dict[str, object]:
        return {"lists": self.lists, "most": self.most}

    def text(self, _value: Value, _numeral: Callable[[str], str] = str) -> tuple[str, str]:
        return "", ""

    def extremes(self) -> tuple[Value, ...]:
        """The default, no points, and a pair of points in each list."""
        return self.default, ";" * self.lists, ";0.3,0.25_0.7,0.75" * self.lists

    def span(self, _value: Value) -> tuple[float, float, float]:
        return 0, 0, 0


def points(
    label: str, lists: int, most: int, *, buttons: Mapping[str, str], default: str = ""
) -> str:
    """Lists of points in a picture, which handles move; buttons pull other handles, which add
    points or take them away."""
    limits = {"lists": lists, "most": most}
    return setting(default, Points, label=label, **limits, buttons=buttons, default=default)
