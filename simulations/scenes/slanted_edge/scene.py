"""Slanted Edge: one picture of an edge, and the MTF measured from it."""

from simulations.engine.controls import Value
from simulations.engine.frame import Frame, Panel, format_number
from simulations.engine.handles import Handle, Point
from simulations.engine.photograph import Whole
from simulations.engine.scene import Scene
from simulations.engine.stages import Outputs
from simulations.models.sampling.slanted_edge import measure
from simulations.scenes.slanted_edge import drawing, rectangle
from simulations.scenes.slanted_edge.rectangle import HEIGHT, WIDTH
from simulations.scenes.slanted_edge.results import EXPORTS, per_mm, readouts, sheet
from simulations.scenes.slanted_edge.settings import Settings
from simulations.scenes.slanted_edge.stages import STAGES, Sharpness


def draw(settings: Settings, outputs: Outputs) -> Frame:
    """The picture, the light across the edge, and the contrast of waves."""
    sharpness: Sharpness = outputs["sharpness"]
    pixels, simulated = outputs["pixels"], outputs["photograph"] is None
    over = drawing.over_picture(settings, outputs["box"], pixels, simulated, sharpness.refusal)
    return Frame(
        panels=(
            Panel(
                "picture",
                "The picture of an edge",
                WIDTH,
                HEIGHT,
                outputs["shown"],
                drawing.kept_places(outputs["places"]) + over,
                pixelated=True,
                lead=True,
            ),
            Panel(
                "across",
                "Light across the edge",
                WIDTH,
                HEIGHT,
                overlay=drawing.light_across(pixels, sharpness.reading),
            ),
            Panel(
                "waves",
                "What is left of a wave’s contrast",
                WIDTH,
                HEIGHT,
                overlay=drawing.waves_left(sharpness, outputs["true"]),
            ),
        ),
        readouts=readouts(settings, outputs),
        description=describe(settings, outputs),
    )


def describe(settings: Settings, outputs: Outputs) -> str:
    """The measurement of the edge, or why there is none."""
    sharpness: Sharpness = outputs["sharpness"]
    if outputs["photograph"] is None:
        slant = (
            f"A soft edge between dark and light, slanted by {format_number(settings.angle, 1)}°"
        )
    else:
        slant = "A rectangle on a photograph"
    if sharpness.refusal:
        return f"{slant}, gives no MTF. {sharpness.refusal}"
    scale, half = per_mm(settings, outputs), sharpness.half
    found, error = (format_number(scale * value, 1) for value in (half.frequency, half.error))
    return f"{slant}: waves of {found} ± {error} cycles per mm keep half of their contrast."


def _end(settings: Settings, outputs: Outputs) -> Point | None:
    """The end of the simulated edge."""
    return None if outputs["photograph"] else drawing.edge_at(settings.angle, drawing.HANDLE_ROW)


def _end_pulled(_settings: Settings, place: Point) -> dict[str, Value]:
    return {"angle": drawing.angle_of(place[0])}


SCENE = Scene(
    id="slanted-edge",
    title="Slanted Edge",
    settings=Settings,
    draw=draw,
    formula=measure,
    stages=STAGES,
    handles=(
        Handle("end", "picture", "Edge", ("angle",), _end, _end_pulled, role="world"),
        *rectangle.HANDLES,
    ),
    photograph=Whole(24),
    exports=EXPORTS,
    sheet=sheet,
)
