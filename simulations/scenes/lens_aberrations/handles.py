"""Handles of the lens-aberrations figure: the stop, the edge of its opening and the rim, seen from
the side, and the ends of two curves."""

from collections.abc import Mapping

import numpy as np

from simulations.engine.controls import Value
from simulations.engine.handles import Handle, Point
from simulations.engine.stages import Outputs
from simulations.models.lens.vignetting import mechanical_vignetting
from simulations.scenes.lens_aberrations.colours import shifts_px
from simulations.scenes.lens_aberrations.drawing import (
    corner_light_mark,
    corner_light_marked,
    corner_shift_mark,
    corner_shift_marked,
)
from simulations.scenes.lens_aberrations.section import (
    millimetres,
    opening_mark,
    opening_mm,
    rim_mark,
    stop_mark,
)
from simulations.scenes.lens_aberrations.settings import Settings
from simulations.scenes.lens_aberrations.stages import FOCAL_MM, RIM_MM

RIMS_MM = np.linspace(0.0, 12.0, 25)
"""The steps of its slider."""


def _stop(settings: Settings, _outputs: Outputs) -> Point:
    return stop_mark(settings.stop)


def _stop_pulled(_settings: Settings, place: Point) -> Mapping[str, Value]:
    return {"stop": -millimetres(place)[0]}


def _opening(settings: Settings, _outputs: Outputs) -> Point:
    return opening_mark(settings.stop, settings.aperture)


def _opening_pulled(_settings: Settings, place: Point) -> Mapping[str, Value]:
    radius = max(-millimetres(place)[1], 1e-3)
    return {"aperture": FOCAL_MM / 2.0 / radius}


def _rim(settings: Settings, _outputs: Outputs) -> Point:
    return rim_mark(settings.stop, settings.rim)


def _rim_pulled(settings: Settings, place: Point) -> Mapping[str, Value]:
    return {"rim": -millimetres(place)[0] - settings.stop}


def _cut(settings: Settings, _outputs: Outputs) -> Point:
    share = mechanical_vignetting(1.0, opening_mm(settings.aperture), RIM_MM, settings.rim)
    return corner_light_mark(float(share))


def _cut_pulled(settings: Settings, place: Point) -> Mapping[str, Value]:
    """The rim for this share of light; of several, the nearest to the present one."""
    # At 45° the shift equals the distance, as the tangent is 1.
    shares = mechanical_vignetting(RIMS_MM, opening_mm(settings.aperture), RIM_MM, 1.0)
    off = np.abs(shares - np.clip(corner_light_marked(place[1]), 0.0, 1.0))
    as_good = RIMS_MM[off <= off.min() + 1e-9]
    return {"rim": float(as_good[np.abs(as_good - settings.rim).argmin()])}


def _blue(settings: Settings, _outputs: Outputs) -> Point | None:
    """The shift of blue in the corner, if the glass has dispersion."""
    if settings.glass == "ideal":
        return None
    return corner_shift_mark(float(shifts_px(settings.glass, settings.stop)[2]))


def _blue_pulled(settings: Settings, place: Point) -> Mapping[str, Value]:
    """Shifts are proportional to the distance of the stop."""
    per_mm = float(shifts_px(settings.glass, 1.0)[2])
    return {"stop": corner_shift_marked(place[1]) / per_mm} if per_mm else {}


HANDLES: tuple[Handle[Settings], ...] = (
    Handle("stop", "lens", "Aperture stop", ("stop",), _stop, _stop_pulled, reversed=("stop",)),
    Handle(
        "opening",
        "lens",
        "Edge of the opening",
        ("aperture",),
        _opening,
        _opening_pulled,
    ),
    Handle("rim", "lens", "Rim", ("rim",), _rim, _rim_pulled, role="camera", reversed=("rim",)),
    Handle(
        "cut",
        "profile",
        "What the rim leaves in the corner",
        ("rim",),
        _cut,
        _cut_pulled,
        role="camera",
        reversed=("rim",),
    ),
    Handle(
        "blue",
        "profile",
        "Shift of blue in the corner",
        ("stop",),
        _blue,
        _blue_pulled,
        role="image",
        reversed=("stop",),
    ),
)
