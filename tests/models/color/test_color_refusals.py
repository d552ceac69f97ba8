"""What models of colour refuse, by the name of the parameter."""

from typing import Any

import numpy as np
from support.refusals import Call, assert_refused, each_of

from simulations.models.color import cie, illuminants, observer, spectra, surfaces
from simulations.models.color.chromatic_adaptation import adaptation_matrix
from simulations.models.color.chromaticity import ILLUMINANT_A_XY, white_xyz
from simulations.models.color.cie import D65_XY
from simulations.models.color.white_balance import grey_world, white_balance

NO_XY = [
    *((0.3, 0.0), (0.3, 1e-6), (-0.1, 0.3), (0.6, 0.5), (np.nan, 0.3), (0.3, np.nan)),
    *((np.inf, 0.3), (0.3, 0.3, 0.4), 0.3),
]
NO_WHITE = [(0.3, 0.0), (0.0, 0.3), (-0.3, 0.3), (0.7, 0.4), (0.3, np.nan)]
NO_LIGHT = [[1.0, -0.5, 1], [1, np.nan, 1], [1, 1, np.inf], [1, 1, 0], [1, 1], [[1] * 3]]
NO_COLOURS = [np.ones(shape) for shape in ((4,), (3, 4), (), (5, 1))]
NO_RESPONSE = ("bradford", "von-kries", "rgb")
GREEN = (0.2, 0.8)
"""Pure green light: it leaves nothing for the receptors of blue."""
ONE_LINE = ((0.2, 0.2), (0.3, 0.3), (0.4, 0.4))
DARK_BLUE = ((0.6, 0.3), (0.3, 0.6), (0.1, 0.0))
NO_NUMBER = ((0.6, 0.3), (0.3, 0.6), (np.nan, 0.1))
LIGHT = np.ones(81)


@each_of(
    ("chromaticity .*; legal: x ≥ 0", white_xyz, NO_XY),
    ("chromaticity", lambda xy: adaptation_matrix(D65_XY, xy), NO_XY[:1]),
    ("light .* responses", lambda m: adaptation_matrix(GREEN, D65_XY, m), NO_RESPONSE),
    ("light .* responses", lambda m: adaptation_matrix(D65_XY, GREEN, m), NO_RESPONSE),
    (
        "'.*'; legal: bradford, von",
        lambda m: adaptation_matrix(D65_XY, ILLUMINANT_A_XY, m),
        ["cat02"],
    ),
    (r"(white|chromaticity) \[.*legal: x, y", lambda w: cie.xyz_to_lab([1, 1, 1], w), NO_WHITE),
    ("triangle", cie.rgb_to_xyz_matrix, [ONE_LINE]),
    ("legal: x, y finite, y not 0", cie.rgb_to_xyz_matrix, [DARK_BLUE, NO_NUMBER]),
    (r"shape \(2, 2\); legal: \(3, 2\)", cie.rgb_to_xyz_matrix, [ONE_LINE[:2]]),
    (r"legal: \(\.\.\., 3\)", cie.linear_rgb_to_xyz, NO_COLOURS),
    (r"legal: \(\.\.\., 3\)", cie.luminance, NO_COLOURS),
    (r"legal: \(\.\.\., 3\)", grey_world, NO_COLOURS[:1]),
    ("illuminant", lambda light: white_balance([0.5, 0.5, 0.5], light), NO_LIGHT),
    ("one pixel or more", grey_world, [np.ones((0, 3))]),
    ("temperature_k .*; legal: 20 to 1e", illuminants.planck, [0.0, 19.9, 1.1e9, np.nan]),
    ("temperature_k .*; legal: 4000 to", illuminants.daylight, [3999.0, 25001.0, np.nan]),
    ("luminance", lambda light: observer.tristimulus(LIGHT, light), [0 * LIGHT]),
    ("width_nm .*above 0", lambda w: spectra.bell(500, 500, w, w), [0.0, -1.0, np.inf]),
    ("width_nm .*above 0", lambda w: spectra.bell(500, 500, 5, w), [0.0, np.nan]),
    ("knots 2", spectra.through_knots, [np.ones(2)]),
    ("width_nm .*5 or more", lambda w: surfaces.dyed_cloth(550, w), [4.9, np.inf, np.nan]),
    ("reflectance", lambda r: surfaces.metameric_twins(r, LIGHT), [1.1 * LIGHT, -0.1 * LIGHT]),
)
def test_models_of_colour_refuse(message: str, call: Call, values: Any) -> None:
    assert_refused(message, call, values)
