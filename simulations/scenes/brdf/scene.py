"""Reflection at a point of a surface: four models, their lobes, and their energy.

For each it shows whether more light is reflected than arrives, and whether the BRDF is reciprocal.
All directions of the lobe are in the plane of the light and the normal; angles are from the normal,
positive to the right. The quadrature is accurate to a percent and takes a few milliseconds: no
tiers.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache

import numpy as np

from simulations.engine.drawing import Point, arrow, dot, line, polygon, polyline, text
from simulations.engine.frame import Frame, Panel, Readout, format_number, readout
from simulations.engine.handles import Handle
from simulations.engine.plotting import Axis, Plot, Scale
from simulations.engine.scene import Scene
from simulations.engine.settings import choice, slider
from simulations.engine.stages import Outputs, Stage
from simulations.models.arrays import Floats
from simulations.models.light.brdf import Material, reflected, schlick, sent_back
from simulations.scenes._ball import HEIGHT, WIDTH, lamp, outlined_dot
from simulations.scenes._turned_camera import body_from_above
from simulations.scenes.brdf import materials
from simulations.scenes.brdf.materials import BALL, ROUGHEST, SMOOTHEST, LitSphere, lit_spheres

LARGEST_DEG = 88  # directions nearer to the horizon have almost no light
MODELS = {
    "microfacets": "Microfacets over matte",
    "lambert": "Matte (Lambert)",
    "phong": "Phong, as of 1975",
    "normalised": "Phong, normalised",
}
AROUND_DEG = np.arange(-89.0, 90.0, 2.0)  # (90,) cameras of the lobe
INCIDENCE_DEG = np.arange(0.0, 89.0, 4.0)  # (23,) lights of the curve of the reflected share

FOOT = (WIDTH / 2, 262.0)
LAMP, CAMERA = 186.0, 170.0  # drawn distances from the foot; both are far away
LONGEST = 165.0  # largest length of the lobe, in units of the view box
CAMERA_UNIT = 30.0  # drawn length of its axes
UNIT = 140.0  # length of a brightness of 1, unless the lobe would be too long
APART_DEG = 14.0  # least angle between camera and mirror direction for the label of the latter

PLOT = Plot(Axis(0.0, 90.0, 46.0, 384.0), Axis(0.0, 1.5, 280.0, 30.0))
ANGLES = Scale("angle of the light from the normal", "°", ticks=(0, 45, 90), style="light")
SHARES = Scale(ticks=(0, 1))


@dataclass(frozen=True, slots=True)
class Settings:
    model: str = choice("Model", MODELS)
    light_angle: float = slider("Light angle", -40, -LARGEST_DEG, LARGEST_DEG, 1, unit="°")
    view_angle: float = slider("Camera angle", 20, -LARGEST_DEG, LARGEST_DEG, 1, unit="°")
    roughness: float = slider("Roughness m", 0.3, SMOOTHEST, ROUGHEST, 0.01)
    specular: float = slider("Specular strength kₛ or F₀", 0.15, 0, 1, 0.01)
    albedo: float = slider("Albedo ρ of the matte part", 0.5, 0, 1, 0.01)


@dataclass(frozen=True, slots=True)
class Exchange:
    """The BRDF at the probed point, in both directions."""

    there: float  # BRDF from the light to the camera, 1/sr
    back: float  # BRDF from the camera to the light, 1/sr
    sent: float  # share of the light that is reflected in all directions together

    @property
    def is_reciprocal(self) -> bool:
        return math.isclose(self.there, self.back, rel_tol=1e-6)


def material_of(albedo: float, specular: float, roughness: float) -> Material:
    return Material(albedo, specular, roughness)


def between(model: str, material: Material, light_deg: float, view_deg: Floats) -> Floats:
    light, view = np.radians(light_deg), np.radians(view_deg)
    return reflected(model, material, np.cos(light), np.cos(view), np.cos(light - view))


def lobe(material: Material, model: str, light_angle: float) -> Floats:
    """Brightness (90,) that each camera sees; 1 is a perfect white that faces the light."""
    shade = np.cos(np.radians(light_angle))
    return np.pi * shade * between(model, material, light_angle, AROUND_DEG)


def exchange(material: Material, model: str, light_angle: float, view_angle: float) -> Exchange:
    return Exchange(
        float(between(model, material, light_angle, np.array([view_angle]))[0]),
        float(between(model, material, view_angle, np.array([light_angle]))[0]),
        float(sent_back(model, material, np.cos(np.radians(light_angle)))),
    )


def reflected_share(material: Material, model: str) -> Floats:
    """(23,) by the angle of the light."""
    return sent_back(model, material, np.cos(np.radians(INCIDENCE_DEG)))


def ball_light(
    model: str, specular: float, roughness: float, light_angle: float, view_angle: float
) -> LitSphere:
    of = [(roughness, specular)]
    return lit_spheres(BALL, model, of, light_angle, view_angle)[0]


STAGES = (
    Stage("material", material_of),
    Stage("lobe", lobe, ("material",)),
    Stage("exchange", exchange, ("material",)),
    Stage("sent back", reflected_share, ("material",)),
    Stage("samples", materials.lit_samples),
    Stage("chart", materials.chart, ("samples",)),
    Stage("light", ball_light),
    Stage("picture", materials.with_ball, ("chart", "light")),
)


def towards(angle_deg: float, length: float) -> tuple[float, float]:
    """The place at an angle from the normal and a distance from the foot."""
    turn = math.radians(angle_deg)
    return FOOT[0] + length * math.sin(turn), FOOT[1] - length * math.cos(turn)


def lobe_plot(light_deg: float, view_deg: float, lobe: Floats, seen: float) -> str:
    """Light, camera, and the lobe: brightness (90,) by direction, ``seen`` towards the camera."""
    unit = min(UNIT, LONGEST / max(float(lobe.max()), 1e-9))
    outline = [
        towards(a, unit * b) for a, b in zip(AROUND_DEG.tolist(), lobe.tolist(), strict=True)
    ]
    light, eye = towards(light_deg, LAMP), towards(view_deg, CAMERA)
    mirror = text(towards(-light_deg, 170), "mirror", "muted small ground", "middle")
    return "".join(
        (
            *surface(unit),
            polygon([FOOT, *outline], "ray fill"),
            arrow(FOOT, towards(0, 150), "world"),
            text(towards(2.2, 157), "n", "world strong ground", "middle"),
            line(FOOT, towards(-light_deg, 160), "muted thin dashed"),
            mirror if abs(light_deg + view_deg) >= APART_DEG else "",
            arrow(light, towards(light_deg, 5), "light bold"),
            lamp(light),
            line(FOOT, eye, "camera bold"),
            body_from_above(eye, FOOT, CAMERA_UNIT),
            outlined_dot(towards(view_deg, unit * seen), "image", 5),
            dot(FOOT, "world", 4.5),
        )
    )


def surface(unit: float) -> Iterator[str]:
    """The surface, and circles of the brightness ½, 1, 2 … that fit."""
    yield line((16, FOOT[1]), (WIDTH - 16, FOOT[1]), "world bold")
    yield text((18, FOOT[1] + 20), "surface", "world small")
    for level, name in ((0.5, "½"), (1.0, "1"), (2.0, "2"), (5.0, "5"), (10.0, "10")):
        radius = unit * level
        if 28.0 <= radius <= LONGEST + 6.0:
            around = np.linspace(-90.0, 90.0, 31)
            yield polyline([towards(float(a), radius) for a in around], "muted thin faint")
            yield text((FOOT[0] + radius, FOOT[1] + 16), name, "muted small", "middle")
    yield text((FOOT[0] + 60, HEIGHT - 34), "circles: brightness", "muted small", "middle")


def energy_plot(curve: Floats, angle_deg: float, sent: float, head_on: float | None) -> str:
    """The reflected share (23,), the share of a smooth facet, and the present light."""
    return "".join(
        (
            energy_ground(),
            "" if head_on is None else smooth_facet(head_on, float(curve[0])),
            PLOT.curve(INCIDENCE_DEG, curve, "error bold" if curve.max() > 1 else "ray bold"),
            PLOT.drop(angle_deg, sent, "light thin"),
            PLOT.mark(angle_deg, sent, "light"),
        )
    )


def smooth_facet(head_on: float, share: float) -> str:
    """The share of a smooth facet; its name keeps clear of the curve, which begins at ``share``."""
    below = head_on > 0.12 and 0.0 <= share - head_on < 0.16
    fine = np.linspace(0.0, 90.0, 46)
    x, y = PLOT.clamped(0.0, head_on)
    return PLOT.curve(fine, schlick(np.cos(np.radians(fine)), head_on), "image thin dashed") + text(
        (x + 8, y + (15 if below else -6)), "F(θ) of one facet", "image small ground"
    )


@cache
def energy_ground() -> str:
    x, y = PLOT.clamped(0, 1)
    return "".join(
        (
            PLOT.region(y=(1.0, 1.5), style="error fill faint"),
            PLOT.level(1.0, "error thin dashed"),
            PLOT.frame(ANGLES, SHARES),
            text((x + 8, y - 7), "more than arrives", "error small ground"),
        )
    )


def draw(settings: Settings, outputs: Outputs) -> Frame:
    here: Exchange = outputs["exchange"]
    light, view = settings.light_angle, settings.view_angle
    seen = math.pi * math.cos(math.radians(light)) * here.there
    marks = materials.marks(view, settings.roughness, settings.specular)
    around = lobe_plot(light, view, outputs["lobe"], seen)
    smooth = settings.specular if settings.model == "microfacets" else None
    energy = energy_plot(outputs["sent back"], abs(light), here.sent, smooth)
    size = WIDTH, HEIGHT
    return Frame(
        (
            Panel("camera", "The material", *size, outputs["picture"], marks, lead=True),
            Panel("lobe", "Where the light goes", *size, overlay=around),
            Panel("energy", "How much is reflected", *size, overlay=energy),
        ),
        (
            readout("there", "BRDF, light to camera", here.there, "1/sr", digits=3, role="ray"),
            readout("back", "BRDF, camera to light", here.back, "1/sr", digits=3, role="camera"),
            readout("seen", "Brightness seen", seen, digits=3, role="image"),
            readout("sent", "Total reflected", here.sent, "of the light", digits=3, role="light"),
            Readout("reciprocal", "Reciprocal", "yes" if here.is_reciprocal else "no"),
        ),
        describe(settings, here, seen),
    )


def describe(settings: Settings, here: Exchange, seen: float) -> str:
    look = materials.material_name(settings.roughness, settings.specular)
    name = MODELS[settings.model].replace(" (Lambert)", "").lower().replace("phong", "Phong")
    sides = "the same side" if settings.light_angle * settings.view_angle > 0 else "the other side"
    share = format_number(100 * here.sent, 0)
    verdict = ", more than came" if here.sent > 1 + 1e-9 else ""
    alike = "" if here.is_reciprocal else "; light and camera exchanged, it would be another"
    return (
        f"A red ball that looks like {look}, by the model “{name}”, beside sixteen from smooth to "
        f"rough and from "
        f"matte to mirror; a point of it, lit at {abs(settings.light_angle):.0f}° from its "
        f"normal and seen at {abs(settings.view_angle):.0f}° on {sides}, shows the brightness "
        f"{format_number(seen)}{alike}; in all directions together it sends back {share}\u00a0% of "
        f"the light{verdict}."
    )


def incidence_pulled(settings: Settings, place: Point) -> dict[str, float]:
    angle = min(max(PLOT.values(place)[0], 0.0), 90.0)
    return {"light_angle": math.copysign(angle, settings.light_angle)}


def material_at(settings: Settings, _outputs: Outputs) -> tuple[float, float]:
    return materials.in_chart(settings.roughness, settings.specular)


def lamp_at(settings: Settings, _outputs: Outputs) -> tuple[float, float]:
    return towards(settings.light_angle, LAMP)


def eye_at(settings: Settings, _outputs: Outputs) -> tuple[float, float]:
    return towards(settings.view_angle, CAMERA)


def probe_at(settings: Settings, _outputs: Outputs) -> tuple[float, float]:
    return materials.on_equator(-settings.view_angle)


def incidence_at(settings: Settings, outputs: Outputs) -> tuple[float, float]:
    return PLOT.clamped(abs(settings.light_angle), outputs["exchange"].sent)


LIGHT_ANGLE, VIEW_ANGLE = ("light_angle",), ("view_angle",)
HANDLES: tuple[Handle[Settings], ...] = (
    Handle(
        "material",
        "camera",
        "Material",
        drives=("roughness", "specular"),
        at=material_at,
        pull=materials.material_at,
        role="ray",
    ),
    Handle("lamp", "lobe", "Lamp", LIGHT_ANGLE, lamp_at, role="light"),
    Handle("eye", "lobe", "Camera", VIEW_ANGLE, eye_at, role="camera"),
    Handle(  # the camera is fixed in front of the ball; the normal is turned away from it
        "probe",
        "camera",
        "Probed point",
        drives=VIEW_ANGLE,
        at=probe_at,
        role="world",
        reversed=VIEW_ANGLE,
    ),
    Handle(
        "incidence",
        "energy",
        "Angle of the light",
        drives=LIGHT_ANGLE,
        at=incidence_at,
        pull=incidence_pulled,  # not searched: the height is the output of a slow stage
        role="light",
    ),
)
SCENE = Scene(
    "brdf", "Reflectance Distribution (BRDF)", Settings, draw, STAGES, HANDLES, formula=reflected
)
