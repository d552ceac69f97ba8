"""From Snell to the Thin Lens: rays through real glass, and in simpler models.

The rays drawn are those of the tier's model; the readouts are of Snell's law.
"""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from simulations.engine.accuracy import Accuracy, tiers
from simulations.engine.frame import (
    Frame,
    Panel,
    Raster,
    Readout,
    format_magnitude,
    format_number,
    readout,
)
from simulations.engine.handles import Handle
from simulations.engine.scene import Scene
from simulations.engine.settings import slider
from simulations.engine.stages import Outputs, Stage
from simulations.models.arrays import Floats
from simulations.models.lens import singlet
from simulations.scenes.real_lens import drawing
from simulations.scenes.real_lens.drawing import FATES, HEIGHT, HEIGHTS_MM, STOPPED, WIDTH, Glass

LARGEST_MM = 22.0  # half the lens's height, unless its surfaces meet before
FLATTEST = 1e-9
"""Power per mm below which a lens counts as a pane: a focal length of a thousand kilometres."""
TIERS = {
    "thin": "Thin lens: one bend",
    "paraxial": "Thick lens, small angles",
    "exact": "Snell’s law at both spheres",
}


@dataclass(frozen=True, slots=True)
class Settings:
    height: float = slider("Height h of the ray", 10, 0.5, 20, 0.5, unit="mm")
    front: float = slider("Front bulge 1/R₁", 25, -20, 40, 1, unit="/m")
    back: float = slider("Back bulge 1/R₂", 25, -20, 40, 1, unit="/m")
    index: float = slider("Index n", 1.5, 1.3, 2, 0.01)
    thickness: float = slider("Thickness d", 10, 2, 20, 0.5, unit="mm")
    opening: float = slider("Half opening", 14, 2, 20, 0.5, unit="mm")
    vergence: float = slider("Object at 1/Z", 0, 0, 22, 0.5, unit="/m")


def object_mm(vergence: float) -> float:
    """The object's distance from its reciprocal in 1/m: infinite for 0."""
    return 1000.0 / vergence if vergence else math.inf


def glass_of(front: float, back: float, index: float, thickness: float, vergence: float) -> Glass:
    # Curvatures of the settings are positive outwards, per metre.
    lens = singlet.Singlet(front / 1000.0, -back / 1000.0, thickness, index)
    far = object_mm(vergence)
    images = singlet.thin_image_mm(lens, far), singlet.paraxial_image_mm(lens, far)
    return Glass(lens, singlet.rim_mm(lens, LARGEST_MM), far, *images)


def trace(tier: str, glass: Glass, heights_mm: Floats) -> singlet.Rays:
    """Rays (n,) by the model of one tier."""
    simple: dict[str, Callable[[singlet.Singlet, float, Floats], singlet.Rays]] = {
        "thin": singlet.through_thin,
        "paraxial": singlet.through_paraxial,
    }
    if tier in simple:
        return simple[tier](glass.lens, glass.distance_mm, heights_mm)
    return singlet.through_exact(glass.lens, glass.distance_mm, heights_mm, LARGEST_MM)


def fan_rays(glass: Glass, opening: float, tier: str) -> singlet.Rays:
    return trace(tier, glass, drawing.fan_heights(opening))


def spot_of(glass: Glass, opening: float, tier: str) -> Raster:
    """The picture of the object on a sheet at the image."""
    heights = opening * (np.arange(drawing.RINGS) + 0.5) / drawing.RINGS
    return drawing.spot(glass, trace(tier, glass, heights), heights)


def marked_ray(glass: Glass, height: float, tier: str) -> singlet.Rays:
    return trace(tier, glass, np.array([height]))


def true_ray(glass: Glass, height: float) -> singlet.Rays:
    """The marked ray by Snell's law."""
    return trace("exact", glass, np.array([height]))


