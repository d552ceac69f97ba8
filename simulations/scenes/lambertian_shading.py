"""A matte sphere, a light that circles it, and the brightness of one probed point.

The light and the probed point are in the horizontal plane through the sphere's centre, at angles
from the camera's direction, positive to the right. The picture is ``I = albedo max(0, n . l)`` for
every pixel in linear light, encoded for the screen.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from simulations.engine import drawing
from simulations.engine.accuracy import Accuracy
from simulations.engine.frame import Frame, Panel, Readout, readout
from simulations.engine.handles import Handle
from simulations.engine.plotting import Axis, Plot, Scale
from simulations.engine.scene import Scene
from simulations.engine.settings import action, slider, toggle
from simulations.engine.stages import Outputs, Stage
from simulations.models.arrays import Floats
from simulations.models.color.srgb import encode_srgb
from simulations.models.light.reflectance import lambert
from simulations.scenes import _ball
from simulations.scenes._ball import CENTRE, HEIGHT, RADIUS, WIDTH, Body
from simulations.scenes._turned_camera import body_from_above

PLAN_CENTRE, PLAN_RADIUS, VECTOR = (200.0, 156.0), 80.0, 60.0  # VECTOR: a unit vector's length
ARC = 36.0  # radius of the arc of θ
RAY_START = 136.0  # from the plane through the sphere's centre to where parallel rays begin
LAMP_DISTANCE = 138.0  # drawn distance of the lamp from the sphere's centre; it is far away
BEYOND_TIP = 4.2  # from the tip of a head to the tip of its outline, which is 1.5 units wide

PLOT = Plot(Axis(0.0, 180.0, 58.0, 382.0), Axis(0.0, 1.0, 282.0, 34.0))
ANGLES = Scale(
    "angle θ between normal and light",
    ticks=[(degrees, f"{degrees}°") for degrees in (0, 90, 180)],
    grid=(90,),
    centred=True,
)
BRIGHTNESS = Scale("brightness I", ticks=(0, 1), grid=(1,), style="image")
DEGREES = np.arange(0.0, 181.0, 2.0)


@dataclass(frozen=True, slots=True)
class Settings:
    light_angle: float = slider("Light angle", 30, -180, 180, 1, unit="°", arrival=-150)
    albedo: float = slider("Albedo ρ", 0.8, 0, 1, 0.01)
    probe: float = slider("Probed point", 0, -90, 90, 1, unit="°")
    normals: bool = toggle("Show normals")
    play: int = action("Orbit the light", "Stop", drives="light_angle", effect="play", seconds=12)


def white_light(normals: Floats, body: Body, light_angle: float) -> Floats:
    """(h, w) linear light of the ball's pixels, were it white."""
    return _ball.light_of_pixels(lambert(normals, _ball.light_direction(light_angle)), body)


def shade(white: Floats, body: Body, albedo: float) -> Floats:
    """(h, w) linear light of the ball as painted. Black paint needs no computation."""
    return np.float32(albedo) * white if albedo > 0 else np.zeros_like(body.inner, np.float32)


def is_black(albedo: float) -> str:
    return "black paint returns no light" if albedo == 0 else ""


STAGES = (
    Stage("body", _ball.build_ball),
    Stage("normals", _ball.lit_normals, ("body",)),
    Stage("white", white_light, ("normals", "body"), neutral=is_black),
    Stage("shade", shade, ("white", "body")),
    Stage("picture", _ball.paint, ("body", "shade")),
)


def estimate(settings: Settings, outputs: Outputs, _tier: str) -> Iterator[Readout]:
    """Error of the picture against Lambert's law in float64, in one step."""
    body: Body = outputs["body"]
    truth = settings.albedo * np.maximum(_ball.true_cosine(body, settings.light_angle), 0.0)
    yield _ball.rms_error(body, outputs["shade"], truth)


