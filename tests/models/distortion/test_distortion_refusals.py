"""What models of lenses' distortion refuse, by the name of the parameter."""

from typing import Any

import numpy as np
from support.refusals import Call, assert_refused, each_of

from simulations.models.distortion import cubic_inverse
from simulations.models.distortion.fisheye import Fisheye, project_ideal
from simulations.models.distortion.kinds import classify, line_bow
from simulations.models.distortion.lens_model import Distortion
from simulations.models.distortion.radial_profile import RadialProfile

NO_COEFFICIENT = [np.nan, np.inf, -1.001e9]
NO_CURVE = [
    *(np.empty((0, 2)), [1.0, 2.0], [[0, 0], [np.nan, 1], [1, 1]]),
    *([[0, 0], [1.001e150, 1]], [[0, 0], [1, -1.001e150]]),
]
NOT_OF_K1_ALONE = [
    *(RadialProfile(), RadialProfile((0.3, 0.1)), RadialProfile((0.3,), (0.1,))),
    RadialProfile((0.0, 1)),
]


@each_of(
    ("legal: finite, at most 1e", lambda k: Distortion(k1=k), NO_COEFFICIENT),
    ("finite", lambda k: RadialProfile((k,)), NO_COEFFICIENT),
    ("finite", lambda k: RadialProfile((), (k,)), NO_COEFFICIENT),
    ("finite", lambda name: Fisheye(**{name: np.inf}), ["k1", "k2", "k3", "k4"]),
    ("fishy", lambda model: project_ideal([0, 0, 1], model), ["fishy"]),
    (r"legal: \(\.\.\., N, 2\), finite", line_bow, NO_CURVE),
    ("corner_radius .*; legal: 0 to", lambda r: classify(Distortion(), r, 0), [-1, np.nan, np.inf]),
    ("profile", lambda p: cubic_inverse.shrinkage(p, np.array([0.1])), NOT_OF_K1_ALONE),
)
def test_models_of_distortion_refuse(message: str, call: Call, values: Any) -> None:
    assert_refused(message, call, values)


def test_the_largest_coefficients_are_legal() -> None:
    assert Distortion(k1=1e9, p2=-1e9).k1 == 1e9
