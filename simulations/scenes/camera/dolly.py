"""The dolly zoom: the camera steps back and zooms in, so that one thing keeps its size.

The focus stays on the same thing. The sliders are for the lens and the focus before the step.
"""

from dataclasses import replace

from simulations.pictures.still_life.things import THINGS, thing_depth
from simulations.scenes._still_life_camera.rays import principal_mm
from simulations.scenes.camera.settings import Settings

SUBJECT_M = thing_depth(next(thing for thing in THINGS if thing.name == "striped ball"))
"""Depth before the step of the thing that keeps its size."""


def after_step(settings: Settings) -> Settings:
    """The settings with the focal length and the focus that the camera has after its step."""
    if not settings.back:
        return settings
    focus = settings.focus + settings.back
    principal = principal_mm(settings.focal_length, settings.focus) * (
        1 + settings.back / SUBJECT_M
    )
    return replace(settings, focal_length=focal_length(principal, focus), focus=focus)


def focal_before_step(principal: float, focus: float, back: float) -> float:
    """The focal length in millimetres at which the step ends with a sensor ``principal`` away.

    ``focus`` is the distance before the step.
    """
    return focal_length(principal / (1 + back / SUBJECT_M), focus)


def focal_length(principal: float, focus: float) -> float:
    """The inverse of `principal_mm`: 1/f = 1/z + 1/s, of millimetres and metres."""
    return 1.0 / (1.0 / principal + 1.0 / (1000.0 * focus))
