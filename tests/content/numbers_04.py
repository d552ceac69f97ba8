"""Chapter 4: lens distortion."""

from collections import Counter

import numpy as np
from scipy.stats import chi2
from support.worked_numbers import Phrases, slow

from simulations.models.calibration.model_choice import compare, supported
from simulations.models.calibration.simulated import sitting
from simulations.models.distortion.lens_model import Distortion, distort, fold_radius
from simulations.scenes.calibration.boards import BOARD, SIGMA_PX, SIZE, TRUTH

CHAPTER = "04-lens-distortion"
SITTINGS = 128


def wins_by_model(photographs: int) -> tuple[Counter[str], Counter[str], Counter[str]]:
    """Number of sittings that each lens model wins: by left-out photographs, as the supported one,
    and by Akaike's criterion. Poses and noise differ between sittings."""
    best, simplest, cheapest = Counter[str](), Counter[str](), Counter[str]()
    for seed in range(SITTINGS):
        views = sitting(TRUTH, SIZE, photographs, BOARD, seed).views(SIGMA_PX, seed)
        trials = compare(views, SIZE)
        best[min(trials, key=lambda trial: trial.left_out_px).lens] += 1
        simplest[supported(trials).lens] += 1
        cheapest[min(trials, key=lambda trial: trial.aic).lens] += 1
    return best, simplest, cheapest


@slow
def lens_model_supported_by_photographs() -> Phrases:
    best, _, cheapest = wins_by_model(3)
    assert best["k1k2"] == max(best.values())
    yield f"so {SITTINGS} such sittings were computed"
    yield f"In {best['k1k2']} of the {SITTINGS} sittings $k_1$ and $k_2$ predict best"
    yield f"predict best, in {best['p1p2']} the four that the lens has"
    yield f"in {best['k3']} all five and in {best['fisheye']} those of a fisheye"
    yield f"chooses the four coefficients of the lens in {cheapest['p1p2']} of {SITTINGS} sittings"
    _, six, _ = wins_by_model(6)
    _, twelve, cheapest = wins_by_model(12)
    yield f"support $p_1$ and $p_2$ in {six['p1p2']} of {SITTINGS} sittings"
    yield f"sittings, twelve in {twelve['p1p2']}"
    yield f"is supported in {six['k3']} of them and in {twelve['k3']}"
    yield f"with twelve it still chooses $k_3$ in {cheapest['k3']}"
    assert round(1 / chi2.sf(2, 1)) == 6
    yield "which by theory happens in one of six sittings"


def after_two_steps(lens: Distortion, radius: float, start: float) -> float:
    """Error of the radius after two steps of Newton's method."""
    seen = distort((radius, 0.0), lens)[0]
    r = start
    for _ in range(2):
        r -= (r + lens.k1 * r**3 - seen) / (1 + 3 * lens.k1 * r * r)
    return abs(r - radius)


def start_of_newtons_method() -> Phrases:
    for k1 in -np.geomspace(0.02, 1.0, 16):
        lens = Distortion(k1=float(k1))
        for radius in np.linspace(0.1, 0.999, 40) * fold_radius(lens):
            seen = distort((float(radius), 0.0), lens)[0]
            near = after_two_steps(lens, float(radius), seen / (1 + lens.k1 * seen * seen))
            assert near <= after_two_steps(lens, float(radius), seen) + 1e-15 * radius
    yield "two steps from there end nearer than two from $r_d$"
