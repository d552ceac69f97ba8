"""The printed standard errors: over simulated cases, deviations from the truth have their size.

The root mean square of n deviations, in standard errors, itself has the relative standard error
1 / √(2n): 7 % for the 100 of most rows. So it is given for the cases of each row, and its bounds
let no factor of 1.2 pass, whatever chance has made of it. Models are called directly.
"""

import math
from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import cache, partial

import numpy as np
import pytest
from scipy.ndimage import gaussian_filter
from scipy.special import ndtr
from support.charts import DSNU_E, PRNU, SENSOR, gaussian_edge, gaussian_half, pairs_of, scored
from support.drawn_lines import (
    CENTRE,
    FOCAL,
    HEIGHT,
    SIZE,
    above,
    floor_point,
    image_of,
    lines_along_axes,
    random_pose,
)

from simulations.engine.controls import PointLists
from simulations.engine.photograph import Photograph
from simulations.models.arrays import Floats
from simulations.models.calibration.board_shape import flat_shape
from simulations.models.calibration.camera import Camera, predicted
from simulations.models.calibration.left_out import values_by_count
from simulations.models.calibration.model_choice import as_chosen, fitted
from simulations.models.calibration.shape_size import measure_shape
from simulations.models.calibration.simulated import Sitting, sitting
from simulations.models.chequerboard.board import Board
from simulations.models.color.srgb import decode_srgb, encode_srgb
from simulations.models.color.tone_curve import TYPICAL, tone_by_exposures, tone_curve
from simulations.models.distortion.lens_model import Distortion
from simulations.models.projection.picture_lens import PictureLens, lens_by_lines, unknown_lens
from simulations.models.projection.pinhole import field_of_view_rad
from simulations.models.projection.single_view import SingleView
from simulations.models.projection.vanishing_lines import pixel_of
from simulations.models.sampling.slanted_edge import measure, read_edge
from simulations.models.sampling.slanted_edge_pixels import pixels_beside
from simulations.models.sampling.slanted_edge_tone import tone_error
from simulations.models.sensor.photon_transfer_fit import BEND, Estimate, characterise, electrons
from simulations.models.sensor.photon_transfer_pair import Level, measure_pair
from simulations.models.sensor.photon_transfer_standard import standard_estimates
from simulations.scenes.single_view.lines import Lines
from simulations.scenes.single_view.measuring import camera_of, lengths_of

type Scores = Mapping[str, float]
"""Deviations of numbers from their truth, in standard errors."""


def straight_sensor(rng: np.random.Generator) -> Scores:
    """A sensor whose response is known to be straight, by twelve pairs."""
    pairs = pairs_of(36, int(rng.integers(10**9)))
    levels = [measure_pair(pair, SENSOR.highest_dn) for pair in pairs]
    found = characterise(levels, levels[0].mean_dn, SENSOR.highest_dn)
    full = electrons(found.noise, 1000.0) if found.noise else None
    assert full
    estimates = {
        "gain": (found.gain, SENSOR.gain_e_per_dn),
        "read noise": (found.read_noise, SENSOR.read_noise_e),
        "saturation": (found.saturation, SENSOR.full_well_e),
        "PRNU": (found.prnu, PRNU),
        "DSNU": (found.dsnu, DSNU_E),
        "electrons": (full, 4000.0),
    }
    return scored(estimates)


@cache
def cells() -> Floats:
    """(96, 32) what cells add to the light: a pattern whose standard deviation is 12 DN."""
    return 12.0 * np.random.default_rng((1, 7)).standard_normal((96, 32))


def pair(rng: np.random.Generator) -> Scores:
    """Two frames of single cells' noise of 8 DN, of rows' of 4 DN, and of the cells' pattern."""
    noise, rows = rng.normal(0.0, 8.0, (2, 96, 32)), rng.normal(0.0, 4.0, (2, 96, 1))
    level = measure_pair(np.rint(500 + cells() + noise + rows).astype(np.uint16), 4095)
    return {
        "noise": (level.noise_dn2 - 80.0) / level.noise_error_dn2,
        "pattern": (level.pattern_dn2 - cells().var()) / level.pattern_error_dn2,
        "row noise": (level.row_dn2 - 16.0) / level.row_error_dn2,
    }