def over_sphere(light_rad: float, probe_rad: float, show_normals: bool) -> str:
    """Terminator, brightest point, light rays and probed point on the camera's view."""
    parts = [*picture_normals()] if show_normals else []
    parts.append(_ball.shadow_edge(light_rad))
    parts += picture_rays(light_rad)
    if math.cos(light_rad) > 0.05:
        brightest = _ball.on_equator(light_rad)
        parts.append(drawing.cased(drawing.circle, brightest, 7, style="light"))
        parts.append(_ball.named(brightest, "brightest point", "light"))
    probed = _ball.on_equator(probe_rad)
    parts.append(_ball.outlined_dot(probed, "ray"))
    parts.append(_ball.named(probed, "probed point", "ray", above=True))
    return "".join(parts)


def picture_rays(light_rad: float) -> Iterator[str]:
    """Three parallel rays next to the sphere, foreshortened as the camera sees them."""
    across = math.sin(light_rad)
    length = 62 * abs(across)
    if length < 12:
        return
    side = math.copysign(1, across)
    for offset in (-46, 0, 46):
        edge = math.sqrt(RADIUS**2 - offset**2) + 8
        start = (CENTRE[0] + side * (edge + length), CENTRE[1] + offset)
        end = (CENTRE[0] + side * edge, CENTRE[1] + offset)
        yield cased_arrow(start, end, "light")


def picture_normals() -> Iterator[str]:
    """Normals of the visible half, foreshortened; those towards the camera shrink to a point."""
    for latitude in (-60, -30, 0, 30, 60):
        for longitude in (-75, -50, -25, 0, 25, 50, 75):
            x = math.cos(math.radians(latitude)) * math.sin(math.radians(longitude))
            y = -math.sin(math.radians(latitude))
            foot = (CENTRE[0] + RADIUS * x, CENTRE[1] + RADIUS * y)
            tip = (foot[0] + 30 * x, foot[1] + 30 * y)
            yield cased_arrow(foot, tip, "world thin", head=6)


def cased_arrow(start: drawing.Point, end: drawing.Point, style: str, head: float = 8) -> str:
    """An arrow with an outline in the paper's colour, visible on any picture."""
    length = math.hypot(end[0] - start[0], end[1] - start[1])
    if length < head:
        return _ball.outlined_dot(end, style, 2, 2.5)
    past = 1 + BEYOND_TIP / length
    wide_end = (start[0] + (end[0] - start[0]) * past, start[1] + (end[1] - start[1]) * past)
    outline = drawing.arrow(start, wide_end, "casing", head + BEYOND_TIP + 1.5)
    return outline + drawing.arrow(start, end, style, head)


def from_above(light_rad: float, probe_rad: float, theta_rad: float, show_normals: bool) -> str:
    """The equator seen from above, with true angles; the camera is at the bottom."""
    night = [plan_place(light_rad + math.pi * (0.5 + step / 32), PLAN_RADIUS) for step in range(33)]
    day = [plan_place(light_rad + math.pi * (step / 32 - 0.5), PLAN_RADIUS) for step in range(33)]
    probed = plan_place(probe_rad, PLAN_RADIUS)
    side = math.copysign(1.0, math.remainder(light_rad - probe_rad, 2 * math.pi))
    # Each label is on the side away from the other; the label of l is not under the lamp.
    n_label = plan_offset(probed, probe_rad - 0.2 * side, VECTOR + 2)
    l_label = plan_offset(probed, light_rad + 0.3 * side, 0.7 * VECTOR)
    parts = [
        *plan_rays(light_rad),
        drawing.polygon(night, "muted fill"),
        drawing.polyline(day, "light bold"),
        drawing.line(night[0], night[-1], "light dashed"),
        _ball.lamp(plan_place(light_rad, LAMP_DISTANCE)),
        *(plan_normals() if show_normals else ()),
        camera(),
        angle_theta(probed, probe_rad, light_rad, theta_rad),
        drawing.arrow(probed, plan_offset(probed, light_rad, VECTOR), "light bold"),
        drawing.arrow(probed, plan_offset(probed, probe_rad, VECTOR), "world bold"),
        drawing.dot(probed, "ray", 5.5),
        drawing.text((n_label[0], n_label[1] + 4), "n", "world strong ground", "middle"),
        drawing.text((l_label[0], l_label[1] + 4), "l", "light strong ground", "middle"),
    ]
    return "".join(parts)


