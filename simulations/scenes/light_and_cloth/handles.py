"""Handles of the figure of a light on a cloth: the cloth's band, the surfaces, and the white."""

from collections.abc import Mapping

from simulations.engine.controls import Value
from simulations.engine.handles import Handle, Point
from simulations.engine.stages import Outputs
from simulations.scenes._spectra import patches
from simulations.scenes._spectra.axes import PLOT
from simulations.scenes._spectra.settings import LitSurface
from simulations.scenes.light_and_cloth import diagram, spectra

WITH_TEMPERATURE = ("planck", "daylight")


def _white(settings: LitSurface, outputs: Outputs) -> Point | None:
    if settings.light not in WITH_TEMPERATURE:
        return None
    return diagram.at(outputs["seen"].white_xy)


def _white_pulled(settings: LitSurface, place: Point) -> Mapping[str, Value]:
    return {"temperature": diagram.temperature_at(place, settings.light)}


def _band(settings: LitSurface, _outputs: Outputs) -> Point | None:
    return spectra.band_mark(settings.band) if settings.surface == "cloth" else None


def _band_pulled(_settings: LitSurface, place: Point) -> Mapping[str, Value]:
    return {"band": PLOT.values(place)[0]}


def _width(settings: LitSurface, _outputs: Outputs) -> Point | None:
    if settings.surface != "cloth":
        return None
    return spectra.width_mark(settings.band, settings.width)


def _width_pulled(settings: LitSurface, place: Point) -> Mapping[str, Value]:
    return {"width": spectra.width_at(place, settings.band)}


def _surface(settings: LitSurface, _outputs: Outputs) -> Point:
    return patches.middle(settings.surface)


def _surface_pulled(_settings: LitSurface, place: Point) -> Mapping[str, Value]:
    return {"surface": patches.surface_at(place)}


HANDLES: tuple[Handle[LitSurface], ...] = (
    Handle("band", "light", "Band of the cloth", ("band",), _band, _band_pulled, role="world"),
    Handle("width", "light", "Width of the band", ("width",), _width, _width_pulled, role="world"),
    Handle(
        "surface", "patches", "Surface", ("surface",), _surface, _surface_pulled, "press", "ray"
    ),
    Handle(
        "white",
        "diagram",
        "White of the light",
        ("temperature",),
        _white,
        _white_pulled,
        role="light",
        reversed=("temperature",),
    ),
)
