"""Lens Distortion Simulator: a grid and a picture through a lens with k₁ and k₂."""

from collections.abc import Iterator

import numpy as np

from simulations.engine.controls import Choice, Slider, Toggle, Value, Values
from simulations.engine.frame import Frame, Panel, Readout, format_magnitude, format_number, readout
from simulations.engine.scene import Scene
from simulations.engine.stages import StageCache, run
from simulations.models.distortion.kinds import classify, line_bow
from simulations.models.distortion.lens_model import (
    Distortion,
    distort,
    fold_radius,
    largest_distorted_radius,
)
from simulations.models.distortion.radial_profile import evaluate
from simulations.scenes.lens_distortion.drawing import VIEW_HEIGHT, VIEW_WIDTH, Drawings, grid_lines
from simulations.scenes.lens_distortion.stages import (
    DEFAULT_TIER,
    FOCAL_PX,
    HALF_DIAGONAL,
    STAGES,
    TIERS,
    inversion_error_px,
    needs_margin,
)

DIVERGED_PX = 1e4
"""An iteration that ends this far off has found nothing."""
INVISIBLE_PX = 0.1
"""Changes of the magnification that move no corner by more than this do not count."""


def render(values: Values, tier: str, cache: StageCache) -> Frame:
    """The figure at one setting of its controls; the tier is how the picture's rays are found."""
    lens = Distortion(k1=values.number("k1"), k2=values.number("k2"))
    corrected = values.toggle("correct")
    extra: dict[str, Value] = {"tier": tier or DEFAULT_TIER, "margin": needs_margin(values)}
    outcome = run(STAGES, values, cache, extra)
    drawn: Drawings = outcome.outputs["drawings"]
    over = drawn.corrected if corrected else drawn.photograph
    raster = outcome.outputs["encoded"]
    panels = (
        Panel("grid", "Grid", VIEW_WIDTH, VIEW_HEIGHT, overlay=drawn.grid),
        Panel("picture", "Picture", VIEW_WIDTH, VIEW_HEIGHT, raster=raster, overlay=over),
        Panel("profile", "Radius", VIEW_WIDTH, VIEW_HEIGHT, overlay=drawn.profile),
    )
    bow = largest_bow_px(lens)
    return Frame(panels, _readouts(lens, bow), _description(lens, bow, corrected), outcome.reports)


def kind_of(lens: Distortion) -> str:
    """The kind of distortion over this picture, one of `KINDS`."""
    return classify(lens, HALF_DIAGONAL, INVISIBLE_PX / FOCAL_PX)


def largest_bow_px(lens: Distortion) -> float:
    """How far the worst line of the grid leaves its chord, as far as it lies inside the fold."""
    fold, largest = fold_radius(lens), 0.0
    for ideal in grid_lines():
        inside = np.hypot(ideal[:, 0], ideal[:, 1]) < fold
        if inside.sum() > 2:
            largest = max(largest, float(line_bow(distort(ideal[inside], lens))))
    return largest * FOCAL_PX


def corner_shift_px(lens: Distortion) -> float:
    """How far the corners move away from the centre, in px; NaN where they lie past the fold."""
    if fold_radius(lens) <= HALF_DIAGONAL:
        return float("nan")
    return float(evaluate(lens.radial, HALF_DIAGONAL) - HALF_DIAGONAL) * FOCAL_PX


def error(values: Values, tier: str, _cache: StageCache) -> Iterator[Readout]:
    """How far off, in the scene, the pixels are drawn from; found at once."""
    wrong = inversion_error_px(Distortion(k1=values.number("k1"), k2=values.number("k2")), tier)
    if wrong > DIVERGED_PX:
        yield Readout("error", "RMS error of the inversion", "diverges", "", "error")
    else:
        text = format_magnitude(wrong, 1e-9)
        yield Readout("error", "RMS error of the inversion", text, "px", "error")


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


SCENE = Scene(
    id="lens-distortion",
    title="Lens Distortion Simulator",
    controls=(
        Slider(name="k1", label="k₁", default=0.0, minimum=-0.5, maximum=0.5, step=0.01),
        Slider(name="k2", label="k₂", default=0.0, minimum=-0.2, maximum=0.2, step=0.01),
        Choice(
            name="picture",
            label="Picture",
            default="room",
            options={"room": "Room", "chart": "Test chart"},
        ),
        Toggle(name="correct", label="Correct the picture"),
    ),
    render=render,
    tiers=TIERS,
    default_tier=DEFAULT_TIER,
    draft_tier=DEFAULT_TIER,
    ladder="inverse-strong",
    error=error,
)
