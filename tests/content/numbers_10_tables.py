"""What it costs to leave something out, and what an error becomes in a depth and in a pose: the
tables of appendix A, computed.

Codes are RMS over a picture, after the display's curve. Nothing here shares code with the stages
that leave these things out."""

from functools import cache

import numpy as np
from scipy.ndimage import map_coordinates
from scipy.special import j1
from scipy.stats import norm, poisson
from support.worked_numbers import Says

from simulations.models.arrays import Floats
from simulations.models.color.srgb import encode_srgb
from simulations.models.error_measures import root_mean_square
from simulations.models.geometry.rotations import exponential
from simulations.models.light.interreflection import EDGES, bounced, mean_lamp_light
from simulations.pictures.balloon import WHOLE
from simulations.pictures.mosaic_subjects import SUBJECTS

CHAPTER = "10-speed-and-accuracy"
HALF_A_CODE = 0.5


def codes_apart(light: Floats, other: Floats, weights: Floats | None = None) -> float:
    """RMS of the difference of two pictures of linear light, in codes of 255."""
    square = (255 * (_encoded(light) - _encoded(other))) ** 2
    return float(np.sqrt(np.average(square, weights=weights)))


def _encoded(light: Floats) -> Floats:
    return np.asarray(encode_srgb(np.clip(light, 0, 1)))


@cache
def balloon() -> Floats:
    """(192, 240, 3) linear light."""
    return np.asarray(SUBJECTS["balloon"].draw(WHOLE), float)


def blurred(disc_px: float) -> Floats:
    """Blur by the transfer function of an even disc, on the picture and its mirror images."""
    picture = balloon()
    tiled = np.concatenate([picture, picture[::-1]], axis=0)
    tiled = np.concatenate([tiled, tiled[:, ::-1]], axis=1)
    along = (np.fft.fftfreq(size) for size in tiled.shape[:2])
    radius = np.pi * disc_px * np.maximum(np.hypot(*np.meshgrid(*along, indexing="ij")), 1e-9)
    passed = (2 * j1(radius) / radius)[..., None]
    spectrum = np.fft.fft2(tiled, axes=(0, 1)) * passed
    height, width = picture.shape[:2]
    return np.asarray(np.fft.ifft2(spectrum, axes=(0, 1)).real[:height, :width])


def with_fifth_power(corner_px: float) -> Floats:
    """Each pixel from farther out by so many pixels times the fifth power of r, 1 in the corner."""
    picture = balloon()
    rows, columns = picture.shape[:2]
    centre = np.array([(rows - 1) / 2, (columns - 1) / 2])[:, None, None]
    half = np.hypot(*centre.ravel())
    away = np.indices((rows, columns)) - centre
    r = np.hypot(*away) / half
    places = centre + away * (1 + corner_px / half * r**4)
    return np.stack(
        [map_coordinates(picture[..., c], places, order=5, mode="mirror") for c in range(3)], -1
    )


def gaussian_excess(mean: float) -> float:
    """Excess of the mean of a Gaussian's counts, rounded and cut off at 0."""
    counts = np.arange(int(mean + 12 * np.sqrt(mean) + 20))
    above, below = (norm.cdf((counts + side - mean) / np.sqrt(mean)) for side in (0.5, -0.5))
    chances = above - np.where(counts == 0, 0, below)
    return float((counts * chances).sum() / mean - 1)


def apart_from_poisson(mean: float) -> float:
    """Share of the counts of that Gaussian that would have to change to be Poisson's."""
    counts = np.arange(int(mean + 12 * np.sqrt(mean) + 20))
    above, below = (norm.cdf((counts + side - mean) / np.sqrt(mean)) for side in (0.5, -0.5))
    chances = above - np.where(counts == 0, 0, below)
    return float(np.abs(chances - poisson.pmf(counts, mean)).sum() / 2)


def white_without_falloff(corner_deg: float) -> float:
    """White, 4 : 3, whose corner lies so far off the axis: codes lost to cos⁴. Darker greys lose
    less."""
    slope = np.tan(np.radians(corner_deg))
    x, y = np.meshgrid(np.linspace(-0.8, 0.8, 161), np.linspace(-0.6, 0.6, 121))
    dimmed = np.cos(np.arctan(np.hypot(x, y) * slope)) ** 4
    return codes_apart(dimmed, np.ones_like(dimmed))


def later_bounces(albedo: float) -> float:
    """Two equal walls at a right angle, the lamp between them: one bounce against all."""
    angle = np.pi / 2
    lamp = np.stack([mean_lamp_light(angle / 2, angle)] * 2)
    one, every = (bounced(lamp, [albedo, albedo], angle, count) for count in (1, None))
    return codes_apart(one, every, np.broadcast_to(np.diff(EDGES), one.shape))


def sampled_wave(period_px: float) -> float:
    """A wave of half of full contrast: samples at points against means over pixels."""
    phase = 2 * np.pi * np.linspace(0, 1, 4000, endpoint=False)
    wave = 0.25 * np.sin(phase)
    return codes_apart(0.5 + wave, 0.5 + np.sinc(1 / period_px) * wave)


def float32_px(from_origin_m: float) -> float:
    """RMS in px of R p + t in float32, of points 10 m from the camera, f = 800 px."""
    rng = np.random.default_rng(0)
    across = rng.uniform([-3, -2], [3, 2], (20_000, 2))
    seen = np.column_stack([across, np.full(len(across), 10.0)])
    turn = exponential(rng.normal(0, 0.5, 3))
    centre = from_origin_m * np.array([0.6, 0.64, 0.48])
    world, t = (seen @ turn + centre).astype(np.float32), -(turn @ centre)
    found = world @ turn.T.astype(np.float32) + t.astype(np.float32)
    off = 800 * (found[:, :2] / found[:, 2:] - seen[:, :2] / seen[:, 2:])
    return float(np.sqrt((off**2).sum(axis=-1).mean()))


