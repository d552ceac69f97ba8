"""Chapter 9: depth from two views."""

from math import isclose, sqrt

import numpy as np
from support.worked_numbers import Says, source

from simulations.models.projection.pinhole import intrinsics, project
from simulations.models.projection.two_views import (
    epipolar_lines,
    fundamental_matrix,
)
from simulations.scenes.formation_pipeline.stations import stations, travel

CHAPTER = "09-connections"


def disparity_px(depth_m: float, focal_px: float, baseline_m: float) -> float:
    K = intrinsics(focal_px, (0.0, 0.0))
    left, _ = project([1.0, 0.0, depth_m], K)
    right, _ = project([1.0 - baseline_m, 0.0, depth_m], K)
    return float(left[0] - right[0])


def a_line_from_its_two_ends() -> Says:
    cos, sin = np.cos(np.radians(20)), np.sin(np.radians(20))
    K, R = intrinsics(160, (0, 0)), np.array([[cos, 0, sin], [0, 1, 0], [-sin, 0, cos]])
    direction = np.linalg.solve(K, (30, -40, 1))
    yield rf"$\mathbf{{d}} = ({', '.join(f'{entry:g}' for entry in direction)})$"
    turned = R @ direction
    yield r"\begin{bmatrix} " + r" \\ ".join(f"{entry:.3g}" for entry in turned) + r" \end{bmatrix}"
    end, _ = project(turned, K)
    yield f"$({end[0]:.1f}, {end[1]:.1f})$"
    epipole = -160 / np.tan(np.radians(20))
    yield rf"$x = -160/\tan 20^\circ = {epipole:.1f}$ px"
    yield f"it rises by {-end[1]:.1f} px on the {round(end[0], 1) - round(epipole, 1):.1f} px"
    F = fundamental_matrix(K, K, R, R @ (-0.5, 0, 0))
    line, _ = epipolar_lines(F, (30, -40))
    assert np.allclose([line @ (*end, 1), line @ (epipole, 0, 1)], 0, atol=1e-9)


def averaging_frames() -> Says:
    """Random noise is drawn anew in each frame, the fixed pattern once."""
    random = np.random.default_rng(0)
    pattern = 2 * random.standard_normal(20_000)
    frames = pattern + 8 * random.standard_normal((16, 20_000))
    assert isclose(frames.mean(axis=0).std(), sqrt(8**2 / 16 + 2**2), rel_tol=0.02)
    yield rf"$\sqrt{{4 + 4}} = {frames.mean(axis=0).std():.1f}$"


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
    """The other geometric answer, a shifted principal point, would not keep the proportion."""
    yield "reports 2.1 m for a post 2 m away, and 10.5 m for a wall 10 m away"
    near, far = (disparity_px(depth, 800, 0.10) for depth in (2.0, 10.0))
    assert isclose(1.05 * 80 / near, 2.1)
    assert isclose(1.05 * 80 / far, 10.5)
    shift = near - 80 / 2.1
    assert isclose(80 / (near - shift), 2.1)
    assert 80 / (far - shift) > 12


WORKED = (
    a_line_from_its_two_ends,
    averaging_frames,
    the_links_of_the_first_chapter,
    the_least_noisy_mean,
    a_focal_length_off_by_five_percent,
)
