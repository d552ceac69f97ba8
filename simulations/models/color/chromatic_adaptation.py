"""Chromatic adaptation: how a colour seen in one light would look in another.

The eye adapts the gain of each of its receptors to the light. A chromatic adaptation does the same:
it transforms to three responses, divides each by that of the old white, multiplies it by that of
the new one, and transforms back. The methods differ in the responses they take.

Colours are CIE XYZ, lights their chromaticities (x, y). Szeliski, 2nd ed., §2.3.2; Lam, Metamerism
and colour constancy, 1985 (Bradford); Hunt, Measuring Colour, 1987 (the cones).
"""

import numpy as np
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats, through_matrix
from simulations.models.color.chromaticity import white_xyz
from simulations.models.color.cie import rgb_to_xyz_matrix
from simulations.models.require import require_one_of

BRADFORD = np.array(
    [[0.8951, 0.2664, -0.1614], [-0.7502, 1.7135, 0.0367], [0.0389, -0.0685, 1.0296]]
)
"""Responses sharper than those of the cones, fitted to how people matched dyed wool."""
CONES = np.array([[0.40024, 0.7076, -0.08081], [-0.2263, 1.16532, 0.0457], [0.0, 0.0, 0.91822]])
"""The eye's long, middle and short receptors (Hunt, Pointer and Estévez), equal under D65."""

RESPONSES = {"bradford": BRADFORD, "von-kries": CONES, "rgb": np.linalg.inv(rgb_to_xyz_matrix())}
"""Matrices from XYZ to the responses; "rgb" applies the gains of `white_balance` to linear sRGB."""


def adaptation_matrix(from_xy: ArrayLike, to_xy: ArrayLike, method: str = "bradford") -> Floats:
    """The (3, 3) matrix that takes XYZ under one light to XYZ under another.

    It takes the first light's white exactly to the second's; its inverse goes the other way.

    Parameters
    ----------
    from_xy, to_xy : (2,) chromaticities of the two lights.
    method : "bradford", "von-kries" or "rgb".

    Raises
    ------
    ValueError
        For another method, for an invalid chromaticity, and for a light to which one of the
        responses is 0, as no gain can restore it.
    """
    require_one_of("method", method, RESPONSES)
    responses = RESPONSES[method]
    before, after = (responses @ white_xyz(xy) for xy in (from_xy, to_xy))
    for xy, signal in ((from_xy, before), (to_xy, after)):
        if not (signal > 1e-6).all():
            raise ValueError(
                f"light {np.asarray(xy).tolist()} gives {method} responses "
                f"{np.round(signal, 4).tolist()}; legal: all above 0"
            )
    gains = (after / before)[:, None]
    return np.linalg.solve(responses, gains * responses)


def adapt(xyz: ArrayLike, from_xy: ArrayLike, to_xy: ArrayLike, method: str = "bradford") -> Floats:
    """Colours (..., 3) in XYZ as they would look under another light: see `adaptation_matrix`."""
    return through_matrix(adaptation_matrix(from_xy, to_xy, method), xyz)