def drawn_levels(
    rng: np.random.Generator,
    light_e: Floats,
    full_e: float,
    *,
    bend: float = 0.0,
    rows_e: float = 0.0,
    read_e: float = SENSOR.read_noise_e,
) -> list[Level]:
    """Levels with the noise of frames of 96 × 96 pixels; full wells have none."""
    gain, pixels = SENSOR.gain_e_per_dn, 96 * 96
    levels, chance, rows = [], math.sqrt(2 / pixels), (rows_e / gain) ** 2
    for light in light_e:
        mean = min(light, full_e)
        slope = 1 - 2 * bend * mean / full_e
        shot = mean * slope**2 if light < full_e - 2 * math.sqrt(full_e) else 0.01 * mean
        noise = (shot + read_e**2) / gain**2 + rows
        row_error = (noise / 96 + rows) * math.sqrt(2 / 96)
        pattern = (PRNU * mean * slope / gain) ** 2 + (DSNU_E / gain) ** 2
        pattern_error = math.sqrt(noise * (noise + 2 * pattern) / pixels)
        levels.append(
            Level(
                mean_dn=mean * (1 - bend * mean / full_e) / gain,
                noise_dn2=noise * (1 + chance * rng.standard_normal()),
                noise_error_dn2=noise * chance,
                pattern_dn2=pattern + pattern_error * rng.standard_normal(),
                pattern_error_dn2=pattern_error,
                noise_in_codes=noise,
                correlation=0.0,
                clipped=0.0,
                pixels=pixels,
                row_dn2=rows + row_error * rng.standard_normal(),
                row_error_dn2=row_error,
            )
        )
    return levels


def bent_sensor(rng: np.random.Generator) -> Scores:
    """A sensor whose response bends, with noise of rows, by twelve levels."""
    gain, full, bend = SENSOR.gain_e_per_dn, SENSOR.full_well_e, BEND * rng.standard_normal()
    light = np.linspace(0.0, 0.95 * full, 12)
    levels = drawn_levels(rng, light, full, bend=bend, rows_e=8.0)
    found = characterise(levels, 0.0, full / gain, 1.0, bend=BEND)
    assert found.noise
    middle, last = (electrons(found.noise, levels[at].mean_dn) for at in (6, 11))
    return scored(
        {
            "gain": (found.gain, gain),
            "row noise": (found.row_noise, 8.0),
            "bend": (found.bend, bend),
            "electrons in the middle": (middle, light[6]),
            "electrons near full": (last, light[11]),
        }
    )


def rough_sensor(rng: np.random.Generator) -> Scores:
    """Six levels, none of them dark, that scatter about the line more than their noise explains."""
    full, gain, read = SENSOR.full_well_e, SENSOR.gain_e_per_dn, 100.0
    levels = [
        replace(level, noise_dn2=level.noise_dn2 * (1 + 0.03 * rng.standard_normal()))
        for level in drawn_levels(rng, np.linspace(0.1, 0.65, 6) * full, full, read_e=read)
    ]
    found = characterise(levels, 0.0, full / gain)
    return scored({"gain": (found.gain, gain), "read noise": (found.read_noise, read)})


def full_sensor(rng: np.random.Generator) -> Scores:
    """A sensor that is full somewhere between two levels; its read noise known to a tenth."""
    full, gain, read = SENSOR.full_well_e, SENSOR.gain_e_per_dn, SENSOR.read_noise_e
    levels = drawn_levels(rng, np.linspace(0.0, rng.uniform(1.05, 1.2) * full, 14), full)
    found = characterise(levels, 0.0, full / gain, 0.7)
    unsure = Estimate(read + 0.1 * read * rng.standard_normal(), 0.1 * read)
    made = standard_estimates(levels, 0.0, [math.nan] * 14, replace(found, read_noise=unsure))
    true, dark = full - 2 * math.sqrt(full), math.hypot(read, gain / math.sqrt(12)) + 0.5
    return scored(
        {"full well": (made.full_well, true), "dynamic range": (made.dynamic_range, true / dark)}
    )


