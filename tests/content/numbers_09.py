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
