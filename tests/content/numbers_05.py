"""Chapter 5: light on surfaces."""

from collections.abc import Callable
from math import cos, degrees, isclose, pi, radians, sin, sqrt

import numpy as np
from scipy.optimize import brentq
from support.worked_numbers import Says

from simulations.engine.stages import StageCache
from simulations.models.arrays import Floats
from simulations.models.light.brdf import Material, reflected, schlick
from simulations.models.light.interreflection import edge_factor
from simulations.models.light.reflectance import blinn_phong, lambert, phong
from simulations.scenes.second_bounce.scene import SCENE as BOUNCE

CHAPTER = "05-lighting-and-reflectance"
FRONT = np.array((0.0, 0, 1))


def light_sent_into_the_hemisphere(shade: np.ndarray, seen_from_rad: np.ndarray) -> float:
    """Share of head-on light: brightness times cosine, over all directions, by midpoints."""
    ring = 2 * pi * np.sin(seen_from_rad) * (seen_from_rad[1] - seen_from_rad[0])
    return float(np.sum(shade * np.cos(seen_from_rad) * ring)) / pi


def what_a_surface_returns() -> Says:
    """Over π, because a white surface of brightness 1 from all sides returns all the light."""
    around = (np.arange(4000) + 0.5) / 4000 * pi / 2
    views = np.stack([np.sin(around), 0 * around, np.cos(around)], axis=-1)
    normals = np.broadcast_to(FRONT, views.shape)
    matte = np.full(around.shape, float(lambert(FRONT, FRONT, 0.8)))
    assert np.isclose(light_sent_into_the_hemisphere(matte, around), 0.8), "adds up to the albedo"
    for strength, shininess in ((0.6, 1), (0.3, 20)):
        shade = phong(normals, FRONT, views, 0.8, specular=strength, shininess=shininess)
        returned = light_sent_into_the_hemisphere(shade, around)
        assert np.isclose(returned, 0.8 + 2 * strength / (shininess + 2), atol=1e-5)
    yield r"sends out $\rho + 2k_s/(\alpha + 2)$ times the light that it received"
    yield rf"$k_s = 0.6$ and $\alpha = 1$ that is {0.8 + 2 * 0.6 / 3:.1f}"


def the_printed_formulae() -> Says:
    """Written out as the chapter prints them, for directions all round; the models say the same."""
    yield (
        r"I = \begin{cases} \rho \, \mathbf{n} \cdot \mathbf{l} + "
        r"k_s \, \max(0, \mathbf{r} \cdot \mathbf{v})^{\alpha} & "
        r"\text{where } \mathbf{n} \cdot \mathbf{l} > 0 , \\ 0 & \text{elsewhere.}"
    )
    yield r"\mathbf{r} = 2 (\mathbf{n} \cdot \mathbf{l}) \, \mathbf{n} - \mathbf{l}"
    yield r"\mathbf{h} = \frac{\mathbf{l} + \mathbf{v}}{\lVert \mathbf{l} + \mathbf{v} \rVert}"
    vectors = np.random.default_rng(0).normal(size=(500, 3, 3))
    sides = []
    for n, l, v in vectors / np.linalg.norm(vectors, axis=-1, keepdims=True):  # noqa: E741
        r, h = 2 * (n @ l) * n - l, (l + v) / np.linalg.norm(l + v)
        for model, lobe in ((phong, r @ v), (blinn_phong, n @ h)):
            printed = 0.7 * (n @ l) + 0.4 * max(0, lobe) ** 3 if n @ l > 0 else 0
            assert np.isclose(model(n, l, v, 0.7, specular=0.4, shininess=3), printed)
            sides.append((bool(n @ l > 0), bool(lobe > 0)))
    assert len(set(sides)) == 4, "lit and unlit, with the lobe in front and behind"


def turn_to_half_height(model: Callable[..., Floats], shininess: float) -> float:
    """Turn of the camera until a highlight of light from head-on is half as bright."""

    def above_half(turn: float) -> float:
        view = (sin(turn), 0, cos(turn))
        return float(model(FRONT, FRONT, view, 0.0, specular=1.0, shininess=shininess)) - 0.5

    return float(brentq(above_half, 0, 1))