def shutters(rng: np.random.Generator) -> Scores:
    """Linearity of a straight response by shutters that are off by chance."""
    off, count = 0.01, 40
    light = np.linspace(0.06, 0.65, count)
    levels = drawn_levels(rng, light * SENSOR.full_well_e, SENSOR.full_well_e)
    found = characterise(levels, 0.0, SENSOR.highest_dn)
    times = light * np.exp(off * rng.standard_normal(count))
    linearity = standard_estimates(levels, 0.0, times.tolist(), found).linearity_error
    return scored({"linearity": (linearity, off * math.sqrt(2 / math.pi * (1 - 2 / count)))})


def toned_frames(rng: np.random.Generator, off: float = 0.05) -> Scores:
    """A tone curve by eight frames whose shutters are off by so many stops."""
    light, strength = np.geomspace(0.01, 0.7, 8), rng.uniform(-0.6, 0.6)
    toned = decode_srgb(tone_curve(encode_srgb(light), strength))
    found = tone_by_exposures(toned, light * 2 ** (off * rng.standard_normal(8)))
    assert found
    return {"strength": (found[0] - strength) / found[1]}


def edge(rng: np.random.Generator, shared: bool = False) -> Scores:
    """A Gaussian edge with noise of single pixels, or noise that neighbours share."""
    shape, spot, tilt = (160, 48) if shared else (80, 48), 0.9, rng.uniform(4.0, 8.0)
    noise = rng.normal(0.0, 0.02, shape)
    if shared:
        noise = 2.0 * gaussian_filter(noise, 0.7)
    reading = read_edge(0.1 + 0.6 * (gaussian_edge(*shape, tilt, spot) + noise))
    curve, half = reading.curve, reading.half_contrast()
    (light,), (light_error,) = curve.spread([-3.0]), curve.spread_error([-3.0])
    (rise,), (rise_error,) = curve.rise([4.0], 2.0)
    (wide, contrast), (wide_error, contrast_error) = reading.transfer([0.03, 0.15])
    other = 0.1 + 0.6 * (gaussian_edge(*shape, tilt, spot) + rng.permutation(noise))
    (here, by_here), (there, by_there) = (
        measure(pixels_beside(each)).curve.middle
        for each in (reading.pixels.line, reading.pixels.line.on(other))
    )
    true_wide, true_contrast = (math.exp(-2 * (math.pi * spot * f) ** 2) for f in (0.03, 0.15))
    return {
        "MTF50": (half.frequency - gaussian_half(spot)) / half.error,
        "contrast": (contrast - true_contrast) / contrast_error,
        "contrast of wide waves": (wide - true_wide) / wide_error,
        "light": (light - ndtr(-3.0 / spot)) / light_error,
        "rise": (rise - ndtr(5.0 / spot) + ndtr(3.0 / spot)) / rise_error,
        "lateral colour": (there - here) / math.hypot(by_here, by_there),
    }


def toned_edge(rng: np.random.Generator) -> Scores:
    """An edge without noise in a file whose tone curve is not known."""
    picture = gaussian_edge(72, 72, 5.0, 0.9)
    toned = tone_curve(encode_srgb(0.06 + 0.6 * picture), 0.9 * rng.random())
    reading = read_edge(decode_srgb(toned))
    half = reading.half_contrast().frequency
    return {"MTF50": (half - gaussian_half(0.9)) / tone_error(reading, TYPICAL)}


