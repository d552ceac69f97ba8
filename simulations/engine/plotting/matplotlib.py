"""A figure of matplotlib as plots: its lines, points, bars, areas and texts, in the page's colours.

Nothing of matplotlib is imported here, nor does it draw.
"""

import sys
from collections.abc import Iterator
from typing import Any

from simulations.engine.drawing import dot, polygon, text
from simulations.engine.frame import ROLES
from simulations.engine.plotting.legend import Entry, Sign, legend
from simulations.engine.plotting.plot import Plot

FRAME = ("Spine", "XAxis", "YAxis", "Legend")
SIGNS: dict[str, Sign] = {"Line2D": "line", "PathCollection": "dot"}


def plots_of(figure: Any) -> Iterator[tuple[str, Plot]]:
    """Title and plot of each of its axes. Each colour becomes a role, in the order of first use.

    Raises `ValueError` for what a plot does not have.
    """
    for axes in figure.axes:
        roles: dict[str, str] = {}
        entries: dict[str, Entry] = {}
        log = "".join(name for name in "xy" if getattr(axes, f"get_{name}scale")() == "log")
        limits = axes.get_xlim(), axes.get_ylim()
        plot = Plot.of(axes.get_xlabel(), limits[0], axes.get_ylabel(), limits[1], log=log)
        decorations = (axes.patch, axes.title, axes._left_title, axes._right_title)
        for artist in sorted(axes.get_children(), key=lambda each: each.get_zorder()):
            kind = type(artist).__name__
            if (
                any(artist is each for each in decorations)
                or kind in FRAME
                or not artist.get_visible()
            ):
                continue
            style = _style(artist, kind, roles)
            plot = plot.showing(*_marks(artist, kind, style, plot, axes.transData))
            name = str(artist.get_label())
            if kind in SIGNS and name and not name.startswith("_"):
                entries[name] = Entry(name, style, SIGNS[kind])
        if axes.get_legend() and entries:
            plot = plot.showing(legend((64, 44), list(entries.values()), "small"))
        yield axes.get_title(), plot
    if pyplot := sys.modules.get("matplotlib.pyplot"):  # which would keep it for ever
        pyplot.close(figure)


def _style(artist: Any, kind: str, roles: dict[str, str]) -> str:
    if kind in ("Text", "Annotation"):
        return "muted"
    colour = str(artist.get_color() if kind == "Line2D" else artist.get_facecolor())
    free = [role for role in ROLES if role and role not in roles.values()] or ["muted"]
    role = roles.setdefault(colour, free[0])
    dashed = " dashed" * (kind == "Line2D" and artist.get_linestyle() not in ("-", "None"))
    return f"{role}{dashed}"


def _marks(artist: Any, kind: str, style: str, plot: Plot, data: Any) -> Iterator[str]:
    """Marks in units of the data, whatever units the artist has."""
    match kind:
        case "Line2D":
            points = (artist.get_transform() - data).transform(artist.get_xydata())
            if artist.get_linestyle() != "None":
                yield plot.curve(points[:, 0], points[:, 1], f"{style} bold")
            if artist.get_marker() not in ("None", None, ""):
                yield from (plot.mark(x, y, style) for x, y in points.tolist())
        case "PathCollection":
            yield from (dot(plot.at(x, y), style) for x, y in artist.get_offsets().tolist())
        case "Rectangle":
            x, y = artist.get_xy()
            width, height = artist.get_width(), artist.get_height()
            yield plot.region((x, x + width), (y, y + height), f"{style} fill")
        case "PolyCollection" | "FillBetweenPolyCollection":
            for path in artist.get_paths():
                yield polygon(
                    [plot.clamped(x, y) for x, y in path.vertices.tolist()], f"{style} fill faint"
                )
        case "Text" | "Annotation":
            yield text(plot.at(*artist.get_position()), artist.get_text(), style)
        case _:
            raise ValueError(f"a {kind} of matplotlib; legal: lines, points, bars, areas, texts")
