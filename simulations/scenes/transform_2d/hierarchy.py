"""The ladder of 2D transformations drawn as nested sets, the current one highlighted."""

from dataclasses import dataclass

from simulations.engine import drawing
from simulations.engine.frame import Panel
from simulations.engine.handles import Point

WIDTH, HEIGHT = 400.0, 400.0


@dataclass(frozen=True, slots=True)
class Rung:
    """A family of transformations."""

    title: str
    phrase: str
    """Its name within a sentence."""
    freedoms: int
    """Degrees of freedom."""
    preserves: str
    """The property that it preserves and the next larger family does not."""


RUNGS = {
    "translation": Rung("Translation", "a translation", 2, "orientation"),
    "rigid": Rung("Rigid (Euclidean)", "a rigid transformation", 3, "lengths"),
    "similarity": Rung("Similarity", "a similarity transformation", 4, "angles"),
    "affine": Rung("Affine", "an affine transformation", 6, "parallel lines"),
    "projective": Rung("Projective", "a projective transformation", 8, "straight lines"),
}
"""Table 2.1 of Szeliski, 2nd ed., smallest family first."""


def hierarchy_panel(current: str) -> Panel:
    """Five nested frames; each contains the smaller families."""
    parts = []
    for name, rung in reversed(RUNGS.items()):
        chosen = name == current
        left, top, right, bottom = frame_of(name)
        style = "image fill" if chosen else "muted thin"
        parts.append(drawing.rectangle((left, top), right - left, bottom - top, style))
        parts.append(rung_labels(rung, left, top, "image" if chosen else "muted"))
    parts.append(drawing.dot(grip(current), "image", 4.0))
    return Panel(
        "hierarchy", "Each family contains the next", WIDTH, HEIGHT, overlay="".join(parts)
    )


def frame_of(name: str) -> tuple[float, float, float, float]:
    """Left, top, right and bottom of a family's frame."""
    depth = len(RUNGS) - 1 - list(RUNGS).index(name)
    left = 8.0 + 14.0 * depth
    return left, 8.0 + 64.0 * depth, WIDTH - left, HEIGHT - 8.0 - 12.0 * depth


def grip(name: str) -> Point:
    """The handle of a family, below its degrees of freedom."""
    _, top, right, _ = frame_of(name)
    return right - 32.0, top + 46.0


def innermost_at(place: Point) -> str:
    """The smallest family whose frame contains a place; the largest outside of all."""
    for name in RUNGS:
        left, top, right, bottom = frame_of(name)
        if left <= place[0] <= right and top <= place[1] <= bottom:
            return name
    return name


def rung_labels(rung: Rung, left: float, top: float, role: str) -> str:
    right = WIDTH - left - 12.0
    return (
        drawing.text((left + 12.0, top + 25.0), rung.title, f"{role} strong")
        + drawing.text((left + 12.0, top + 45.0), f"also keeps {rung.preserves}", f"{role} small")
        + drawing.text((right, top + 25.0), f"{rung.freedoms} DoF", role, "end")
    )
