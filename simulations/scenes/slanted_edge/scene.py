"""Slanted Edge: one picture of an edge, and the MTF measured from it."""

import numpy as np

from simulations.engine.controls import Value
from simulations.engine.frame import Frame, Panel, Readout, format_number, readout
from simulations.engine.handles import Handle, Point
from simulations.engine.raster import to_rgba8
from simulations.engine.scene import Scene
from simulations.engine.stages import Outputs
from simulations.models.arrays import Floats
from simulations.models.color.srgb import encode_srgb
from simulations.models.sampling.slanted_edge import read_edge
from simulations.models.sensor.resolution import first_fall
from simulations.scenes.slanted_edge import drawing
from simulations.scenes.slanted_edge.settings import Settings
from simulations.scenes.slanted_edge.stages import FREQUENCIES, STAGES

PER_MM = "cycles/mm"


def draw(settings: Settings, outputs: Outputs) -> Frame:
    """The picture, the light across the edge, and the contrast of waves."""
    picture, reading = outputs["picture"], outputs["reading"]
    width, height = drawing.WIDTH, drawing.HEIGHT
    row = picture[drawing.MIDDLE_ROW]
    return Frame(
        panels=(
            Panel(
                "picture",
                "The picture of an edge",
                width,
                height,
                to_rgba8(encode_srgb(np.clip(picture, 0.0, 1.0))),
                drawing.over_picture(settings.angle),
                pixelated=True,
                lead=True,
            ),
            Panel(
                "across",
                "Light across the edge",
                width,
                height,
                overlay=drawing.light_across(reading, row, settings.angle),
            ),
            Panel(
                "waves",
                "What is left of a wave’s contrast",
                width,
                height,
                overlay=drawing.waves_left(outputs["measured"], outputs["true"]),
            ),
        ),
        readouts=(
            _mtf50(
                "measured", "MTF50, from the edge", outputs["measured"], settings.pitch, "image"
            ),
            _mtf50("true", "MTF50, lens × pixel", outputs["true"], settings.pitch, "ray"),
        ),
        description=describe(settings, outputs["measured"], outputs["true"]),
    )


def _mtf50(name: str, label: str, left: Floats, pitch: float, role: str) -> Readout:
    if np.isnan(left).any():
        return Readout(name, label, "not measurable", "", role)
    half = 1000.0 / pitch * first_fall(FREQUENCIES, left, 0.5)
    return readout(name, label, half, PER_MM, digits=1, role=role)


def describe(settings: Settings, measured: Floats, true: Floats) -> str:
    """The measurement of the edge, or why there is none."""
    slant = f"A soft edge between dark and light, slanted by {format_number(settings.angle, 1)}°"
    if np.isnan(measured).any():
        return f"{slant}: too many rows meet it at the same place, so the picture gives no MTF."
    found, formula = (
        format_number(1000.0 / settings.pitch * first_fall(FREQUENCIES, left, 0.5), 0)
        for left in (measured, true)
    )
    return (
        f"{slant}: by this picture, waves of {found} cycles per mm keep half of their contrast; "
        f"by the formulae of lens and pixel, {formula}."
    )


def _end(settings: Settings, _outputs: Outputs) -> Point:
    return drawing.edge_at(settings.angle, drawing.HANDLE_ROW)


def _end_pulled(_settings: Settings, place: Point) -> dict[str, Value]:
    return {"angle": drawing.angle_of(place[0])}


SCENE = Scene(
    id="slanted-edge",
    title="Slanted Edge",
    settings=Settings,
    draw=draw,
    formula=read_edge,
    stages=STAGES,
    handles=(Handle("end", "picture", "Edge", ("angle",), _end, _end_pulled, role="world"),),
)
