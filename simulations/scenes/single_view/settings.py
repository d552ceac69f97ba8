"""The controls of the distances from one picture."""

from dataclasses import dataclass

from simulations.engine.settings import action, choice, points, slider, toggle

LISTS = {
    "across": "Lines across the room",
    "along": "Lines along the room",
    "upright": "Uprights",
    "floor": "Lengths on the plane",
    "height": "Heights above the plane",
}
"""What is drawn. The first three are the axes 0, 1 and 2."""
MOST = 6
"""Most lines of a list."""
PLANES = {"floor": "Floor", "along": "Wall along the room", "across": "Wall across it"}
NORMALS = {"floor": 2, "along": 0, "across": 1}
"""The axis at right angles to each."""
TAKES = 20


@dataclass(frozen=True, slots=True)
class Settings:
    """The settings of the figure."""

    picture: str = choice("Picture", {"corner": "Into a corner", "front": "Straight on"})
    direction: str = choice("Draw", LISTS, default="along")
    lines: str = points(
        "Lines", len(LISTS), 2 * MOST, buttons={"add": "Add a line", "clear": "Clear"}
    )
    sigma: float = slider("Error of an end point", 1.0, 0.5, 10.0, 0.5, unit="px")
    known: float = slider("Known length", 2.0, 0.05, 20.0, 0.01, unit="m")
    plane: str = choice("Plane of the lengths", PLANES)
    centre: bool = toggle("Find the principal point too")
    take: int = action(*("Draw the lines anew",) * TAKES)
