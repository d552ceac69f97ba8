"""2D Transform Explorer: a square and its image on each rung of the ladder of transformations."""

import math
from dataclasses import dataclass
from functools import cache

import numpy as np

from simulations.engine import drawing
from simulations.engine.frame import Frame, Panel, Readout, format_number, matrix_text, readout
from simulations.engine.handles import Handle, Point
from simulations.engine.scene import Scene
from simulations.engine.settings import action, choice, slider
from simulations.engine.stages import Outputs
from simulations.models.arrays import Floats
from simulations.models.geometry.preserved_properties import Preservation, measure_preservation
from simulations.models.geometry.transforms import apply_homography
from simulations.scenes._mapped_square import family, plane

ROUNDING = 1e-9  # largest measured change, in radians or as a share, that counts as rounding
WIDTH, HEIGHT = 400.0, 330.0  # of the panel of the families


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


@dataclass(frozen=True, slots=True)
class Settings:
    transform: str = choice("Transform", {name: rung.title for name, rung in RUNGS.items()})
    amount: float = slider("Amount", 30, 0, 100, 1, arrival=100)
    play: int = action("Play", "Pause", drives="amount", effect="play", seconds=8.0)
    point_x: float = slider("P, right (x)", 40, -60, 60, 1)
    point_y: float = slider("P, up (y)", 40, -60, 60, 1)
    pull_x: float = slider("Corner pulled right", 0, -150, 150, 1)
    pull_y: float = slider("Corner pulled up", 0, -150, 150, 1)


def unpulled(settings: Settings) -> Floats:
    """The matrix (3, 3) of family and amount alone."""
    return family.transformation(settings.transform, settings.amount)


def matrix(settings: Settings) -> Floats:
    """The matrix (3, 3) that the figure shows."""
    pull = (settings.pull_x, settings.pull_y)
    return family.with_moved_corner(settings.transform, unpulled(settings), pull)


def square_panel(settings: Settings, H: Floats, point: Floats) -> Panel:
    """Original and image on common axes."""
    moved = settings.pull_x != 0.0 or settings.pull_y != 0.0
    matrices = family.matrices_of_amounts(settings.transform)[: 0 if moved else None : 4]
    parts = (
        plane.axes(),
        plane.original(),
        plane.lines_at_infinity(H),
        plane.figure(H, "image"),
        *plane.corners(settings.transform, H),
        plane.point_and_image(H, matrices, point),
    )
    size, overlay = (plane.WIDTH, plane.HEIGHT), "".join(parts)
    return Panel("plane", "Original and image", *size, overlay=overlay, lead=True)


def frame_of(name: str) -> tuple[float, float, float, float]:
    """Left, top, right and bottom of a family's frame."""
    depth = len(RUNGS) - 1 - list(RUNGS).index(name)
    left = 8.0 + 14.0 * depth
    return left, 6.0 + 52.0 * depth, WIDTH - left, HEIGHT - 6.0 - 10.0 * depth


def family_handle_place(name: str) -> Point:
    """The handle of a family, below its degrees of freedom."""
    _, top, right, _ = frame_of(name)
    return right - 32.0, top + 40.0


@cache
def hierarchy_panel(current: str) -> Panel:
    """The families as five nested frames; each contains the smaller families."""
    parts = []
    for name, rung in reversed(RUNGS.items()):
        left, top, right, bottom = frame_of(name)
        role, style = ("image", "image fill") if name == current else ("muted", "muted thin")
        keeps, freedoms = f"also keeps {rung.preserves}", f"{rung.freedoms} DoF"
        parts += [
            drawing.rectangle((left, top), right - left, bottom - top, style),
            drawing.text((left + 12.0, top + 20.0), rung.title, f"{role} strong"),
            drawing.text((left + 12.0, top + 39.0), keeps, f"{role} small"),
            drawing.text((right - 12.0, top + 20.0), freedoms, role, "end"),
        ]
    overlay = "".join(parts) + drawing.dot(family_handle_place(current), "image", 4.0)
    return Panel("hierarchy", "Each family contains the next", WIDTH, HEIGHT, overlay=overlay)


def entries_of(H: Floats) -> list[list[str]]:
    """H with two decimals; four in the last row, whose entries divide by lengths."""
    rows = [[format_number(float(entry), 2) for entry in row] for row in H[:2]]
    affine = not H[2, :2].any()
    last = ["0", "0", "1"] if affine else [format_number(float(entry), 4) for entry in H[2]]
    return [*rows, last]


