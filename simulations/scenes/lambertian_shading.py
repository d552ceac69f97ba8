"""A matte sphere, a light that goes round it, and the brightness of one probed point.

The light and the probed point lie in the horizontal plane through the sphere's centre, at
angles from the camera's direction. The picture holds nothing but ``I = albedo max(0, n . l)``,
computed for every pixel in linear light and then encoded for the screen.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from simulations.engine.controls import Slider, Toggle, Values
from simulations.engine.frame import Frame, Panel, readout
from simulations.engine.pipeline import Stage, StageCache, run
from simulations.engine.raster import to_rgba8
from simulations.engine.scene import Scene
from simulations.models.color import encode_srgb, encode_srgb_table
from simulations.models.reflectance import lambert
from simulations.scenes import lambertian_drawing as drawing

type Picture = NDArray[np.float32]
type Mask = NDArray[np.bool_]

PIXELS_PER_UNIT = 1.25
"""Raster pixels per unit of the view box."""

CONTROLS = (
    Slider(
        name="light_angle",
        label="Light angle",
        default=30,
        minimum=-180,
        maximum=180,
        step=1,
        unit="°",
    ),
    Slider(name="albedo", label="Albedo ρ", default=0.8, minimum=0, maximum=1, step=0.01),
    Slider(
        name="probe", label="Probed point", default=0, minimum=-90, maximum=90, step=1, unit="°"
    ),
    Toggle(name="normals", label="Show normals"),
)


@dataclass(frozen=True, slots=True)
class Ball:
    """What of the picture does not depend on any control."""

    normals: Picture
    """(h, w, 3) unit normals in the square around the sphere; z towards the camera."""
    inner: Mask
    """(h, w) pixels that the sphere covers whole."""
    rim: Mask
    """(h, w) pixels that it covers in part."""
    rim_coverage: Picture
    """(rim pixels, 1) share that it covers."""
    behind_rim: Picture
    """(rim pixels, 3) linear light of the wall there."""
    backdrop: NDArray[np.uint8]
    """(H, W, 4) the wall alone."""
    square: tuple[slice, slice]
    """Where the square lies in the picture."""


def build_ball() -> Ball:
    """Normals, edge coverage and backdrop, once."""
    scale, radius = PIXELS_PER_UNIT, drawing.RADIUS * PIXELS_PER_UNIT
    height, width = round(drawing.HEIGHT * scale), round(drawing.WIDTH * scale)
    x = np.arange(width, dtype=np.float32) + 0.5 - drawing.CENTRE[0] * scale
    y = drawing.CENTRE[1] * scale - np.arange(height, dtype=np.float32) - 0.5
    rows, columns = (np.flatnonzero(np.abs(axis) < radius + 1) for axis in (y, x))
    square = (slice(rows[0], rows[-1] + 1), slice(columns[0], columns[-1] + 1))
    across, up = np.meshgrid(x[square[1]], y[square[0]])
    distance = np.hypot(across, up)
    # Rim pixels whose centre is outside take the normal of the nearest point of the rim.
    outer = np.maximum(distance, radius)
    depth = np.sqrt(np.maximum(radius**2 - distance**2, 0))
    normals = np.stack([across / outer, up / outer, depth / outer], axis=-1)
    coverage = np.clip(radius - distance + 0.5, 0, 1).astype(np.float32)
    rim = (coverage > 0) & (coverage < 1)
    wall = _wall(x, y)
    return Ball(
        normals=normals.astype(np.float32),
        inner=coverage == 1,
        rim=rim,
        rim_coverage=coverage[rim][:, None],
        behind_rim=wall[square][rim],
        backdrop=to_rgba8(encode_srgb(wall)),
        square=square,
    )


def _wall(x: Picture, y: Picture) -> Picture:
    """A slate wall in linear light, a little lighter behind the sphere."""
    distance = np.hypot(x, y[:, None]) / (drawing.WIDTH * PIXELS_PER_UNIT)
    level = 0.105 - 0.085 * np.minimum(distance, 0.8)
    wall: Picture = (level[..., None] * np.array([0.92, 1.0, 1.12])).astype(np.float32)
    return wall


def shade(ball: Ball, light_angle: float, albedo: float) -> NDArray[np.uint8]:
    """The picture, (H, W, 4) bytes. Only the rim mixes sphere and wall, in linear light."""
    brightness = lambert(ball.normals, light_direction(light_angle), albedo)
    picture = ball.backdrop.copy()
    sphere = picture[ball.square]
    sphere[ball.inner] = to_rgba8(encode_srgb_table(brightness))[ball.inner]
    on_rim = brightness[ball.rim][:, None]
    mixed = ball.behind_rim + ball.rim_coverage * (on_rim - ball.behind_rim)
    sphere[ball.rim] = to_rgba8(encode_srgb_table(mixed)[None])[0]
    return picture


def light_direction(angle_deg: float) -> NDArray[np.float64]:
    """Unit vector in the horizontal plane: 0° from the camera, 90° from the right."""
    angle_rad = math.radians(angle_deg)
    return np.array([math.sin(angle_rad), 0.0, math.cos(angle_rad)])


STAGES = (
    Stage("ball", (), build_ball),
    Stage("shade", ("light_angle", "albedo"), shade, ("ball",)),
)


def render(values: Values, tier: str, cache: StageCache) -> Frame:  # noqa: ARG001 - no tiers
    done = run(STAGES, values, cache)
    light_rad = math.radians(values.number("light_angle"))
    probe_rad = math.radians(values.number("probe"))
    albedo = values.number("albedo")
    theta_rad = abs(math.remainder(light_rad - probe_rad, 2 * math.pi))
    normal = light_direction(values.number("probe"))
    brightness = float(lambert(normal, light_direction(values.number("light_angle")), albedo))
    code = round(255 * float(encode_srgb(brightness)))
    show_normals = values.toggle("normals")
    overlays = (
        drawing.over_sphere(light_rad, probe_rad, show_normals),
        drawing.from_above(light_rad, probe_rad, theta_rad, show_normals),
        drawing.brightness_plot(albedo, theta_rad, brightness),
    )
    titles = ("What the camera sees", "The equator from above", "Brightness by angle")
    panels = tuple(
        Panel(name, title, drawing.WIDTH, drawing.HEIGHT, raster, overlay)
        for name, title, raster, overlay in zip(
            ("camera", "above", "curve"),
            titles,
            (done.outputs["shade"], None, None),
            overlays,
            strict=True,
        )
    )
    readouts = (
        readout("cosine", "n · l", math.cos(theta_rad), digits=3),
        readout("theta", "Angle θ", math.degrees(theta_rad), "°", digits=0, role="ray"),
        readout("albedo", "Albedo ρ", albedo, role="world"),
        readout("brightness", "I = ρ max(0, n · l)", brightness, digits=3, role="image"),
        readout("code", "Pixel value (sRGB)", code, "of 255", digits=0, role="image"),
    )
    return Frame(panels, readouts, describe(values, theta_rad, code), done.reports)


def describe(values: Values, theta_rad: float, code: int) -> str:
    """The picture in one sentence."""
    angle = values.number("light_angle")
    side = "right" if angle > 0 else "left"
    facing = abs(angle)
    if facing < 5:
        light = "from the camera, so that the whole visible half is lit"
    elif facing > 175:
        light = "from behind, so that the visible half is dark"
    else:
        share = round(50 * (1 + math.cos(math.radians(angle))))
        light = f"from {facing:.0f}° to the {side}, so that {share} % of the disc is lit"
    theta = math.degrees(theta_rad)
    point = (
        f"makes {theta:.0f}° with the light, and its pixel value is {code}"
        if theta < 90
        else f"is turned {theta:.0f}° from the light, so that it is black"
    )
    return f"A matte sphere is lit {light}; the normal at the probed point {point}."


SCENE = Scene(id="lambertian-shading", title="Lambertian Shading", controls=CONTROLS, render=render)