@cache
def room(number: int) -> tuple[Floats, Floats, Floats, tuple[Floats, ...]]:
    """A pose; lines along the axes (N, 2, 2) in the picture, with their axes; and the ends of two
    lengths on the floor and one above it, in metres."""
    rng = np.random.default_rng((1, number))
    pose = random_pose(rng)
    ends, axes = lines_along_axes(pose, rng)
    a, b, c, d = (floor_point(pose, rng) for _ in range(4))
    return pose, ends, axes, tuple(np.array(each) for each in ((a, b), (c, d), (a, above(a, 1.0))))


def drawn_lines(
    rng: np.random.Generator, k1: float = 0.0, calibrated: tuple[float, float] | None = None
) -> Scores:
    """Lines in one of ten rooms, with errors of their ends. The lens is ideal; or its ``k1`` is
    found by edges, and the error of an end with it; or it was calibrated to these errors."""
    lens = PictureLens(CENTRE, (FOCAL, FOCAL), Distortion(k1=k1))
    pose, ends, axes, stretches = room(int(rng.integers(10)))
    known = lens
    if k1:
        share = np.linspace(0.0, 1.0, 12)[:, None]
        edges = [lens.bent(a + share * (b - a)) for a, b in ends]
        noisy = [each + rng.normal(0.0, 0.3, each.shape) for each in edges]
        known = lens_by_lines(noisy, unknown_lens(SIZE))
    if calibrated:
        unit = FOCAL * math.exp(calibrated[0] * rng.standard_normal())
        x, y = rng.normal(CENTRE, calibrated[1]).tolist()
        known = replace(lens, centre=(x, y), unit=(unit, unit), pinhole_errors=calibrated)
    images = np.array([image_of(each, pose) for each in stretches])
    drawn = (*(ends[axes == axis] for axis in range(3)), images[:2], images[2:])
    clicked = tuple(lens.bent(each) + rng.normal(0.0, 1.0, each.shape) for each in drawn)
    counts = tuple(np.ones(len(each), bool) for each in clicked)
    lines = Lines((800, 600), PointLists(), clicked, counts)
    found = camera_of(lines, (known, ""), 1.0, False, OWN if k1 else None)
    true_known, true_length, _ = (math.dist(*each) for each in stretches)
    made, view = lengths_of(lines, found, true_known, "floor"), found.view
    assert view is not None
    true = replace(view, focal_px=FOCAL, centre=CENTRE, R=pose[:3, :3], lean=0.0)

    def angles(view: SingleView) -> Floats:
        return np.array((view.pitch, view.roll, field_of_view_rad(view.focal_px, 800)))

    pitch, roll, field = (angles(view) - angles(true)) / view.spread(angles)
    (length, length_error), (height, height_error) = made.floor[1], made.height[0]
    scores = {
        "focal length": math.log(view.focal_px / FOCAL) / found.focal_error,
        "pitch": pitch,
        "roll": roll,
        "field of view": field,
        "length": (length - true_length) / length_error,
        "height": (height - 1.0) / height_error,
        "distance": (made.distance[0] - HEIGHT) / made.distance[1],
    }
    if k1:
        unit = k1 * (known.unit[0] / FOCAL) ** 2
        scores["k1 by edges"] = (known.distortion.k1 - unit) / known.error
        scores["k1"] = (view.lens.distortion.k1 - unit) / math.sqrt(view.covariance[6, 6])
    point, spread, finite = pixel_of(view.vanishing[1], view.vanishing_covariances[1])
    off = point - pixel_of(true.vanishing[1], np.zeros((3, 3)))[0]
    if finite:
        scores["vanishing point"] = math.sqrt(off @ np.linalg.solve(spread, off) / 2)
    return scores