def crossings(glass: Glass) -> Floats:
    """(n,) where rays at `HEIGHTS_MM` cross the axis; NaN where they do not."""
    return trace("exact", glass, HEIGHTS_MM).crossing_mm


STAGES = (
    Stage("glass", glass_of),
    Stage("fan", fan_rays, ("glass",)),
    Stage("spot", spot_of, ("glass",)),
    Stage("marked", marked_ray, ("glass",)),
    Stage("true", true_ray, ("glass",)),
    Stage("curve", crossings, ("glass",)),
)


def front_angles(glass: Glass, true: singlet.Rays) -> tuple[float, float]:
    """Angles of incidence and refraction of the marked ray with the normal of the front, by
    Snell's law, in degrees; NaN for a ray that misses."""
    place = true.front[0]
    if not math.isfinite(place[0]):
        return math.nan, math.nan
    c, vertex = glass.lens.front_per_mm, -glass.lens.thickness_mm / 2.0
    normal = np.array([1.0 - c * (place[0] - vertex), -c * place[1]])
    start = 0.0 if math.isinf(glass.distance_mm) else glass.distance_mm
    along = np.array([1.0, 0.0]) if not start else place + np.array([start, 0.0])
    sine = abs(normal[0] * along[1] - normal[1] * along[0]) / math.hypot(*along)
    outside, inside = (math.asin(min(value, 1.0)) for value in (sine, sine / glass.lens.index))
    return math.degrees(outside), math.degrees(inside)


def draw(settings: Settings, outputs: Outputs) -> Frame:
    glass: Glass = outputs["glass"]
    fan, marked, true = (outputs[name] for name in ("fan", "marked", "true"))
    height, opening = settings.height, settings.opening
    passing = None if drawing.is_stopped(height, opening, marked) else marked
    side = drawing.from_side(glass, fan, marked, height, opening)
    over = drawing.over_spot(glass, passing)
    crossing = drawing.aberration(glass, outputs["curve"], height, marked, opening)
    size = WIDTH, HEIGHT
    return Frame(
        (
            Panel("lens", "The lens from the side", *size, overlay=side, lead=True),
            Panel(
                "spot", "A star on a sheet at the thick lens’s image", *size, outputs["spot"], over
            ),
            Panel("aberration", "Where rays cross the axis", *size, overlay=crossing),
        ),
        tuple(readouts(settings, glass, true)),
        describe(settings, glass, true),
    )


def readouts(settings: Settings, glass: Glass, true: singlet.Rays) -> Iterator[Readout]:
    """The readouts, none of which depends on the tier."""
    thin, thick = (
        singlet.focal_mm(power if abs(power) > FLATTEST else 0.0)
        for power in (singlet.thin_power_per_mm(glass.lens), singlet.power_per_mm(glass.lens))
    )
    yield readout("focal_thin", "F, thin lens", thin, "mm")
    yield readout("focal", "F, thick lens", thick, "mm", role="image")
    places = (
        ("thin_at", "Thin lens: image at", glass.thin_mm, ""),
        ("thick_at", "Thick lens: image at", glass.paraxial_mm, "image"),
    )
    for name, label, along, role in places:
        word = "" if is_finite(along) and along >= 0.0 else "virtual" if is_finite(along) else "∞"
        yield readout_or_word(word, name, label, along, role)
    crossing = float(true.crossing_mm[0])
    off = crossing - glass.paraxial_mm if glass.real else math.nan
    why = FATES.get(int(true.fate[0]), "")
    if drawing.is_stopped(settings.height, settings.opening, true):
        why = STOPPED
    for name, label, value, role in (
        ("true_at", "The ray crosses at", crossing, "ray"),
        ("aberration", "Spherical aberration", off, "error"),
    ):
        yield readout_or_word(why or ("" if is_finite(value) else "none"), name, label, value, role)
    outside, inside = front_angles(glass, true)
    word = "none" if math.isnan(outside) else ""
    yield readout_or_word(word, "incidence", "Ray meets the front at", outside, "ray", "°", 1)
    yield readout_or_word(word, "refracted", "… and goes on at", inside, "ray", "°", 1)


