"""What models of light refuse, by the name of the parameter."""

import math
from typing import Any

import numpy as np
from support.refusals import Call, assert_refused, each_of

from simulations.models.light import reflectance as shading
from simulations.models.light.brdf import Material
from simulations.models.light.cell_blending import blend_cells
from simulations.models.light.interreflection import CELLS, bounced, edge_factor
from simulations.models.light.raycasting import Box, Sphere, edge_coverage, intersect
from simulations.models.light.reflectance import DirectionalLight, PointLight
from simulations.models.light.soft_shadows import shadow_bounds, sphere_occlusion, visibility

NAN, INF = np.nan, np.inf
ORIGIN, UP = (0.0, 0.0, 0.0), (0.0, 0.0, 1.0)
BALL, CUBE = Sphere((0.0, 0.0, 3.0), 1.0), Box((0, 0, 2), (1, 1, 1))
NO_PLACE = [(2e100, 0.0, 0.0), (0.0, -2e100, 0.0), (0.0, INF, 0.0), (0.0, 0.0, NAN), (0.0, 1.0)]
NO_RADIUS = [0.0, -1.0, INF, NAN, 1.1e100]
NO_SIZE = [(0.0, 1, 1), (1, -1, 1), (1, 1, INF)]
NO_COLOUR = [(1.0, NAN, 1.0), (INF, 1.0, 1.0), (1.0, -1.0, 1.0), (1.0, 1.0)]
NO_SHARE = [-0.1, INF, NAN]
NO_UNIT = [(0, 0, 2.0), (0, 0, 0.0), (NAN, 0, 1), (0, INF, 1)]
NO_LAMP = [0.0, -0.1, math.pi / 2, 1.6, NAN]
FAR = [NAN, INF, 1e101]
LONG = [(0, 0, 1 + 1.05e-4), (0, 0, 1 - 1.05e-4)]
CORNERS = [np.zeros(shape) for shape in ((1, 4), (4, 1, 3), (5,))]
NO_PICTURE = [np.ones(shape) for shape in ((1, 5), (5, 1), (5,), (2, 2, 2))]
PLACE = r"legal: three, finite, at most 1e\+100"
AMOUNTS = r" .*; legal: three numbers from 0 to 1e\+30"


def shade(model: Any = shading.blinn_phong, **shares: float) -> Any:
    return model(UP, UP, UP, **shares)


@each_of(
    ("albedo 1.1.*; legal: .* to 1", lambda a: Material(a, 0.5, 0.5), [1.1]),
    ("specular.*; legal: .* to 1", lambda s: Material(0.5, s, 0.5), [-0.1]),
    ("roughness 1.2.*; legal: .* to 1", lambda m: Material(0, 0, m), [1.2]),
    ("corners of shape .*; legal: two or more", lambda c: blend_cells(c, 4, 4), CORNERS),
    ("pixels; legal: two or", lambda s: blend_cells(np.zeros((3, 3)), *s), [(1, 4), (4, 1)]),
    (
        "albedos .*; legal: 0 to 1",
        lambda a: bounced(np.ones((2, CELLS)), [0.5, a], 1.0, None),
        [-0.1, 1.1],
    ),
    ("albedo .*; legal: 0 to 1", lambda a: edge_factor(a, 1.0), [-0.1, 1.1]),
    ("radius", lambda r: Sphere(ORIGIN, r), NO_RADIUS),
    (r"legal: above 0, to 1e\+100", lambda r: sphere_occlusion(UP, r, ORIGIN, UP), NO_RADIUS),
    ("size", lambda size: Box(ORIGIN, size), NO_SIZE),
    ("angle_rad", lambda angle: Box(ORIGIN, (1, 1, 1), angle), [INF]),
    (PLACE, lambda place: intersect(BALL, place, [UP]), NO_PLACE),
    (PLACE, lambda place: Sphere(place, 1.0), NO_PLACE),
    (PLACE, lambda place: Box(place, (1.0, 1.0, 1.0)), NO_PLACE),
    (PLACE, lambda place: Box(ORIGIN, place), NO_PLACE),
    (r"directions of shape \(4, 2\)", lambda d: intersect(BALL, ORIGIN, d), [np.ones((4, 2))]),
    (r"legal: \(H, W\)", edge_coverage, NO_PICTURE),
    (r"legal: both \(\.\.\., 3\)", lambda v: shading.cosine(v, v), [np.ones((4, 2)), np.ones(4)]),
    ("light", lambda light: shading.lambert(UP, light), LONG),
    ("view", lambda view: shading.phong(UP, UP, view), LONG),
    ("albedo", lambda a: shading.lambert(UP, UP, [0.5, a]), [-0.01, 1.01, NAN]),
    ("radius", lambda r: shading.attenuation(1.0, r), [0.9e-15]),
    ("distance", lambda d: shading.attenuation([1.0, d]), [-0.1, NAN]),
    ("^specular .*; legal: 0 or more, finite", lambda s: shade(specular=s), NO_SHARE),
    ("^shininess .*; legal: 0 or more, finite", lambda s: shade(shininess=s), NO_SHARE),
    ("^ambient .*; legal: 0 or more, finite", lambda s: shade(ambient=s), NO_SHARE),
    ("^specular", lambda s: shade(shading.phong, specular=s), NO_SHARE),
    ("^shininess", lambda s: shade(shading.phong, shininess=s), NO_SHARE),
    ("^ambient", lambda s: shade(shading.phong, ambient=s), NO_SHARE),
    (f"^irradiance{AMOUNTS}", lambda colour: DirectionalLight(UP, colour), NO_COLOUR),
    (f"^intensity{AMOUNTS}", lambda colour: PointLight(UP, colour), NO_COLOUR),
    ("to_light .*; legal: a unit", lambda light: visibility(BALL, ORIGIN, light, 0.1), NO_UNIT),
    ("to_light .*; legal: a unit", lambda light: shadow_bounds(CUBE, light, 0.1), NO_UNIT),
    ("to_light", lambda light: shadow_bounds(CUBE, light, 0.1), [(1.0, 0, 0), (0.6, 0, -0.8)]),
    ("light_radius_rad", lambda angle: visibility(BALL, ORIGIN, UP, angle), NO_LAMP),
    ("light_radius_rad .*below pi/2", lambda angle: shadow_bounds(BALL, UP, angle), NO_LAMP),
    ("points as far as", lambda x: visibility(BALL, [ORIGIN, (x, 0, 0)], UP, 0.1), FAR),
    ("points as far as", lambda x: sphere_occlusion((0, 0, 2.0), 0.5, [0, x, 0], UP), FAR),
)
def test_models_of_light_refuse(message: str, call: Call, values: Any) -> None:
    assert_refused(message, call, values)


def test_the_ends_of_the_ranges_are_legal() -> None:
    assert shading.lambert(UP, UP, [0.0, 1.0]).tolist() == [0, 1]
    assert shading.lambert(UP, (0, 0, 1 + 0.9e-4)) == 1
    assert np.isfinite(shade(specular=0.0, shininess=0.0, ambient=0.0))
    assert shading.attenuation(1.0, 1e-15) == shading.attenuation(0.0, 1.0) == 1
    assert sphere_occlusion(UP, 1e100, ORIGIN, UP) == 1
    assert visibility(Sphere((0, 0, 0.8), 0.3), ORIGIN, UP, 0.05) == 0
    assert 0 < visibility(Sphere((0, 0, 2), 0.5), ORIGIN, UP, 1.5) < 1
