"""Lens Distortion Simulator: a grid and a picture through a lens with k₁ and k₂."""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from simulations.engine.accuracy import Accuracy, tiers
from simulations.engine.controls import Value
from simulations.engine.frame import Frame, Panel, Readout, format_magnitude, format_number, readout
from simulations.engine.handles import Handle, Point
from simulations.engine.instrument import Instrument
from simulations.engine.scene import Scene
from simulations.engine.settings import choice, slider, toggle
from simulations.engine.stages import Outputs
from simulations.models.distortion.kinds import classify, line_bow
from simulations.models.distortion.lens_model import (
    Distortion,
    distort,
    fold_radius,
    largest_distorted_radius,
)
from simulations.models.distortion.radial_profile import evaluate
from simulations.scenes.lens_distortion.drawing import (
    CENTRE,
    INNER,
    OUTER,
    PLOT,
    SAMPLE,
    UNITS_PER_RADIUS,
    VIEW_HEIGHT,
    VIEW_WIDTH,
    grid_lines,
    handle_place,
    image_of,
    ruler,
)
from simulations.scenes.lens_distortion.stages import (
    FOCAL_PX,
    HEIGHT_PX,
    PHOTOGRAPH_PX,
    STAGES,
    TIERS,
    WIDTH_PX,
    inversion_error_px,
    needs_margin,
)

HALF_DIAGONAL = 0.5 * np.hypot(WIDTH_PX, HEIGHT_PX) / FOCAL_PX
"""Normalised radius of the picture's corners: 1."""
DIVERGED_PX = 1e4  # largest error of a converged iteration
INVISIBLE_PX = 0.1
"""Changes of the magnification that move no corner by more than this are ignored."""
KINDS = {
    "none": "Distortion too small to see",
    "barrel": "Barrel distortion",
    "pincushion": "Pincushion distortion",
    "moustache": "Moustache distortion, inwards at some radii and outwards at others",
}


@dataclass(frozen=True, slots=True)
class Settings:
    k1: float = slider("k₁", 0.0, -0.5, 0.5, 0.01)
    k2: float = slider("k₂", 0.0, -0.3, 0.3, 0.01)
    picture: str = choice("Picture", {"room": "Room", "chart": "Test chart"})
    correct: bool = toggle("Correct the picture")


def lens_of(settings: Settings) -> Distortion:
    return Distortion(k1=settings.k1, k2=settings.k2)


def largest_bow_px(lens: Distortion) -> float:
    """Largest distance of a line of the grid from its chord, inside the fold."""
    fold, largest, lines = fold_radius(lens), 0.0, grid_lines()
    within = np.hypot(lines[..., 0], lines[..., 1]) < fold
    if within.all():
        return float(line_bow(distort(lines, lens)).max()) * FOCAL_PX
    for ideal, inside in zip(lines, within, strict=True):
        if inside.sum() > 2:
            largest = max(largest, float(line_bow(distort(ideal[inside], lens))))
    return largest * FOCAL_PX


def corner_shift_px(lens: Distortion) -> float:
    """Outward shift of the corners in px; NaN if they are past the fold."""
    if fold_radius(lens) <= HALF_DIAGONAL:
        return float("nan")
    return float(evaluate(lens.radial, HALF_DIAGONAL) - HALF_DIAGONAL) * FOCAL_PX


def draw(settings: Settings, outputs: Outputs) -> Frame:
    """The photograph, the grid, and the curve that the coefficients describe."""
    lens, drawn, size = lens_of(settings), outputs["drawings"], (VIEW_WIDTH, VIEW_HEIGHT)
    over = drawn["corrected" if settings.correct else "picture"]
    if settings.picture == "room" and not outputs["photograph"]:
        over = ruler(Distortion() if settings.correct else lens) + over
    kind = classify(lens, HALF_DIAGONAL, INVISIBLE_PX / FOCAL_PX)
    bow, shift, fold = largest_bow_px(lens), corner_shift_px(lens), fold_radius(lens)
    return Frame(
        (
            Panel("picture", "The photograph", *size, outputs["encoded"], over, lead=True),
            Panel("grid", "A straight grid and its image", *size, overlay=drawn["grid"]),
            Panel("profile", "How far from the centre", *size, overlay=drawn["profile"]),
        ),
        (
            Readout("kind", "Kind", kind),
            readout("bow", "Largest bow", bow, "px", digits=1, role="image"),
            Readout("corner", "Corners move", "past the fold", "", role="error")
            if np.isnan(shift)
            else readout("corner", "Corners move", shift, "px", digits=1, role="ray"),
            Readout("fold", "Fold radius", "none" if np.isinf(fold) else format_number(fold, 3)),
        ),
        describe(lens, KINDS[kind], bow, shift, corrected=settings.correct),
    )


