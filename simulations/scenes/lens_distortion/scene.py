"""Lens Distortion Simulator: a grid and a picture through a lens with k₁ and k₂."""

from collections.abc import Iterator

import numpy as np

from simulations.engine.controls import Value
from simulations.engine.frame import Frame, Panel, Readout, format_magnitude, format_number, readout
from simulations.engine.scene import Scene
from simulations.engine.stages import Outputs
from simulations.models.distortion.kinds import classify, line_bow
from simulations.models.distortion.lens_model import (
    Distortion,
    distort,
    fold_radius,
    largest_distorted_radius,
)
from simulations.models.distortion.radial_profile import evaluate
from simulations.scenes.lens_distortion.drawing import VIEW_HEIGHT, VIEW_WIDTH, grid_lines
from simulations.scenes.lens_distortion.handles import HANDLES
from simulations.scenes.lens_distortion.radii import (
    FOCAL_PX,
    HALF_DIAGONAL,
    TIERS,
    inversion_error_px,
)
from simulations.scenes.lens_distortion.settings import Settings
from simulations.scenes.lens_distortion.stages import PHOTOGRAPH_PX, STAGES, Drawings, needs_margin

DIVERGED_PX = 1e4
"""Largest error of a converged iteration."""
INVISIBLE_PX = 0.1
"""Changes of the magnification that move no corner by more than this are ignored."""


def parameters(settings: Settings, _tier: str) -> dict[str, Value]:
    """The picture is drawn with a margin only if a part of it may come into view."""
    return {"margin": needs_margin(settings.k1, settings.k2)}


def draw(settings: Settings, outputs: Outputs) -> Frame:
    """The photograph, the grid, and the curve that the coefficients describe."""
    lens = Distortion(k1=settings.k1, k2=settings.k2)
    drawn: Drawings = outputs["drawings"]
    over = drawn.corrected if settings.correct else drawn.photograph
    bow = largest_bow_px(lens)
    return Frame(
        panels=(
            Panel(
                "picture",
                "The photograph",
                VIEW_WIDTH,
                VIEW_HEIGHT,
                outputs["encoded"],
                over,
                lead=True,
            ),
            Panel(
                "grid", "A straight grid and its image", VIEW_WIDTH, VIEW_HEIGHT, overlay=drawn.grid
            ),
            Panel(
                "profile", "How far from the centre", VIEW_WIDTH, VIEW_HEIGHT, overlay=drawn.profile
            ),
        ),
        readouts=_readouts(lens, bow),
        description=_description(lens, bow, settings.correct),
    )


def kind_of(lens: Distortion) -> str:
    """The kind of distortion over this picture, one of `KINDS`."""
    return classify(lens, HALF_DIAGONAL, INVISIBLE_PX / FOCAL_PX)


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


def _readouts(lens: Distortion, bow: float) -> tuple[Readout, ...]:
    shift, fold = corner_shift_px(lens), fold_radius(lens)
    corner = (
        Readout("corner", "Corners move", "past the fold", "", "error")
        if np.isnan(shift)
        else readout("corner", "Corners move", shift, "px", digits=1, role="ray")
    )
    return (
        Readout("kind", "Kind", kind_of(lens)),
        readout("bow", "Largest bow", bow, "px", digits=1, role="image"),
        corner,
        Readout("fold", "Fold radius", "none" if np.isinf(fold) else format_number(fold, 3)),
    )


def _description(lens: Distortion, bow: float, corrected: bool) -> str:
    kind, shift = kind_of(lens), corner_shift_px(lens)
    setting = f"k₁ = {format_number(lens.k1)}, k₂ = {format_number(lens.k2)}"
    if lens.neutral:
        return f"No distortion ({setting}): the grid is straight and the picture is a pinhole’s."
    what = {
        "none": "Distortion too small to see",
        "barrel": "Barrel distortion",
        "pincushion": "Pincushion distortion",
        "moustache": "Moustache distortion, inwards at some radii and outwards at others",
    }[kind]
    sentence = f"{what} ({setting}): straight lines bow by up to {format_number(bow, 1)} px"
    if np.isnan(shift):
        limit = format_number(largest_distorted_radius(lens), 2)
        sentence += (
            f", the corners lie past the fold, and beyond radius {limit} the model images nothing"
        )
    else:
        way = "inwards" if shift < 0 else "outwards"
        moves = f"move {format_number(abs(shift), 1)} px {way}" if abs(shift) > 0.05 else "stay"
        sentence += f" and the corners {moves}"
    return sentence + ("; the picture is corrected." if corrected else ".")


def estimate(settings: Settings, _outputs: Outputs, tier: str) -> Iterator[Readout]:
    """Error of the pixels' source points in the scene, in one step."""
    wrong = inversion_error_px(Distortion(k1=settings.k1, k2=settings.k2), tier)
    diverged = wrong > DIVERGED_PX
    text = "diverges" if diverged else format_magnitude(wrong, 1e-9)
    yield Readout("error", "RMS error of the inversion", text, "" if diverged else "px", "error")


SCENE = Scene(
    id="lens-distortion",
    title="Lens Distortion Simulator",
    settings=Settings,
    draw=draw,
    formula=distort,
    stages=STAGES,
    handles=HANDLES,
    photograph=PHOTOGRAPH_PX,
    parameters=parameters,
    tiers=TIERS,
    default_tier="closed-form",
    ladder="inverse-strong",
    estimate=estimate,
)