def bowed_edges(rng: np.random.Generator) -> Scores:
    """k₁ by edges that are not quite straight, each by its own bow."""
    lens, (_, ends, _, _) = PictureLens(CENTRE, (400.0, 400.0), Distortion(k1=-0.05)), room(0)
    share, edges = np.linspace(0.0, 1.0, 30), []
    for first, last in ends:
        along = (last - first) / np.hypot(*(last - first))
        bow = rng.normal(0.0, 1.0) * 4 * share * (1 - share) + rng.normal(0.0, 0.1, share.shape)
        straight = lens.bent(first + share[:, None] * (last - first))
        edges.append(straight + bow[:, None] * np.array((-along[1], along[0])))
    found = lens_by_lines(edges, replace(lens, distortion=Distortion(), error=1.0))
    return {"k1": (found.distortion.k1 + 0.05) / found.error}


OWN = Photograph(1, np.zeros((600, 800, 3), np.uint8))


@cache
def boards(number: int, lens: Distortion) -> Sitting:
    """Ten photographs of a board."""
    camera = Camera(600.0, 600.0, 322.0, 236.0, lens)
    return sitting(camera, (640, 480), 10, Board(7, 6, 1.0), number)


def calibrated(rng: np.random.Generator) -> Scores:
    """A camera from one of five sets of photographs."""
    made = boards(int(rng.integers(5)), Distortion(k1=-0.25, k2=0.08))
    views = made.views(0.1, int(rng.integers(10**9)))
    trial = fitted(views, made.camera, made.poses, "k1k2")
    known, names = trial.uncertainty, ("fx", "cx", "k1")
    at = [trial.free.index(name) for name in names]
    off = trial.fit.camera.values(names) - made.camera.values(names)
    printed = np.array([known.errors[name] for name in names])
    grown = values_by_count(views, trial.fit, trial.free, known.sigma_px, "fx", 6)
    return {
        **dict(zip(names, off / printed, strict=True)),
        "fx, if all is noise": off[0] / math.sqrt(known.covariance[0, 0]),
        "k1, by photographs": off[2] / known.spread[at[2]],
        "fx of six photographs": (grown.value[0] - made.camera.fx) / grown.error[0],
    }


def bent_board(rng: np.random.Generator) -> Scores:
    """The shape of a board that is bent, with squares that are too high."""
    made = boards(0, Distortion(k1=-0.25, k2=0.08))
    shape = replace(flat_shape("bent", made.views(0.0)), values=(0.1, 0.05, 0.0, 0.02))
    poses = replace(made.poses, shape=shape)
    board = made.views(0.1, int(rng.integers(10**9)))
    moved = predicted(made.camera, poses, board.board) - made.pixels
    views = replace(board, pixels=board.pixels + moved)
    trial = fitted(views, made.camera, poses, "k1k2")
    found = measure_shape(views, trial)
    true = measure_shape(views, replace(trial, fit=replace(trial.fit, poses=poses)))
    return {
        "height": (found.height - true.height) / found.height_error,
        "aspect": (found.aspect - true.aspect) / found.aspect_error,
    }


def off_centre(rng: np.random.Generator) -> Scores:
    """The principal point by a model without the lens's decentring, which is a chance one."""
    made = boards(0, Distortion(k1=-0.25, k2=0.08))
    p1, p2 = rng.normal(0.0, 2e-3, 2).tolist()
    camera = replace(made.camera, lens=replace(made.camera.lens, p1=p1, p2=p2))
    moved = predicted(camera, made.poses, made.corners) - made.pixels
    board = made.views(0.02, int(rng.integers(10**9)))
    views = replace(board, pixels=board.pixels + moved)
    both = [fitted(views, camera, made.poses, lens) for lens in ("k1k2", "p1p2")]
    chosen = as_chosen(both[0], tuple(both))
    off, known = chosen.fit.camera.cx - camera.cx, chosen.uncertainty
    return {"cx": off / known.errors["cx"]}