def describe(lens: Distortion, kind: str, bow: float, shift: float, *, corrected: bool) -> str:
    setting = f"k₁ = {format_number(lens.k1)}, k₂ = {format_number(lens.k2)}"
    if lens.neutral:
        return f"No distortion ({setting}): the grid is straight and the picture is a pinhole’s."
    sentence = f"{kind} ({setting}): straight lines bow by up to {format_number(bow, 1)} px"
    if np.isnan(shift):
        limit = format_number(largest_distorted_radius(lens), 2)
        sentence += (
            f", the corners lie past the fold, and beyond radius {limit} the model images nothing"
        )
    else:
        direction = "inwards" if shift < 0 else "outwards"
        moves = (
            f"move {format_number(abs(shift), 1)} px {direction}" if abs(shift) > 0.05 else "stay"
        )
        sentence += f" and the corners {moves}"
    return sentence + ("; the picture is corrected." if corrected else ".")


def estimate(settings: Settings, _outputs: Outputs, tier: str) -> Iterator[Readout]:
    """Error of the pixels' source points in the scene, in one step."""
    wrong = inversion_error_px(lens_of(settings), tier)
    diverged = wrong > DIVERGED_PX
    text = "diverges" if diverged else format_magnitude(wrong, 1e-9)
    yield Readout(
        "error", "RMS error of the inversion", text, "" if diverged else "px", role="error"
    )


def point_handle(
    name: str, label: str, ideal: tuple[float, float], drives: str
) -> Handle[Settings]:
    """A handle in the photograph, within its border where the point is farther out; none past the
    fold and in a corrected photograph."""

    def at(settings: Settings, _outputs: Outputs) -> Point | None:
        lens = lens_of(settings)
        hidden = settings.correct or math.hypot(*ideal) >= fold_radius(lens)
        return None if hidden else handle_place(ideal, lens)

    def pull(settings: Settings, place: Point) -> Mapping[str, Value]:
        """The coefficient that images the point nearest to the place; at the border a search would
        find no change. r (1 + k₁ r² + k₂ r⁴) is solved for it."""
        square = ideal[0] ** 2 + ideal[1] ** 2
        across, down = ((place[i] - CENTRE[i]) / UNITS_PER_RADIUS for i in (0, 1))
        growth = (across * ideal[0] + down * ideal[1]) / square - 1.0
        if drives == "k1":
            return {"k1": growth / square - settings.k2 * square}
        return {"k2": growth / square**2 - settings.k1 / square}

    return Handle(name, "picture", label, (drives,), at, pull, role="image")


def crossing_at(settings: Settings, _outputs: Outputs) -> Point | None:
    """The image of the crossing, if it is inside the fold."""
    lens = lens_of(settings)
    return image_of(SAMPLE, lens) if fold_radius(lens) > math.hypot(*SAMPLE) else None


def radius_at(settings: Settings, _outputs: Outputs) -> Point | None:
    """The same crossing on the curve of the lens."""
    lens, ideal = lens_of(settings), math.hypot(*SAMPLE)
    return (
        PLOT.at(ideal, float(evaluate(lens.radial, ideal))) if fold_radius(lens) > ideal else None
    )


SCENE = Scene(
    "lens-distortion",
    "Lens Distortion Simulator",
    Settings,
    draw,
    STAGES,
    handles=(
        point_handle("point", "Inner point", INNER, "k1"),
        point_handle("outer", "Outer point", OUTER, "k2"),
        Handle("crossing", "grid", "Image of a crossing", ("k1",), crossing_at, role="image"),
        Handle("radius", "profile", "Radius in the image", ("k1",), radius_at, role="image"),
    ),
    instrument=Instrument(photograph=PHOTOGRAPH_PX),
    accuracy=Accuracy(
        levels=tiers(*TIERS),
        default="closed-form",
        ladder="inverse-strong",
        estimate=estimate,
        unit="px",
    ),
    parameters=lambda settings, _: {"margin": needs_margin(settings.k1, settings.k2)},
    formula=distort,
)