def plan_rays(light_rad: float) -> Iterator[str]:
    """Parallel rays that end on the lit half of the equator."""
    for share in (-0.8, -0.4, 0, 0.4, 0.8):
        foot = plan_place(light_rad + math.pi / 2, share * PLAN_RADIUS)
        near = PLAN_RADIUS * math.sqrt(1 - share**2) + 4
        start, end = plan_offset(foot, light_rad, RAY_START), plan_offset(foot, light_rad, near)
        yield drawing.arrow(start, end, "light thin faint", head=7)


def plan_normals() -> Iterator[str]:
    for degrees in range(-90, 91, 15):
        angle = math.radians(degrees)
        foot = plan_place(angle, PLAN_RADIUS)
        yield drawing.arrow(foot, plan_offset(foot, angle, 24), "world thin", head=6)


def angle_theta(probed: drawing.Point, probe_rad: float, light_rad: float, theta_rad: float) -> str:
    """The arc from n to l, the short way round."""
    turn = math.remainder(light_rad - probe_rad, 2 * math.pi)
    arc = [plan_offset(probed, probe_rad + turn * step / 24, ARC) for step in range(25)]
    # Between the arms where there is room for it, else beside n.
    towards = probe_rad + (turn / 2 if theta_rad > 0.4 else -math.copysign(0.34, turn))
    x, y = plan_offset(probed, towards, ARC + 16)
    return drawing.polyline(arc, "ray") + drawing.text(
        (x, y + 4), "θ", "ray strong ground", "middle"
    )


def camera() -> str:
    x, y = PLAN_CENTRE[0], HEIGHT - 12.0
    name = drawing.text((x + 24, y + 5), "camera", "camera")
    return body_from_above((x, y - 4), PLAN_CENTRE, 28.0) + name


def plan_place(angle_rad: float, radius: float) -> tuple[float, float]:
    """A place at a distance from the sphere's centre, seen from above."""
    return plan_offset(PLAN_CENTRE, angle_rad, radius)


def plan_offset(start: drawing.Point, angle_rad: float, length: float) -> tuple[float, float]:
    """Go from a point of the plan in a direction; the camera's direction is down the page."""
    return start[0] + length * math.sin(angle_rad), start[1] + length * math.cos(angle_rad)


def brightness_plot(albedo: float, theta_rad: float, brightness: float) -> str:
    """The curve of Lambert's law, and where on it the probed point is."""
    theta_deg = math.degrees(theta_rad)
    lit = np.maximum(np.cos(np.radians(DEGREES)), 0.0)
    parts = [
        PLOT.frame(ANGLES, BRIGHTNESS),
        PLOT.curve(DEGREES[:46], lit[:46], "muted thin dashed"),
        drawing.text(PLOT.at(66, 0.5), "white paint", "muted small ground"),
        drawing.text(PLOT.at(135, 0.2), "faces away", "muted small", "middle"),
        PLOT.curve(DEGREES, albedo * lit, "image bold"),
        PLOT.drop(theta_deg, brightness, "ray thin dashed", to="xy"),
        drawing.dot(PLOT.at(0, albedo), "image", 5.5),
        drawing.dot(PLOT.at(theta_deg, brightness), "ray", 5.5),
    ]
    return "".join(parts)


