"""From Snell to the Thin Lens: rays through real glass, and in simpler models."""

import math
from collections.abc import Iterator

import numpy as np

from simulations.engine.frame import (
    Frame,
    Panel,
    Readout,
    format_magnitude,
    format_number,
    readout,
)
from simulations.engine.scene import Scene
from simulations.engine.stages import Outputs
from simulations.models.lens.singlet import (
    PASSES,
    Rays,
    focal_mm,
    power_per_mm,
    refract,
    thin_power_per_mm,
)
from simulations.scenes.real_lens import plots, section
from simulations.scenes.real_lens.handles import HANDLES
from simulations.scenes.real_lens.settings import Settings
from simulations.scenes.real_lens.stages import STAGES, TIERS, Glass, fan_heights

FLATTEST = 1e-9
"""Power per mm below which a lens counts as a pane: a focal length of a thousand kilometres."""


def draw(settings: Settings, outputs: Outputs) -> Frame:
    """The lens and its rays, the rays close to the image, and where each crosses the axis."""
    glass: Glass = outputs["glass"]
    fan, marked, true = (outputs[name] for name in ("fan", "marked", "true"))
    heights = fan_heights(settings.opening)
    width, height = section.WIDTH, section.HEIGHT
    shown = plots.aberration(glass, outputs["curve"], settings.height, marked, settings.opening)
    passing = None if section.stopped(settings, marked) else marked
    return Frame(
        panels=(
            Panel(
                "lens",
                "The lens from the side",
                width,
                height,
                overlay=section.draw(settings, glass, fan, marked, heights),
                lead=True,
            ),
            Panel(
                "close",
                "Close to the image, heights enlarged",
                width,
                height,
                overlay=plots.close(glass, fan, passing),
            ),
            Panel("aberration", "Where rays cross the axis", width, height, overlay=shown),
        ),
        readouts=_readouts(settings, glass, true),
        description=describe(settings, glass, true),
    )


def _readouts(settings: Settings, glass: Glass, true: Rays) -> tuple[Readout, ...]:
    """The readouts that do not depend on the tier."""
    thin, thick = thin_power_per_mm(glass.lens), power_per_mm(glass.lens)
    crossing = float(true.crossing_mm[0])
    off = crossing - glass.paraxial_mm if glass.real else math.nan
    reason = _reason(settings, true)
    return (
        readout("focal_thin", "f, thin lens", _focal(thin), "mm"),
        readout("focal", "f, thick lens", _focal(thick), "mm", role="image"),
        _place("thin_at", "Thin lens: image at", glass.thin_mm, ""),
        _place("thick_at", "Thick lens: image at", glass.paraxial_mm, "image"),
        _or_reason("true_at", "The ray crosses at", reason, crossing, "ray"),
        _or_reason("aberration", "Spherical aberration", reason, off, "error"),
        _angle("incidence", "Ray meets the front at", glass, true, inside=False),
        _angle("refracted", "… and goes on at", glass, true, inside=True),
    )


def _focal(power: float) -> float:
    return focal_mm(power if abs(power) > FLATTEST else 0.0)


def _place(name: str, label: str, along_mm: float, role: str) -> Readout:
    """The image distance, or a text if there is no real image."""
    if not abs(along_mm) < 1.0 / FLATTEST:
        return Readout(name, label, "∞", "", role)
    if along_mm < 0.0:
        return Readout(name, label, "virtual", "", role)
    return readout(name, label, along_mm, "mm", role=role)


def _reason(settings: Settings, true: Rays) -> str:
    """Why the marked ray does not get through; empty if it does."""
    if section.stopped(settings, true):
        return section.STOPPED
    return "" if true.fate[0] == PASSES else section.FATES[int(true.fate[0])]


def _or_reason(name: str, label: str, reason: str, value: float, role: str) -> Readout:
    """A number, or the reason why there is none."""
    if reason:
        return Readout(name, label, reason, "", role)
    if not math.isfinite(value) or abs(value) > 1.0 / FLATTEST:
        return Readout(name, label, "none", "", role)
    return readout(name, label, value, "mm", role=role)


def _angle(name: str, label: str, glass: Glass, true: Rays, *, inside: bool) -> Readout:
    """Angles of the marked ray with the normal of the front surface, in degrees."""
    degrees = front_angles(glass, true)[int(inside)]
    if math.isnan(degrees):
        return Readout(name, label, "none", "", "ray")
    return readout(name, label, degrees, "°", digits=1, role="ray")


def front_angles(glass: Glass, true: Rays) -> tuple[float, float]:
    """Angles of incidence and refraction at the front, by Snell's law; NaN for a ray that
    misses."""
    place = true.front[0]
    if not math.isfinite(place[0]):
        return math.nan, math.nan
    c, vertex = glass.lens.front_per_mm, -glass.lens.thickness_mm / 2.0
    normal = np.array([1.0 - c * (place[0] - vertex), -c * place[1]])
    start = 0.0 if math.isinf(glass.distance_mm) else glass.distance_mm
    along = np.array([1.0, 0.0]) if not start else place + np.array([start, 0.0])
    sine = abs(normal[0] * along[1] - normal[1] * along[0]) / math.hypot(*along)
    angles = [math.degrees(math.asin(min(value, 1.0))) for value in (sine, sine / glass.lens.index)]
    return angles[0], angles[1]


def describe(settings: Settings, glass: Glass, true: Rays) -> str:
    """The result for the marked ray, compared with the simple models."""
    ray = f"A ray at a height of {format_number(settings.height, 1)} mm"
    if section.stopped(settings, true):
        return f"{ray} is {section.STOPPED}, half of which is smaller."
    if true.fate[0] != PASSES:
        return f"{ray} {_FAILED[int(true.fate[0])]}."
    crossing = float(true.crossing_mm[0])
    if not glass.real or not 0.0 < crossing < math.inf:
        return f"{ray} leaves the lens without crossing the axis behind it as an image would need."
    thin = ""
    if math.isfinite(glass.thin_mm):
        thin = f", and the thin lens {format_number(glass.thin_mm, 1)} mm"
    return (
        f"{ray} crosses the axis {format_number(crossing, 1)} mm behind the lens’s middle; "
        f"rays close to the axis meet at {format_number(glass.paraxial_mm, 1)} mm{thin}."
    )


_FAILED = {
    fate: {"totally reflected": "is totally reflected at the back of the lens"}.get(words, words)
    for fate, words in section.FATES.items()
}


def estimate(_settings: Settings, outputs: Outputs, _tier: str) -> Iterator[Readout]:
    """Error of the marked ray's crossing of the axis in this tier, in one step."""
    true, shown = (float(outputs[name].crossing_mm[0]) for name in ("true", "marked"))
    label = "The marked ray crosses too far off by"
    if math.isfinite(true - shown):
        yield Readout("error", label, format_magnitude(abs(true - shown), 1e-9), "mm", "error")
    else:
        yield Readout("error", label, "no crossing to compare", "", "error")


SCENE = Scene(
    id="real-lens",
    title="From Snell to the Thin Lens",
    settings=Settings,
    draw=draw,
    formula=refract,
    stages=STAGES,
    handles=HANDLES,
    tiers=tuple(TIERS),
    default_tier="exact",
    tier_labels=TIERS,
    estimate=estimate,
)
