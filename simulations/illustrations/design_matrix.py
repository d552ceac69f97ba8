"""The equations of a homography in pixels and in normalised coordinates: the sizes of their
columns, and what rounding makes of the solution."""

from statistics import median

import numpy as np

from simulations.engine.drafting import label
from simulations.engine.drawing import line, rectangle
from simulations.engine.illustration import Illustration, Panel
from simulations.engine.plotting import Axis
from simulations.models.arrays import Floats
from simulations.models.geometry.homography_estimation import normalisation
from simulations.models.geometry.transforms import apply_homography

POSTER = np.array([[0.92, -0.17, 310.0], [0.12, 0.88, -140.0], [4e-5, -6e-5, 1.0]])
"""From the first picture to the second, in pixels."""
LOW, HIGH = (3000.0, 2000.0), (3500.0, 2375.0)
"""Two opposite corners of the poster in the first picture."""
SEEDS = range(100, 116)
COLUMNS = ("x", "y", "1", "x", "y", "1", "x′x", "x′y", "x′")
HEIGHTS = Axis(0.1, 1e8, 172, 16, log=True)


def design(before: Floats, after: Floats) -> Floats:
    """(2N, 9): each pair of points says that x' (h₃·x) = h₁·x and y' (h₃·x) = h₂·x."""
    ones = np.column_stack([before, np.ones(len(before))])
    above, below = (-after[:, axis, None] * ones for axis in (0, 1))
    upper = np.hstack([ones, 0 * ones, above])
    return np.asarray(np.vstack([upper, np.hstack([0 * ones, ones, below])]))


def equations(seed: int, *, normalised: bool) -> tuple[Floats, Floats, Floats]:
    """The design matrix of 40 pairs, and the maps (3, 3) to the coordinates of either picture."""
    before = np.random.default_rng(seed).uniform(LOW, HIGH, (40, 2))
    points = before, apply_homography(POSTER, before)[0]
    maps = [normalisation(p) if normalised else np.eye(3) for p in points]
    T, U = (np.asarray(each, float) for each in maps)
    return design(*(apply_homography(m, p)[0] for m, p in zip((T, U), points, strict=True))), T, U


def condition(*, normalised: bool) -> float:
    """Largest singular value over the last but one: the last belongs to the solution. Median."""
    sizes = [
        np.linalg.svd(equations(seed, normalised=normalised)[0], compute_uv=False) for seed in SEEDS
    ]
    return median(float(s[0] / s[7]) for s in sizes)


def errors_px(*, normalised: bool, squared: str = "") -> list[float]:
    """RMS error of the mapped poster in the second picture for each seed: by the singular vectors
    of A, or by the eigenvectors of AᵀA, formed in the format ``squared``."""
    found = []
    across, down = np.linspace(LOW, HIGH, 12).T
    check = np.stack(np.meshgrid(across, down), axis=-1).reshape(-1, 2)
    for seed in SEEDS:
        A, T, U = equations(seed, normalised=normalised)
        if squared:
            B = A.astype(squared)
            h = np.linalg.eigh((B.T @ B).astype(float))[1][:, 0]
        else:
            h = np.linalg.svd(A)[2][8]
        H = np.linalg.solve(U, h.reshape(3, 3) @ T)
        off = apply_homography(H, check)[0] - apply_homography(POSTER, check)[0]
        found.append(float(np.sqrt((off**2).sum(axis=1).mean())))
    return found


def _panel(name: str, title: str, *, normalised: bool) -> Panel:
    A = equations(SEEDS[0], normalised=normalised)[0]
    sizes = np.sqrt((A**2).mean(axis=0))
    marks = [line((50, HEIGHTS.place(0.1)), (392, HEIGHTS.place(0.1)), "muted")]
    for power in range(0, 9, 2):
        y = HEIGHTS.place(10.0**power)
        marks.append(line((50, y), (392, y), "muted thin faint"))
        words = f"10^{{{power}}}" if power else "1"
        marks.append(label((44, y + 5), words, "muted small", "end"))
    for column, size in enumerate(sizes):
        top, foot = HEIGHTS.place(float(size)), HEIGHTS.place(0.1)
        marks.append(rectangle((58 + 37 * column, top), 24, foot - top, "image fill"))
        marks.append(label((70 + 37 * column, foot + 18), COLUMNS[column], "small", "middle"))
    return Panel(name, title, 400.0, 198.0, overlay="".join(marks))


def draw() -> Illustration:
    words = (
        "Typical sizes of the nine columns of the matrix, on a logarithmic axis. In pixels they "
        "go from 0.7 to nine million, in normalised coordinates from 0.7 to 1.8."
    )
    return Illustration(
        (
            _panel("pixels", "Pixels", normalised=False),
            _panel("normalised", "Normalised", normalised=True),
        ),
        words,
    )