def what_may_be_left_out() -> Says:
    still = balloon()
    small, large = (codes_apart(blurred(disc), still) for disc in (0.3, 0.76))
    yield f"| blur | the disc is below 0.3 px | {small:.1f} codes | {large:.1f} codes at 0.76 px |"
    assert small < HALF_A_CODE < codes_apart(blurred(0.35), still)
    near, far = (codes_apart(with_fifth_power(corner), still) for corner in (0.1, 1.0))
    yield f"by less than 0.1 px | {near:.1f} codes | {far:.1f} codes at 1 px |"
    few, one = (100 * gaussian_excess(mean) for mean in (5, 1))
    others = 100 * apart_from_poisson(5)
    yield f"| {few:.1f} % in the mean; {others:.1f} % of the counts are others | {one:.0f} % in"
    near, far = map(white_without_falloff, (4, 20))
    yield f"lie within 4° of the axis | {near:.1f} codes | {far:.1f} codes at 20° |"
    assert near < HALF_A_CODE
    dark, white = map(later_bounces, (0.25, 0.8))
    yield f"| the albedo is below 0.25 | {dark:.1f} codes | {white:.0f} codes at 0.8 |"
    long, short = map(sampled_wave, (12, 4))
    yield f"| waves are longer than 12 px | {long:.1f} codes | {short:.1f} codes at 4 px |"
    near, far = map(float32_px, (1e4, 1e6))
    yield f"| the origin is within 10 km | {near:.2f} px | {far:.0f} px at 1000 km |"


FOCAL_PX, BASELINE_M, DEPTH_M = 800.0, 0.5, 10.0
NOISE_PX, POINTS = 0.3, 50

type Kind = type[np.floating]


def depth_m(disparity_px: float) -> float:
    return FOCAL_PX * BASELINE_M / disparity_px


def pose(world: Floats, seen_px: Floats, centre: Floats, kind: Kind) -> tuple[Floats, Floats]:
    """Rotation and place of the camera by ten Gauss–Newton steps, all in one format."""
    R, c, f = np.eye(3, dtype=kind), centre.astype(kind), kind(FOCAL_PX)
    p, seen = world.astype(kind), seen_px.astype(kind)
    for _ in range(10):
        q = (p - c) @ R.T
        x, y, z = q.T
        nothing = np.zeros_like(z)
        of_place = np.array([[f / z, nothing, -f * x / z**2], [nothing, f / z, -f * y / z**2]])
        of_turn = np.array([[nothing, z, -y], [-z, nothing, x], [y, -x, nothing]])
        by_point = np.moveaxis(of_place, -1, 0)
        columns = (by_point @ np.moveaxis(of_turn, -1, 0), -by_point @ R)
        slopes = np.concatenate(columns, axis=-1).reshape(-1, 6)
        off = (seen - f * q[:, :2] / z[:, None]).reshape(-1)
        step = np.linalg.lstsq(slopes, off, rcond=None)[0]
        R, c = exponential(step[:3].astype(float)).astype(kind) @ R, c + step[3:]
    return R.astype(float), c.astype(float)


def pose_errors(origin_m: Floats, kind: Kind, noise_px: float) -> tuple[float, float]:
    """RMS over a hundred cameras: of their places in m, of their turns in degrees."""
    rng = np.random.default_rng(0)
    places, turns = [], []
    for _ in range(100):
        depth = rng.uniform(5, 20, POINTS)
        across = rng.uniform([-0.4, -0.3], [0.4, 0.3], (POINTS, 2))
        q = np.column_stack([across * depth[:, None], depth])
        R = exponential(rng.normal(0, 0.1, 3))
        c = origin_m + rng.uniform(-1, 1, 3)
        seen = FOCAL_PX * across + noise_px * rng.standard_normal((POINTS, 2))
        found, place = pose(q @ R + c, seen, c + rng.normal(0, 0.05, 3), kind)
        apart = found @ R.T
        places.append(np.linalg.norm(place - c))
        turns.append(np.degrees(np.linalg.norm(apart - apart.T) / np.sqrt(8)))
    return root_mean_square(places), root_mean_square(turns)


def what_an_error_becomes() -> Says:
    disparity = FOCAL_PX * BASELINE_M / DEPTH_M
    yield f"has a disparity of {disparity:.0f} px"
    lens = depth_m(disparity - 0.1) - DEPTH_M
    yield f"in one picture | {100 * lens:.1f} cm in depth at 10 m |"
    noise = DEPTH_M / disparity * np.sqrt(2) * NOISE_PX
    yield f"| {100 * noise:.0f} cm for one point, {10 * noise:.1f} cm for the mean of 100 |"
    enough = next(n for n in range(1, 100) if noise / np.sqrt(n) < lens)
    yield f"From {enough} points on, the 0.1 px"


def what_an_error_becomes_in_a_pose() -> Says:
    near, far = np.zeros(3), np.array([4e5, 4e6, 100.0])
    place, turn = pose_errors(near, np.float64, NOISE_PX)
    yield f"| noise of 0.3 px in one picture | {1000 * place:.0f} mm and {turn:.2f}° in pose |"
    exact, _ = pose_errors(near, np.float64, 0.0)
    assert exact < 1e-12
    single, _ = pose_errors(near, np.float32, 0.0)
    assert 0.0003 < 1000 * single < 0.0007
    yield "| float32, the origin near the camera | 0.0005 mm in pose |"
    far_off, turned = pose_errors(far, np.float32, 0.0)
    yield f"| float32, the origin 4000 km away | {100 * far_off:.0f} cm and {turned:.1f}° in pose |"
