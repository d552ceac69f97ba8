"""The handle of the figure of a sensor's colours: the surface."""

from collections.abc import Mapping

from simulations.engine.controls import Value
from simulations.engine.handles import Handle, Point
from simulations.engine.stages import Outputs
from simulations.scenes._spectra import patches
from simulations.scenes.spectrum_to_rgb.settings import Settings


def _surface(settings: Settings, _outputs: Outputs) -> Point:
    return patches.middle(settings.surface)


def _surface_pulled(_settings: Settings, place: Point) -> Mapping[str, Value]:
    return {"surface": patches.surface_at(place)}


HANDLES: tuple[Handle[Settings], ...] = (
    Handle(
        "surface", "patches", "Surface", ("surface",), _surface, _surface_pulled, "press", "ray"
    ),
)