def is_finite(length_mm: float) -> bool:
    return abs(length_mm) <= 1.0 / FLATTEST


def readout_or_word(
    word: str, name: str, label: str, value: float, role: str, unit: str = "mm", digits: int = 2
) -> Readout:
    """A number, or the word that says why there is none."""
    if word:
        return Readout(name, label, word, "", role=role)
    return readout(name, label, value, unit, digits=digits, role=role)


def describe(settings: Settings, glass: Glass, true: singlet.Rays) -> str:
    ray = f"A ray at a height of {format_number(settings.height, 1)} mm"
    if drawing.is_stopped(settings.height, settings.opening, true):
        return f"{ray} is {STOPPED}: half of it is smaller than that height."
    fate = int(true.fate[0])
    if fate == singlet.REFLECTED:
        return f"{ray} is totally reflected at the back of the lens."
    if fate != singlet.PASSES:
        return f"{ray} {FATES[fate]}."
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


def estimate(_settings: Settings, outputs: Outputs, _tier: str) -> Iterator[Readout]:
    """Error of the marked ray's crossing of the axis in this tier, in one step."""
    true, computed = (float(outputs[name].crossing_mm[0]) for name in ("true", "marked"))
    label, off = "The marked ray’s crossing is off by", abs(true - computed)
    if math.isfinite(off):
        yield Readout("error", label, format_magnitude(off, 1e-9), "mm", role="error")
    else:
        yield Readout("error", label, "no crossing to compare", "", role="error")


def ray_at(settings: Settings, _outputs: Outputs) -> tuple[float, float]:
    return drawing.entry_mark(object_mm(settings.vergence), settings.height)


def front_at(settings: Settings, _outputs: Outputs) -> tuple[float, float]:
    far = object_mm(settings.vergence)
    return drawing.surface_mark(far, settings.front, settings.thickness, front=True)


def back_at(settings: Settings, _outputs: Outputs) -> tuple[float, float]:
    far = object_mm(settings.vergence)
    return drawing.surface_mark(far, settings.back, settings.thickness, front=False)


def object_at(settings: Settings, _outputs: Outputs) -> tuple[float, float] | None:
    return drawing.object_mark(object_mm(settings.vergence))


def opening_at(settings: Settings, _outputs: Outputs) -> tuple[float, float]:
    return drawing.opening_mark(settings.opening)


def curve_at(settings: Settings, outputs: Outputs) -> tuple[float, float]:
    return drawing.curve_mark(outputs["glass"], outputs["marked"], settings.height)


BACK, VERGENCE = ("back",), ("vergence",)
HANDLES: tuple[Handle[Settings], ...] = (
    Handle("ray", "lens", "Marked ray", ("height",), ray_at, role="ray"),
    Handle("front", "lens", "Front surface", ("front",), front_at, role="camera"),
    Handle("back", "lens", "Back surface", BACK, back_at, role="camera", reversed=BACK),
    Handle("object", "lens", "Object", VERGENCE, object_at, role="world", reversed=VERGENCE),
    Handle("opening", "aberration", "Edge of the opening", ("opening",), opening_at),
    Handle(
        "curve",
        "aberration",
        "Marked ray",
        drives=("height",),
        at=curve_at,
        # Not searched: at each height the ray would be traced anew.
        pull=lambda _, place: {"height": drawing.HEIGHTS.value(float(place[1]))},
        reach="press",
        role="ray",
    ),
)
SCENE = Scene(
    "real-lens",
    "From Snell to the Thin Lens",
    Settings,
    draw,
    STAGES,
    HANDLES,
    accuracy=Accuracy(levels=tiers(*TIERS, labels=TIERS), default="exact", estimate=estimate),
    formula=singlet.refract,
)
