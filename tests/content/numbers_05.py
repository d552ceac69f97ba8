"""Chapter 5: light on surfaces."""

from math import acos, cos, degrees, pi, radians, sin, sqrt

import numpy as np
from support.worked_numbers import Says

from simulations.engine.stages import StageCache
from simulations.models.color.srgb import encode_srgb
from simulations.models.light.brdf import Material, reflected, schlick, sent_back
from simulations.models.light.interreflection import edge_factor
from simulations.models.light.reflectance import attenuation, blinn_phong, lambert, phong
from simulations.scenes.phong.scene import SCENE
from simulations.scenes.second_bounce.scene import SCENE as BOUNCE
from simulations.scenes.second_bounce.shown import shown_at

CHAPTER = "05-lighting-and-reflectance"
FRONT = np.array((0.0, 0, 1))


def light_that_falls_off() -> Says:
    yield "a surface receives a quarter of the light: the light falls off as $1/d^2$"
    assert np.allclose(attenuation([2.0, 3.0, 10.0]), [1 / 4, 1 / 9, 1 / 100])


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


def a_highlight_between_corners() -> Says:
    """Green light, of which the ball itself returns next to none."""
    yield "set **Light angle** to 75° and **Shininess** to 100"
    yield "Move the light slowly to 60°, and it flares up as a square at a corner."
    brightest = {}
    for tier in ("gouraud-8", "phong", "blended-normals-16"):
        for angle in (75, 60):
            given = SCENE.check({"light_angle": angle, "shininess": 100})
            picture = SCENE.render(given, tier, StageCache()).panels[0].raster
            assert picture is not None
            brightest[tier, angle] = int(picture[..., 1].max())
    # The wall behind has 85, so has the ball's own green.
    assert brightest["gouraud-8", 75] < 90 < 200 < brightest["gouraud-8", 60]
    assert min(brightest[tier, 75] for tier in ("phong", "blended-normals-16")) > 200


def a_number_to_check_by_hand() -> Says:
    light = (sin(radians(30)), 0, cos(radians(30)))
    normal = np.array((0.0, 0, 1))
    yield rf"= ({light[0]:g}, 0, {light[2]:.3f})$"
    yield f"Their dot product is ${light[2]:.3f}$."
    brightness = float(lambert(normal, light, 0.8))
    yield rf"$I = 0.8 \times {light[2]:.3f} = {brightness:.3f}$ of full white"
    yield rf"${brightness:.3f} \times 255 = {255 * brightness:.0f}$"
    encoded = float(encode_srgb(brightness))
    yield f"${brightness:.3f}$ becomes ${encoded:.3f}$"
    yield f"the pixel's value is **{255 * encoded:.0f}**"


def how_wide_a_highlight_is() -> Says:
    normal = np.array((0.0, 0, 1))
    for shininess in (1, 10, 100, 1000):
        width = acos(2 ** (-1 / shininess))
        view = (sin(width), 0, cos(width))
        seen = phong(normal, normal, view, 0.0, specular=1.0, shininess=shininess)
        assert np.isclose(seen, 0.5), "half of the peak"
        yield f"| {shininess} | {degrees(width):.1f}° |"
    wide, narrow = (degrees(acos(2 ** (-1 / shininess))) for shininess in (10, 1000))
    yield rf"$1/\sqrt{{\alpha}}$: from {wide:.1f}° to {narrow:.1f}° at half height"


def negative_dot_product() -> Says:
    cosine = -0.4
    light = np.array((0, np.sqrt(1 - cosine**2), cosine))
    assert float(lambert(np.array((0.0, 0, 1)), light, 0.5)) == 0.5 * max(0, cosine)
    yield f"- [x] `0.5 * max(0, {cosine:g})`\n"


def halfway_exponent() -> Says:
    yield "- [x] `25 * 2**2`\n"
    yield rf"Four times the exponent, $\alpha = {4 * 20}$"


def a_cosine_just_above_one() -> Says:
    above = 1.0 + float(np.finfo(np.float32).eps)
    yield f"may come out as {above:.7f}"
    yield f"Raised to the power 1000 that is {above**1000:.4f}"
    yield f"a shininess of a million makes it {above**1e6:.2f}"


def fresnel(cosine: float, index: float) -> float:
    """Unpolarised reflectance of a smooth dielectric, by Fresnel's own formulae."""
    inside = sqrt(1 - (1 - cosine**2) / index**2)
    across = ((cosine - index * inside) / (cosine + index * inside)) ** 2
    along = ((index * cosine - inside) / (index * cosine + inside)) ** 2
    return (across + along) / 2


