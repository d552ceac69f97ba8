"""Image Formation Pipeline: one point from the scene to a pixel value."""

from simulations.engine.frame import Frame, Panel, readout
from simulations.engine.scene import Scene
from simulations.engine.stages import Outputs, Stage
from simulations.scenes.formation_pipeline.drawing import (
    HEIGHT,
    LEDGER_HEIGHT,
    LEDGER_WIDTH,
    WIDTH,
    draw_ledger,
    draw_way,
)
from simulations.scenes.formation_pipeline.handles import HANDLES
from simulations.scenes.formation_pipeline.settings import Settings
from simulations.scenes.formation_pipeline.stations import Journey, stations, travel


def _travel(distance: float, albedo: float, again: int) -> Journey:
    return travel(distance, albedo, exposure=again)


STAGES = (Stage("journey", _travel),)
"""The numbers do not depend on the marker's place."""


def draw(settings: Settings, outputs: Outputs) -> Frame:
    """The path of the point and the ledger of its numbers, up to the current station."""
    journey: Journey = outputs["journey"]
    station = settings.station
    entries = stations(journey)
    entry = entries[int(station)]
    way = draw_way(journey, settings.distance, station)
    ledger = draw_ledger(entries, station)
    return Frame(
        panels=(
            Panel(
                "way",
                "The way of the light (not to scale)",
                WIDTH,
                HEIGHT,
                overlay=way,
                lead=True,
            ),
            Panel(
                "ledger",
                "What is known after each step",
                LEDGER_WIDTH,
                LEDGER_HEIGHT,
                overlay=ledger,
            ),
        ),
        readouts=(
            readout(
                "electrons", "Electrons counted", journey.counted_e, "e⁻", digits=0, role="error"
            ),
            readout("pixel_value", "Pixel value", journey.code, "of 255", digits=0, role="image"),
        ),
        description=f"{entry.sentence}: {entry.numbers}.",
    )


SCENE = Scene(
    id="formation-pipeline",
    title="Image Formation Pipeline",
    settings=Settings,
    draw=draw,
    stages=STAGES,
    handles=HANDLES,
)
