"""Chapter 4: lens distortion. Lens models chosen in many simulated calibrations."""

from collections import Counter

from scipy.stats import chi2
from support.worked_numbers import Phrases

from simulations.models.calibration.model_choice import compare, supported
from simulations.models.calibration.simulated import sitting
from simulations.scenes.calibration.boards import BOARD, SIGMA_PX, SIZE, TRUTH

CHAPTER = "04-lens-distortion"
SITTINGS = 32


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


def lens_model_supported_by_photographs() -> Phrases:
    best, _, cheapest = wins_by_model(3)
    assert best["k1k2"] == max(best.values())
    yield f"so {SITTINGS} such sittings were computed"
    yield f"In {best['k1k2']} of the {SITTINGS} sittings $k_1$ and $k_2$ predict best"
    yield f"predict best, in {best['k3']} all"
    yield f"all five, in {best['p1p2']} the four that the lens has and in {best['fisheye']} those"
    yield f"chooses the four coefficients of the lens in {cheapest['p1p2']} of {SITTINGS} sittings"
    _, six, _ = wins_by_model(6)
    _, twelve, cheapest = wins_by_model(12)
    yield f"support $p_1$ and $p_2$ in {six['p1p2']} of {SITTINGS} sittings"
    yield f"sittings, twelve in {twelve['p1p2']}"
    assert 1 <= six["k3"] <= 2
    assert 1 <= twelve["k3"] <= 2
    yield f"with twelve it still chooses $k_3$ in {cheapest['k3']}"
    assert round(1 / chi2.sf(2, 1)) == 6
    yield "which by theory happens in one of six sittings"
