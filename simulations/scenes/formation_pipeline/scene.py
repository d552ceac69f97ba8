"""Image Formation Pipeline: one point on its way from the scene to a pixel value."""

from simulations.engine.controls import Action, Slider, Values
from simulations.engine.frame import Frame, Panel, Readout, readout
from simulations.engine.scene import Scene
from simulations.engine.stages import Stage, StageCache, run
from simulations.scenes.formation_pipeline.drawing import HEIGHT, WIDTH, draw_ledger, draw_way
from simulations.scenes.formation_pipeline.stations import Journey, stations, travel

LAST_STATION = 7.0

CONTROLS = (
    Slider(
        name="station",
        label="Station",
        default=0.0,
        minimum=0.0,
        maximum=LAST_STATION,
        step=0.02,
    ),
    Action(name="play", labels=("Play", "Pause"), drives="station", effect="play", seconds=14.0),
    Action(name="step", labels=("Step",), drives="station", effect="step"),
    Action(name="reset", labels=("Reset",), drives="station", effect="reset"),
    Slider(
        name="distance",
        label="Distance of the point",
        default=4.0,
        minimum=2.0,
        maximum=8.0,
        step=0.1,
        unit="m",
    ),
    Slider(name="albedo", label="Albedo ρ", default=0.6, minimum=0.0, maximum=1.0, step=0.01),
    Action(name="again", labels=("Take it again",) * 8),
)


def _travel(distance: float, albedo: float, again: int) -> Journey:
    return travel(distance, albedo, exposure=again)


STAGES = (Stage("journey", _travel),)
"""Moving the marker computes nothing anew: the numbers do not depend on where it is."""


def render(values: Values, _tier: str, cache: StageCache) -> Frame:
    """The way of the point and the ledger of its numbers, up to the current station."""
    result = run(STAGES, values, cache)
    journey: Journey = result.outputs["journey"]
    station = values.number("station")
    entries = stations(journey)
    entry = entries[int(station)]
    way = draw_way(journey, values.number("distance"), station)
    return Frame(
        panels=(
            Panel("way", "The way (not to scale)", WIDTH, HEIGHT, overlay=way),
            Panel("ledger", "What is known", WIDTH, HEIGHT, overlay=draw_ledger(entries, station)),
        ),
        readouts=(
            Readout("at", "Station", f"{int(station)} · {entry.title}", role=entry.role),
            readout(
                "electrons", "Electrons counted", journey.counted_e, "e⁻", digits=0, role="error"
            ),
            readout("pixel_value", "Pixel value", journey.code, "of 255", digits=0, role="image"),
        ),
        description=f"{entry.sentence}: {entry.numbers}.",
        stages=result.reports,
    )


SCENE = Scene(
    id="formation-pipeline", title="Image Formation Pipeline", controls=CONTROLS, render=render
)
