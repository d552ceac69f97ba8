"""Photon transfer: pairs of evenly lit frames, and the sensor measured from their noise."""

from simulations.engine.controls import Value
from simulations.engine.frame import Frame, Panel, format_number
from simulations.engine.handles import Handle, Point
from simulations.engine.photograph import Whole
from simulations.engine.scene import Scene
from simulations.engine.stages import Outputs
from simulations.models.sensor.photon_transfer_fit import SensorEstimate, characterise
from simulations.scenes.photon_transfer import drawing
from simulations.scenes.photon_transfer.reading import read
from simulations.scenes.photon_transfer.results import (
    EXPORTS,
    measured,
    readouts,
    sheet,
    with_error,
)
from simulations.scenes.photon_transfer.settings import Settings
from simulations.scenes.photon_transfer.stages import DRAFT, STAGES, Frames

SMALL = 0.1
"""Megapixels of the photograph that is looked at: it only chooses the pair."""


def draw(settings: Settings, outputs: Outputs) -> Frame:
    """Variance against mean, a pair of frames, and the pattern that both share."""
    frames: Frames = outputs["frames"]
    sensor: SensorEstimate = outputs["sensor"][frames.main]
    measured, pairs = outputs["levels"][frames.main], frames.planes[frames.main]
    simulated, shown = frames.is_simulated, outputs["shown"]
    return Frame(
        panels=(
            Panel(
                "transfer",
                "Noise of each pair, against its light",
                drawing.WIDTH,
                drawing.HEIGHT,
                overlay=drawing.transfer(measured, sensor, settings.most, shown, simulated),
                lead=True,
            ),
            Panel(
                "pair",
                "The ringed pair",
                drawing.PAIR_WIDTH,
                drawing.PAIR_HEIGHT,
                drawing.pair_pixels(pairs[shown] if shown >= 0 else None),
                drawing.over_pair() if shown >= 0 else "",
                pixelated=True,
            ),
            Panel(
                "pattern",
                "What both frames share",
                drawing.WIDTH,
                drawing.HEIGHT,
                overlay=drawing.pattern(measured, sensor, simulated),
            ),
        ),
        readouts=readouts(settings, outputs),
        description=describe(settings, outputs),
    )


def describe(settings: Settings, outputs: Outputs) -> str:
    """The gain from the pairs, or why there is none."""
    frames: Frames = outputs["frames"]
    sensor: SensorEstimate = outputs["sensor"][frames.main]
    what = f"{len(frames.names)} pairs of evenly lit frames"
    up_to = f"a line fitted up to {format_number(settings.most, 0)} % of the scale"
    if sensor.gain.reason:
        return f"{what}, and {up_to}, give no conversion gain. {sensor.gain.reason}"
    return f"{what}: {up_to} gives a conversion gain of {with_error(sensor.gain)} e⁻/DN."


def _end(settings: Settings, _outputs: Outputs) -> Point:
    return drawing.end_place(settings.most)


def _end_pulled(_settings: Settings, place: Point) -> dict[str, Value]:
    return {"most": drawing.end_of(place[0])}


SCENE = Scene(
    id="photon-transfer",
    title="A Sensor Measured by Its Noise",
    settings=Settings,
    draw=draw,
    formula=characterise,
    stages=STAGES,
    handles=(
        Handle(
            "end", "transfer", "End of the fit", ("most",), _end, _end_pulled, "press", "camera"
        ),
    ),
    photograph=Whole(SMALL, mosaic=True),
    read=read,
    own_drafts={DRAFT: ("pairs",)},
    exports=EXPORTS,
    sheet=sheet,
    measured=measured,
)