def halfway_exponent() -> Says:
    yield "- [x] `200 / 2**2 * 3**2`\n"
    yield "a quarter of the exponent, $200/4 = 50$"
    yield "takes nine times the exponent, 450"
    game = turn_to_half_height(blinn_phong, 200)
    assert isclose(turn_to_half_height(phong, 50), game, rel_tol=0.01)
    assert isclose(turn_to_half_height(phong, 450), game / 3, rel_tol=0.01)
    yield rf"Four times the exponent, $\alpha = {4 * 20}$"


def fresnel(cosine: float, index: float) -> float:
    """Unpolarised reflectance of a smooth dielectric, by Fresnel's own formulae."""
    inside = sqrt(1 - (1 - cosine**2) / index**2)
    across = ((cosine - index * inside) / (cosine + index * inside)) ** 2
    along = ((index * cosine - inside) / (index * cosine + inside)) ** 2
    return (across + along) / 2


def glass_at_a_slant() -> Says:
    head_on = fresnel(1.0, 1.5)
    yield rf"\right)^2 = {head_on:.2f}$ of the light"
    back_and_forth = sum(head_on * (1 - head_on) ** 2 * head_on ** (2 * k) for k in range(20))
    yield f"$2F_0/(1 + F_0) = {100 * (head_on + back_and_forth):.1f}$ %"
    at_80 = float(schlick(np.array(cos(radians(80))), head_on))
    yield rf"$0.04 + 0.96 \cdot {1 - cos(radians(80)):.3f}^5 = {at_80:.2f}$ for one face"
    yield f"Fresnel's own formulae give {fresnel(cos(radians(80)), 1.5):.2f} at 80°"


def schlick_at_all_angles() -> Says:
    """For glass, in steps of a tenth of a degree."""
    cosines = np.cos(np.radians(np.arange(0, 90, 0.1)))
    form = schlick(cosines, 0.04)
    law = np.array([fresnel(cosine, 1.5) for cosine in cosines.tolist()])
    far, low = (10 * round(i / 10) for i in (np.abs(form - law).argmax(), (form / law).argmin()))
    yield f"at {far / 10:.0f}°, {form[far]:.2f} instead of {law[far]:.2f}"
    yield f"near {low / 10:.0f}°, where {form[low]:.3f} stands for {law[low]:.3f}"
    assert 0.75 < form[low] / law[low] < 0.78, "a quarter too little"


def where_facets_shine_most(light_deg: float, material: Material) -> float:
    """Degrees from the normal, on the side away from the lamp."""
    around, light = np.radians(np.arange(0.0, 90.0, 0.1)), radians(light_deg)
    cosines = np.array(cos(light)), np.cos(around), np.cos(light + around)
    return float(degrees(around[reflected("microfacets", material, *cosines).argmax()]))


def the_peak_lies_beyond_the_mirror() -> Says:
    """With Fresnel's factor constant by projection and masking, and with it farther still."""
    assert where_facets_shine_most(80, Material(0.5, 0.04, 0.25)) > 82
    yield "but *beyond* it, nearer to"
    constant = where_facets_shine_most(60, Material(0.0, 1.0, 0.25))
    yield f"With a lamp at 60° and a constant $F = 1$ the peak is already at {constant:.0f}°"
    assert where_facets_shine_most(60, Material(0.0, 0.04, 0.25)) > 89.5
    yield "the highlight at that lamp rises all the way to the horizon"


def near_the_edge_of_two_white_planes() -> Says:
    given = {"light_angle": 45, "wall": "white", "place": 0.01}
    planes = BOUNCE.run(BOUNCE.check(given), "", StageCache()).outputs["planes"]
    lamp, red, _ = planes.at(0.01)
    yield f"a factor of {red / lamp:.2f}, close to the {edge_factor(0.8, pi / 2):.2f}"