def changes_of(measured: Preservation) -> tuple[tuple[str, str, float, str], ...]:
    """Name, label and largest change of each property, and its unit: radians are shown as °."""
    return (
        ("orientation", "Orientation", measured.turn_rad, "°"),
        ("lengths", "Lengths", measured.length, "\u00a0%"),
        ("angles", "Angles", measured.angle_rad, "°"),
        ("parallels", "Parallel lines", measured.parallel_rad, "°"),
        ("lines", "Straight lines", measured.bend, "\u00a0%"),
    )


def verdict(change: float, unit: str) -> str:
    if change <= ROUNDING:
        return "kept"
    if math.isinf(change):
        return "changed without bound"
    amount = math.degrees(change) if unit == "°" else 100.0 * change
    return f"changed by up to {format_number(amount, 1)}{unit}"


def point_readouts(H: Floats, point: Floats) -> tuple[Readout, ...]:
    """The image of P, and the divisor w."""
    image, valid = apply_homography(H, point)
    texts = [format_number(float(value), 1) if valid else "at infinity" for value in image]
    return (
        Readout("x", "x′ of P′", texts[0], "", role="image"),
        Readout("y", "y′ of P′", texts[1], "", role="image"),
        readout("w", "w at P", float(H[2] @ [*point, 1.0]), digits=3),
    )


def draw(settings: Settings, _outputs: Outputs) -> Frame:
    """The square before and after, the ladder, and the properties that the transformation
    preserves."""
    rung = RUNGS[settings.transform]
    H, point = matrix(settings), np.array([settings.point_x, settings.point_y])
    changes, ratio = changes_of(measure_preservation(H, plane.SEGMENTS)), plane.area_ratio(H)
    size = (
        "reaches the line that is sent to infinity, so that only a part of its image can be drawn"
        if math.isinf(ratio)
        else f"has an image of {format_number(ratio, 2)} times its area"
    )
    preserved = ", ".join(label.lower() for _, label, change, _ in changes if change <= ROUNDING)
    return Frame(
        (square_panel(settings, H, point), hierarchy_panel(settings.transform)),
        (
            Readout("matrix", "H", matrix_text(entries_of(H)), "", role="image"),
            readout("freedoms", "Degrees of freedom", rung.freedoms, digits=0),
            readout("area", "Area, image : original", ratio, digits=3),
            *(Readout(name, label, verdict(change, unit)) for name, label, change, unit in changes),
            *point_readouts(H, point),
        ),
        f"The square under {rung.phrase} {size}; kept: {preserved}. "
        f"{plane.describe_point(H, point)}",
    )


def image_at(settings: Settings, _outputs: Outputs) -> Point | None:
    image, valid = apply_homography(matrix(settings), (settings.point_x, settings.point_y))
    return tuple(plane.to_view(image).tolist()) if valid else None


def corner_at(settings: Settings, _outputs: Outputs) -> Point:
    return tuple(plane.to_view(family.pulled_corner(matrix(settings))).tolist())


def corner_pulled(settings: Settings, place: Point) -> dict[str, float]:
    x, y = (plane.from_view(place) - family.pulled_corner(unpulled(settings))).tolist()
    return {"pull_x": x, "pull_y": y}


def family_pulled(_settings: Settings, place: Point) -> dict[str, str]:
    """The smallest family whose frame contains the place, the largest outside of all; places up to
    half way between two marks belong to the lower one."""
    x, y = place[0], place[1] - 14.0
    for name in RUNGS:
        left, top, right, bottom = frame_of(name)
        if left <= x <= right and top <= y <= bottom:
            break
    return {"transform": name}


SCENE = Scene(
    "transform-2d",
    "2D Transform Explorer",
    Settings,
    draw,
    handles=(
        Handle(
            "corner",
            "plane",
            "Corner of the image",
            drives=("pull_x", "pull_y"),
            at=corner_at,
            pull=corner_pulled,
            role="image",
        ),
        Handle(
            "point",
            "plane",
            "Point P",
            drives=("point_x", "point_y"),
            at=lambda settings, _: tuple(
                plane.to_view((settings.point_x, settings.point_y)).tolist()
            ),
            pull=lambda _, place: dict(
                zip(("point_x", "point_y"), plane.from_view(place).tolist(), strict=True)
            ),
            role="world",
        ),
        Handle("image", "plane", "Image of P", ("amount",), image_at, role="image"),
        Handle(
            "family",
            "hierarchy",
            "Family mark",
            drives=("transform",),
            at=lambda settings, _: family_handle_place(settings.transform),
            pull=family_pulled,
            reach="press",
            role="image",
        ),
    ),
    formula=apply_homography,
)
