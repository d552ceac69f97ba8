"""Chapter 5: light on surfaces."""

from math import cos, degrees, pi, radians

import numpy as np
from support.worked_numbers import Phrases

from simulations.models.light.brdf import Material, reflected
from simulations.models.light.interreflection import CELLS, bounced, exchange
from simulations.models.light.reflectance import lambert, phong
from simulations.scenes.second_bounce.scene import albedos_of, direct

CHAPTER = "05-lighting-and-reflectance"
FRONT = np.array((0.0, 0, 1))


def light_sent_into_the_hemisphere(shade: np.ndarray, seen_from_rad: np.ndarray) -> float:
    """Share of head-on light: brightness times cosine, over all directions, by midpoints."""
    ring = 2 * pi * np.sin(seen_from_rad) * (seen_from_rad[1] - seen_from_rad[0])
    return float(np.sum(shade * np.cos(seen_from_rad) * ring)) / pi


def light_returned_by_a_surface() -> Phrases:
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


def peak_of_microfacets_deg(light_deg: float, material: Material) -> float:
    """Degrees from the normal, on the side away from the lamp."""
    around, light = np.radians(np.arange(0.0, 90.0, 0.1)), radians(light_deg)
    cosines = np.array(cos(light)), np.cos(around), np.cos(light + around)
    return float(degrees(around[reflected("microfacets", material, *cosines).argmax()]))


def peak_beyond_the_mirror_direction() -> Phrases:
    """Projection and masking shift the peak, and Fresnel's factor shifts it farther."""
    assert peak_of_microfacets_deg(80, Material(0.5, 0.04, 0.25)) > 82
    yield "but *beyond* it, nearer to"
    constant = peak_of_microfacets_deg(60, Material(0.0, 1.0, 0.25))
    yield f"With a lamp at 60° and a constant $F = 1$ the peak is already at {constant:.0f}°"
    assert peak_of_microfacets_deg(60, Material(0.0, 0.04, 0.25)) > 89.5
    yield "the highlight at that lamp rises all the way to the horizon"


def blue_light_in_the_red_shadow() -> Phrases:
    """Light on the floor outside the patch, below a white ceiling and below a black one."""
    floor, ceiling, lamp = 2, 3, direct(90.0)
    white = albedos_of(0.8, "red")[:6, 1]
    black = np.where(np.arange(6) == ceiling, 0.0, white)
    lit, dark = (
        (exchange() @ bounced(lamp, albedos, 1).ravel()).reshape(6, CELLS, CELLS)[floor]
        for albedos in (white, black)
    )
    assert (1 - dark / lit)[lamp[floor] == 0].min() > 2 / 3
    yield "Of its little blue light, more than two thirds come by way of the white ceiling"


def light_of_a_rough_ball_at_half_moon() -> Phrases:
    """Oren and Nayar's shorter formula over the disc, lamp at 90° against lamp at the eye."""
    x, y = np.meshgrid(np.linspace(-1, 1, 400), np.linspace(-1, 1, 400))
    normals = np.stack([x, y, np.sqrt(np.maximum(1 - x * x - y * y, 0))], -1)[x * x + y * y < 1]
    spread, sent = radians(40) ** 2, []
    for light in (np.array((1.0, 0, 0)), FRONT):
        cosines = np.clip(normals @ light, 0, 1), normals @ FRONT
        across = [light, FRONT] - np.stack(cosines, -1)[..., None] * normals[:, None]
        lengths = np.linalg.norm(across, axis=-1).prod(-1)
        turn = np.maximum(across.prod(1).sum(-1), 0) / np.maximum(lengths, 1e-12)
        far, near = np.arccos(np.minimum(*cosines)), np.arccos(np.maximum(*cosines))
        flat = 1 - 0.5 * spread / (spread + 0.33)
        rough = 0.45 * spread / (spread + 0.09) * turn * np.sin(far) * np.tan(near)
        sent.append(np.sum(cosines[0] * (flat + rough)))
    yield f"one by Oren and Nayar {100 * sent[0] / sent[1]:.0f} %"