ROWS: dict[str, tuple[Callable[[np.random.Generator], Scores], int, dict[str, float]]] = {
    "pair of frames": (pair, 300, {"noise": 1.08, "pattern": 0.89, "row noise": 1.02}),
    "straight sensor": (straight_sensor, 100, {
        "gain": 0.90, "read noise": 0.87, "saturation": 0.90,
        "PRNU": 1.03, "DSNU": 0.87, "electrons": 0.88,
    }),
    "bent sensor": (bent_sensor, 200, {
        "gain": 0.92, "row noise": 0.92, "bend": 0.97,
        "electrons in the middle": 0.90, "electrons near full": 0.94,
    }),
    "rough sensor": (rough_sensor, 300, {"gain": 1.34, "read noise": 1.32}),
    "full sensor": (full_sensor, 200, {"full well": 0.88, "dynamic range": 1.06}),
    "shutters": (shutters, 200, {"linearity": 1.09}),
    "tone curve by exposures": (toned_frames, 20, {"strength": 0.86}),
    "tone curve by rough shutters": (partial(toned_frames, off=0.15), 20, {"strength": 0.65}),
    "edge": (edge, 100, {
        "MTF50": 0.98, "contrast": 0.89, "contrast of wide waves": 0.88,
        "light": 1.02, "rise": 0.90, "lateral colour": 0.66,
    }),
    "edge, noise of neighbours": (partial(edge, shared=True), 100, {
        "MTF50": 0.99, "contrast": 1.09, "contrast of wide waves": 1.05,
        "light": 0.99, "rise": 1.05, "lateral colour": 1.17,
    }),
    "edge, unknown tone curve": (toned_edge, 40, {"MTF50": 0.92}),
    "lines": (drawn_lines, 120, {
        "focal length": 1.01, "pitch": 1.01, "roll": 0.85, "field of view": 1.01,
        "length": 0.97, "height": 1.00, "distance": 1.03, "vanishing point": 0.92,
    }),
    "lines behind a lens": (partial(drawn_lines, k1=-0.05), 60, {
        "focal length": 0.86, "pitch": 0.73, "roll": 0.78, "field of view": 0.86,
        "length": 0.84, "height": 0.79, "distance": 0.68, "k1 by edges": 0.80, "k1": 0.82,
        "vanishing point": 0.80,
    }),
    "edges that bow": (bowed_edges, 100, {"k1": 1.15}),
    "lines behind a calibrated lens": (partial(drawn_lines, calibrated=(0.01, 4.0)), 80, {
        "focal length": 1.03, "pitch": 0.99, "roll": 0.96, "field of view": 1.03,
        "length": 0.94, "height": 0.96, "distance": 1.11, "vanishing point": 1.05,
    }),
    "camera": (calibrated, 120, {
        "fx": 0.80, "cx": 0.75, "k1": 0.64, "fx, if all is noise": 1.06,
        "k1, by photographs": 0.67, "fx of six photographs": 0.72,
    }),
    "bent board": (bent_board, 100, {"height": 1.06, "aspect": 0.80}),
    "camera, decentring left out": (off_centre, 100, {"cx": 0.63}),
}  # fmt: skip
"""Function, number of cases, and the root mean square of the deviations in these. It is off 1 by
chance, and where errors are larger by intention: the larger of two errors (edges, cameras), several
sources that may add up (tone curve, decentring), a place by one of the colours (lateral colour),
a third for √(1 / 12) (full well), few lines or photographs that tell an error roughly (lines behind
a lens, cameras, boards). Four degrees of freedom (rough sensor) make it √2."""


@pytest.mark.parametrize("row", ROWS)
def test_deviations_have_the_size_of_their_standard_errors(row: str) -> None:
    measured, cases, expected = ROWS[row]
    scores: dict[str, list[float]] = {name: [] for name in expected}
    for case in range(cases):
        for name, score in measured(np.random.default_rng(case)).items():
            scores[name].append(score)
    for name, found in scores.items():
        assert len(found) > 0.8 * cases, name
        ratio = float(np.sqrt(np.mean(np.square(found)))) / expected[name]
        assert 1 / 1.14 < ratio < 1.14, f"{name}: {ratio:.3f}"
