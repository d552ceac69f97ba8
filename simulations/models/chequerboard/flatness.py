"""Whether corners lie on one plane, behind a lens that is not known.

A plane is seen through a homography, and a lens moves its image along the radius and, decentred, a
little aside. In the inverse model of distortion all of that is linear but the homography.
"""

import numpy as np

from simulations.models.arrays import Floats
from simulations.models.geometry.homography_estimation import estimate_homography
from simulations.models.geometry.transforms import apply_homography

STEPS = 6
TERMS = 5
"""Terms of the lens: r², r⁴, r⁶ and two of decentring."""


def flat_residuals(places: Floats, indices: Floats, middle: Floats) -> Floats:
    """(N, 2) what a homography and a lens about ``middle`` leave of corners (N, 2), in px.

    ``indices`` (N, 2) are columns and rows. NaN where these do not determine a homography.
    """
    H, valid = estimate_homography(indices, places)
    if not valid:
        return np.full(places.shape, np.nan)
    away = places - middle
    reach = float(np.hypot(*away.T).max())
    away = away / reach
    bends = _bends(away)
    scaled = np.diag([1.0 / reach, 1.0 / reach, 1.0]) @ np.array(
        [[1, 0, -middle[0]], [0, 1, -middle[1]], [0, 0, 1]]
    )
    h = (scaled @ H).ravel()
    h = h / h[8]
    lens = np.zeros(TERMS)
    for _ in range(STEPS):
        rest, slopes = _linearised(h, indices, away)
        rest = rest + bends @ lens
        system = np.concatenate([bends, -slopes], axis=2).reshape(-1, TERMS + 8)
        size = np.linalg.norm(system, axis=0) + 1e-12
        step = np.linalg.lstsq(system / size, -rest.ravel(), rcond=1e-9)[0] / size
        lens += step[:TERMS]
        h[:8] += step[TERMS:]
    rest, _ = _linearised(h, indices, away)
    return reach * (rest + bends @ lens)


def _bends(away: Floats) -> Floats:
    """(N, 2, 5) how each term of the lens moves a point."""
    x, y = away.T
    s = x * x + y * y
    radial = [away * (s**power)[:, None] for power in (1, 2, 3)]
    aside = [np.stack([s + 2 * x * x, 2 * x * y], -1), np.stack([2 * x * y, s + 2 * y * y], -1)]
    return np.stack(radial + aside, axis=-1)


def _linearised(h: Floats, indices: Floats, away: Floats) -> tuple[Floats, Floats]:
    """(N, 2) points less those of the homography, and (N, 2, 8) the derivatives of the latter."""
    u, v = np.asarray(indices, float).T
    mapped, _ = apply_homography(h.reshape(3, 3), np.stack([u, v], axis=-1))
    w = h[6] * u + h[7] * v + h[8]
    slopes = np.zeros((len(u), 2, 8))
    for axis in range(2):
        slopes[:, axis, 3 * axis] = u / w
        slopes[:, axis, 3 * axis + 1] = v / w
        slopes[:, axis, 3 * axis + 2] = 1.0 / w
        slopes[:, axis, 6] = -mapped[:, axis] * u / w
        slopes[:, axis, 7] = -mapped[:, axis] * v / w
    return away - mapped, slopes
