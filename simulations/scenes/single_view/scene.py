"""Distances from One Picture: lines drawn over it, a camera, and lengths."""

from simulations.engine.export import Export
from simulations.engine.frame import Frame, Panel, Readout
from simulations.engine.photograph import Whole
from simulations.engine.scene import Scene
from simulations.engine.stages import Outputs
from simulations.models.projection.single_view import fit_view
from simulations.scenes.single_view.drawing import in_loupe, over_field, over_picture
from simulations.scenes.single_view.fields import HEIGHT, WIDTH
from simulations.scenes.single_view.handles import HANDLES
from simulations.scenes.single_view.results import as_json, readouts, sheet
from simulations.scenes.single_view.settings import Settings
from simulations.scenes.single_view.stages import STAGES, Found


def draw(settings: Settings, outputs: Outputs) -> Frame:
    """The picture with the lines, the image plane around it, and the loupe."""
    lines, found, lengths = (outputs[name] for name in ("lines", "view", "lengths"))
    field, numbers = outputs["field"], readouts(settings, outputs)
    return Frame(
        panels=(
            Panel(
                "picture",
                "Lines over the picture",
                WIDTH,
                HEIGHT,
                outputs["boxed"],
                over_picture(settings, lines, found, lengths),
                lead=True,
            ),
            Panel(
                "field",
                "Where they meet",
                WIDTH,
                HEIGHT,
                outputs["wide"],
                over_field(settings, lines, found, field),
            ),
            Panel(
                "loupe",
                "Around the end moved last",
                WIDTH,
                HEIGHT,
                outputs["loupe"],
                in_loupe(lines, settings),
                pixelated=True,
            ),
        ),
        readouts=numbers,
        description=_description(numbers, outputs),
    )


def _description(numbers: tuple[Readout, ...], outputs: Outputs) -> str:
    found: Found = outputs["view"]
    counts = [len(outputs["lines"].counted(axis)) for axis in range(3)]
    drawn = f"{counts[0]} lines across, {counts[1]} along and {counts[2]} upright"
    if found.view is None:
        return f"A picture with {drawn}. {found.problem}"
    shown = {each.name: f"{each.text} {each.unit}".strip() for each in numbers}
    return (
        f"A picture with {drawn}. Focal length: {shown['focal']}; the camera looks down by "
        f"{shown['pitch']}. Length on the plane: {shown['length']}; height above it: "
        f"{shown['height']}."
    )


SCENE = Scene(
    id="single-view",
    title="Distances from One Picture",
    settings=Settings,
    draw=draw,
    formula=fit_view,
    stages=STAGES,
    handles=HANDLES,
    photograph=Whole(24),
    sheet=sheet,
    exports=(Export("distances", "Distances as JSON", ".json", as_json),),
)