def a_pane_at_a_slant() -> Says:
    head_on = fresnel(1.0, 1.5)
    yield rf"\right)^2 = {head_on:.2f}$ of the light"
    at_60, at_80 = (float(schlick(np.array(cos(radians(a))), head_on)) for a in (60, 80))
    yield rf"$0.04 + 0.96 \cdot 0.5^5 = {at_60:.2f}$"
    yield rf"$0.04 + 0.96 \cdot {1 - cos(radians(80)):.3f}^5 = {at_80:.2f}$"
    yield f"Fresnel's own formulae ${fresnel(cos(radians(80)), 1.5):.2f}$"


def water_at_a_slant() -> Says:
    off = 1 - cos(radians(75))
    shown = float(schlick(np.array(cos(radians(75))), 0.02))
    yield f"= {off:.3f}$, to the fifth {off**5:.3f}, and"
    yield rf"$0.02 + 0.98 \cdot {off**5:.3f} = {shown:.2f}$"
    assert np.isclose(fresnel(cos(radians(75)), 1.33), shown, atol=0.035)


def a_lobe_of_unit_reflectance() -> Says:
    """The factor of the normalised model, for any exponent."""
    for roughness in (0.2, 0.6, 1.0):
        returned = float(sent_back("normalised", Material(0.0, 0.5, roughness), 1.0))
        assert np.isclose(returned, 0.5, atol=1e-3)
    yield "the lobe sends back the share $k_s$ of light that falls head-on, however narrow it is"
    yield r"Put the factor $(\alpha + 2)/2$ in its place"


def the_peak_of_plastic_lies_beyond_the_mirror() -> Says:
    around = np.radians(np.arange(0.0, 90.0, 0.1))
    light = radians(80)
    seen = reflected(
        "microfacets",
        Material(0.5, 0.04, 0.25),
        np.array(cos(light)),
        np.cos(around),
        np.cos(light + around),
    )
    assert degrees(around[seen.argmax()]) > 82
    yield "but *beyond* it, nearer to"


def the_corner_of_a_room() -> Says:
    right = radians(90)
    room = edge_factor(0.8, right)
    yield rf"$1/(1 - 0.4) = {room:.2f}$"
    shares = [(0.8 / 2) ** bounce for bounce in (1, 2, 3)]
    first, second, third = (100 * share for share in shares)
    yield f"brings {first:.0f} %, the second {second:.0f} %, the third {third:.1f} %"
    assert np.isclose(sum((0.8 / 2) ** k for k in range(60)), room)
    yield f"it would be {edge_factor(0.05, right):.2f}, and you would not see it"
    narrow = radians(40)
    yield f"$V = {(1 + cos(narrow)) / 2:.2f}$, it is {edge_factor(0.9, narrow):.1f}"
    yield rf"$1/(1 - 0.9 \cdot 0.75) = {edge_factor(0.9, radians(60)):.2f}$"


def near_the_edge_of_two_white_planes() -> Says:
    given = {"light_angle": 45, "wall": "white", "place": 0.01}
    planes = BOUNCE.run(BOUNCE.check(given), "", StageCache()).outputs["planes"]
    shown = shown_at(planes, 0.01)
    yield f"a factor of {shown.red / shown.lamp:.2f}, close to the {edge_factor(0.8, pi / 2):.2f}"


def a_page_in_the_sun() -> Says:
    arrives = 1000 * cos(radians(60))
    yield rf"$E = 1000 \cos 60^\circ = {arrives:.0f}$ W/m²"
    yield rf"$0.8 \cdot 500 = {0.8 * arrives:.0f}$ W/m²"
    yield rf"$0.8/\pi = {0.8 / pi:.3f}$ sr⁻¹"
    yield rf"$0.255 \cdot 500 = {0.8 / pi * arrives:.0f}$ W/(m² sr)"


WORKED = (
    a_page_in_the_sun,
    the_corner_of_a_room,
    near_the_edge_of_two_white_planes,
    a_pane_at_a_slant,
    water_at_a_slant,
    a_lobe_of_unit_reflectance,
    the_peak_of_plastic_lies_beyond_the_mirror,
    a_cosine_just_above_one,
    light_that_falls_off,
    what_a_surface_returns,
    the_printed_formulae,
    a_highlight_between_corners,
    a_number_to_check_by_hand,
    how_wide_a_highlight_is,
    negative_dot_product,
    halfway_exponent,
)