def draw(settings: Settings, outputs: Outputs) -> Frame:
    light_angle, probe, albedo = settings.light_angle, settings.probe, settings.albedo
    light_rad, probe_rad = math.radians(light_angle), math.radians(probe)
    theta_rad = abs(math.remainder(light_rad - probe_rad, 2 * math.pi))
    towards, normal = _ball.light_direction(light_angle), _ball.light_direction(probe)
    brightness = float(lambert(normal, towards, albedo))
    code = round(255 * float(encode_srgb(brightness)))
    over = over_sphere(light_rad, probe_rad, settings.normals)
    above = from_above(light_rad, probe_rad, theta_rad, settings.normals)
    curve = brightness_plot(albedo, theta_rad, brightness)
    return Frame(
        (
            _ball.camera_panel(outputs["picture"], over),
            Panel("above", "The equator from above", WIDTH, HEIGHT, overlay=above),
            Panel("curve", "Brightness by angle", WIDTH, HEIGHT, overlay=curve),
        ),
        (
            readout("theta", "Angle θ", math.degrees(theta_rad), "°", digits=0, role="ray"),
            readout("cosine", "cos θ = n · l", math.cos(theta_rad), digits=3),
            readout("brightness", "Brightness I", brightness, digits=3, role="image"),
            readout("code", "Pixel value (sRGB)", code, "of 255", digits=0, role="image"),
        ),
        describe(light_angle, math.degrees(theta_rad), code),
    )


def describe(angle: float, theta: float, code: int) -> str:
    if abs(angle) < 5:
        light = "from the camera, so that the whole visible half is lit"
    elif abs(angle) > 175:
        light = "from behind, so that the visible half is dark"
    else:
        side, share = "right" if angle > 0 else "left", 50 * (1 + math.cos(math.radians(angle)))
        light = f"from {abs(angle):.0f}° to the {side}, so that {round(share)}\u00a0% of the disc"
        light += " is lit"
    point = (
        f"makes {theta:.0f}° with the light, and its pixel value is {code}"
        if theta < 90
        else f"is turned {theta:.0f}° from the light, so that it is black"
    )
    return f"A matte sphere is lit {light}; the normal at the probed point {point}."


def brightest(settings: Settings, _outputs: Outputs) -> tuple[float, float] | None:
    """The point whose normal points to the lamp, if the camera sees it."""
    turn = math.radians(settings.light_angle)
    return _ball.on_equator(turn) if abs(settings.light_angle) <= 90 else None


def on_curve(settings: Settings, _outputs: Outputs) -> tuple[float, float]:
    theta = abs(math.remainder(settings.light_angle - settings.probe, 360))
    return PLOT.at(theta, settings.albedo * max(0.0, math.cos(math.radians(theta))))


def lamp_at(settings: Settings, _outputs: Outputs) -> tuple[float, float]:
    return plan_place(math.radians(settings.light_angle), LAMP_DISTANCE)


def probe_above_at(settings: Settings, _outputs: Outputs) -> tuple[float, float]:
    return plan_place(math.radians(settings.probe), PLAN_RADIUS)


def paint_at(settings: Settings, _outputs: Outputs) -> tuple[float, float]:
    return PLOT.at(0.0, settings.albedo)


LIGHT_ANGLE, PROBE = ("light_angle",), ("probe",)
HANDLES: tuple[Handle[Settings], ...] = (
    Handle("brightest", "camera", "Brightest point", LIGHT_ANGLE, brightest, role="light"),
    _ball.probe_on_ball("ray"),
    Handle("lamp", "above", "Lamp", LIGHT_ANGLE, lamp_at, role="light"),
    Handle("probe-above", "above", "Probed point", PROBE, probe_above_at, role="ray"),
    Handle("probe-curve", "curve", "Probed point", PROBE, on_curve, role="ray", reversed=PROBE),
    Handle(
        "paint",
        "curve",
        "Albedo",
        drives=("albedo",),
        at=paint_at,  # brightness at normal incidence
        role="image",
    ),
)
SCENE = Scene(
    "lambertian-shading",
    "Lambertian Shading",
    Settings,
    draw,
    STAGES,
    HANDLES,
    accuracy=Accuracy(
        levels=_ball.LEVELS, default=_ball.DEFAULT_TIER, ladder="shading", estimate=estimate
    ),
    formula=lambert,
)
