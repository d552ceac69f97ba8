"""Chapter 9: depth from two views."""

from math import atan, degrees, isclose, sqrt

import numpy as np
from support.worked_numbers import Says, source

from simulations.models.projection.pinhole import intrinsics, project
from simulations.scenes.formation_pipeline.stations import stations, travel

CHAPTER = "09-connections"


def disparity_px(depth_m: float, focal_px: float, baseline_m: float) -> float:
    K = intrinsics(focal_px, (0.0, 0.0))
    left, _ = project([1.0, 0.0, depth_m], K)
    right, _ = project([1.0 - baseline_m, 0.0, depth_m], K)
    return float(left[0] - right[0])


def a_finger_and_two_eyes() -> Says:
    near, far = (2 * degrees(atan(3.2 / distance)) for distance in (25, 60))
    yield f"by about {near:.0f}°, since each eye is some 3.2 cm from the middle"
    yield rf"$2\arctan(3.2/25) = {near:.1f}^\circ$"
    yield f"At arm's length, 60 cm, it jumps by {far:.0f}°"


def counting_equations() -> Says:
    yield rf"$12 \cdot 50 \cdot 2 = {12 * 50 * 2}$"
    yield rf"$12 \cdot 6 = {12 * 6}$"


def how_well_depth_is_seen() -> Says:
    for depth, shorter in ((4, 19.5), (20, 3.5)):
        disparity = disparity_px(depth, 800, 0.10)
        assert isclose(disparity - shorter, 0.5)
        yield f"{disparity:.0f}$ px"
        yield f"With $d = {disparity - 0.5:.1f}$ px"
    near, far = 80 / 19.5, 80 / 3.5
    yield f"at $80/19.5 = {near:.2f}$ m: an error of {100 * (near - 4):.0f} cm"
    yield f"we would believe {far:.1f} m: an error of {far - 20:.1f} m"
    assert 27 < (far - 20) / (near - 4) < 30, "nearly thirty times the error"


def disparities_of_the_figure() -> Says:
    yield r"These are $160 \cdot 1/4$ and $160 \cdot 1/2$"
    assert (disparity_px(4, 160, 1), disparity_px(2, 160, 1)) == (40, 80)


def disparity_and_depth() -> Says:
    yield f"$Z = fb/d = 80/16 = {80 / 16:g}$ m"


def averaging_frames() -> Says:
    yield "- [x] `sqrt(16)`\n"
    frames = np.random.default_rng(0).standard_normal((16, 20_000))
    assert isclose(frames.mean(axis=0).std(), 1 / sqrt(16), rel_tol=0.02)


def the_links_of_the_first_chapter() -> Says:
    """Chain and table have the figure's links, in its order."""
    _, *links = [station.title for station in stations(travel(4.0, 0.6, 0))]
    yield from (rf"\to \text{{{link.lower()}}}" for link in links)
    text = source(CHAPTER)
    rows = [text.index(f"\n| {link} | ") for link in links]
    assert rows == sorted(rows)
    assert len(links) == 7
    yield "Five of the seven lose information"


def the_least_noisy_mean() -> Says:
    """Weights of one over the variance: no others do better, here among 201 for two exposures."""
    yield "one over the variance that it now has. Of all weighted means, that one has the least"
    variances = np.array([9.0, 2.0])
    inverse = 1 / variances
    best = np.sum((inverse / inverse.sum()) ** 2 * variances)
    share = np.linspace(0, 1, 201)
    assert np.all(share**2 * variances[0] + (1 - share) ** 2 * variances[1] >= best - 1e-12)


def a_focal_length_off_by_five_percent() -> Says:
    yield "A focal length that is 5 % too long makes all depths 5 % too large."
    for depth in (2.0, 4.0, 20.0):
        disparity = disparity_px(depth, 800, 0.10)
        assert isclose(1.05 * 800 * 0.10 / disparity, 1.05 * depth)


WORKED = (
    a_finger_and_two_eyes,
    counting_equations,
    how_well_depth_is_seen,
    disparities_of_the_figure,
    disparity_and_depth,
    averaging_frames,
    the_links_of_the_first_chapter,
    the_least_noisy_mean,
    a_focal_length_off_by_five_percent,
)
