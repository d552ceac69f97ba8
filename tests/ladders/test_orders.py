"""The order of errors among the tiers of every ladder, and metrics on the reference itself."""

from typing import Any

import pytest
from support.ladders import LadderRun, run_of

ORDERS = [
    ("baked-light", "rms.traced == 0 and rms.baked_2 < 0.5 < rms.baked_4 < rms.baked_16"),
    ("block-dct", "max(worst.separable, worst.direct, worst.fourier) < 1e-11"),
    ("block-dct", "1e-6 < min(worst.separable_32, worst.direct_32)"),
    ("block-dct", "max(worst.separable_32, worst.direct_32) < 1e-3"),
    ("block-dct", "changed.separable_32 == changed.direct_32 == changed.fourier == 0"),
    ("block-dct", "1 / 16 < worst.fixed_point < 1 / 3 and 100 < changed.fixed_point < 5000"),
    ("camera-calibration", "rms.closed_form > 5 * rms.gauss_newton_1"),
    ("camera-calibration", "rms.linear_lens > rms.gauss_newton_1 > 100 * rms.gauss_newton_3"),
    ("camera-calibration", "max(rms.gauss_newton, rms.levenberg_marquardt) < 1e-6"),
    ("camera-calibration", "arrived.closed_form == 0 and arrived.levenberg_marquardt == 100"),
    ("camera-calibration", "50 < arrived.gauss_newton < 100"),
    ("chromatic-aberration", "rms.gauss_1 > 2 * rms.gauss_3 > 3 * rms.gauss_5"),
    ("chromatic-aberration", "rms.even_9 > 2 * rms.even_16 > 4 * rms.even_31"),
    ("chromatic-aberration", "2 * rms.even_9 < rms.gauss_3 and 2 * rms.even_16 < rms.gauss_5"),
    ("chromatic-aberration", "rms.gauss_1 > 10 / 255 > 0.5 / 255 > rms.even_31"),
    ("corner-refinement", "rms.peak > 1.5 * rms.taylor > 7.5 * rms.parabola_3"),
    ("corner-refinement", "rms.parabola_3 > 1.3 * rms.fit and rms.gradients > 2 * rms.fit"),
    ("corner-refinement", "lit.parabola_8 > 4 * noisy.parabola_8"),
    ("corner-refinement", "lit.gradients > 4 * noisy.gradients and lit.fit < 3 * noisy.fit"),
    ("demosaicing", "psnr_room.menon_unrefined > psnr_room.malvar > psnr_room.bilinear"),
    ("demosaicing", "psnr_room.menon_encoded > psnr_room.menon and light.malvar > light.bilinear"),
    ("demosaicing", "psnr_soft.bilinear > psnr_soft.malvar > psnr_soft.menon_unrefined"),
    ("demosaicing", "psnr_soft.menon_unrefined > psnr_soft.menon"),
    ("demosaicing", "psnr_balloon.menon_encoded > psnr_balloon.bilinear > psnr_balloon.menon"),
    ("demosaicing", "light.menon_unrefined > max(light.menon, light.menon_encoded, light.malvar)"),
    ("depth-of-field", "psnr.pinhole < min(psnr.discs, psnr.binned, psnr.gather)"),
    ("depth-of-field", "max(psnr.discs, psnr.binned, psnr.gather) < psnr.layered"),
    ("depth-of-field", "psnr.random_16 < psnr.jittered_16 < psnr.fibonacci_16 < psnr.fibonacci_64"),
    ("depth-of-field", "psnr.layered < min(psnr.turned_16, psnr.fibonacci_16)"),
    ("wide-discs", "abs(psnr.layered_taps - psnr.layered) < 1e-3"),
    ("wide-discs", "abs(psnr.layered_pyramid - psnr.layered) < 0.2"),
    ("wide-discs", "max(psnr.discs, psnr.binned) < psnr.layered < psnr.fibonacci_64"),
    ("edge-coverage", "rms.point > rms.box_2 > rms.box_4 > rms.ramp > rms.box_8 > rms.box_16"),
    ("edge-coverage", "5 * rms.curved < rms.edge_box_64 and 3 * rms.straight < rms.box_16"),
    ("edge-coverage", "rms_small.box_16 < rms_small.straight < rms_small.box_4"),
    ("edge-coverage", "worst_small.straight > 1.5 and worst_small.curved < 0.2"),
    ("edge-coverage", "abs(rms_small.straight / rms.straight / (37.3 / 5) - 1) < 0.1"),
    ("exposure-blur", "worst.integral < 1e-13"),
    ("exposure-blur", "rms.instants_16 < rms.jittered_16 < 1.2 * rms.instants_16"),
    ("exposure-blur", "rms.random_16 > 2 * rms.instants_16"),
    ("exposure-blur", "rms.instants_4 < rms.smear < rms.instants_1 / 2"),
    ("homography-estimation", "poster.plain > 5 * poster.normalised"),
    ("homography-estimation", "wall.one_sided > 1.15 * wall.normalised > 1.2 * wall.two_sided"),
    ("homography-estimation", "rms.four_points > 2 * rms.normalised"),
    ("homography-estimation", "abs(poster.two_sided / poster.normalised - 1) < 0.01"),
    ("homography-estimation", "max(exact.plain, exact.four_points, exact.one_sided) < 1e-6"),
    ("homography-estimation", "max(exact.squared, exact.normalised, exact.two_sided) < 1e-6"),
    ("inverse-distortion", "rms.first_order > 100 * rms.fixed_point_5 > 1e4 * rms.fixed_point_10"),
    ("inverse-distortion", "rms.fixed_point_10 > 1000 * rms.newton_3 > 1e6 * rms.newton_4"),
    ("inverse-distortion", "max(worst.newton_5, worst.newton_bracketed) < 1e-11"),
    ("inverse-strong", "pincushion.fixed_point_20 > pincushion.fixed_point_5 > 100"),
    ("inverse-strong", "fold.newton_3 > fold.newton_4 > fold.newton_5 > 1e-3 < fold.lookup_table"),
    ("inverse-strong", "max(pincushion.closed_form, fold.closed_form, rms.closed_form) < 1e-11"),
    ("inverse-strong", "max(pincushion.checked_table, fold.checked_table) < 1e-11"),
    ("inverse-strong", "max(pincushion.newton_bracketed, fold.newton_bracketed) < 1e-11"),
    ("mtf-binning", "10 * clean.spline < min(clean.bins_8, clean.bins_4, clean.means_4)"),
    ("mtf-binning", "clean.bins_4 < clean.bins_4_raw and clean.bins_4 < clean.bins_1"),
    ("mtf-binning", "noisy.spline < 1.5 * noisy.bins_4 < 3 * noisy.spline"),
    ("precision", "near.float32 < 1e-3 and far.relative_32 < 1e-3 and far.float32 > 10"),
    ("precision", "far.float32 > 1e5 * far.relative_32 > 1e7 * far.float64"),
    ("precision", "far.float64 > 100 * far.relative_64"),
    ("resampling", "psnr_once.nearest < psnr_once.bilinear < psnr_once.bicubic < psnr_once.spline"),
    ("resampling", "psnr_often.nearest < psnr_often.bilinear < psnr_often.bicubic"),
    ("resampling", "psnr_often.bicubic < psnr_often.spline"),
    ("resampling", "present.bilinear < 25 and present.nearest > 80 and in_place.nearest < 50"),
    ("resampling", "70 < present.spline < 100 < present.lanczos3 < 120"),
    ("rotation-interpolation", "worst.nlerp > 100 * worst.paced_nlerp and worst.slerp < 1e-12"),
    ("rotation-interpolation", "worst_small.nlerp < 2e-3 and worst.slerp_threshold < 1e-4"),
    ("shading", "3.3 < rms.gouraud_8 / rms.gouraud_16 < 4.3"),
    ("shading", "3.3 < rms.gouraud_16 / rms.gouraud_32 < 4.3"),
    ("shading", "3.3 < rms.gouraud_32 / rms.gouraud_64 < 4.3"),
    ("shading", "worst.phong < 1e-5"),
    ("shot-noise", "ks.gaussian > 2 * ks.skewed > 10 * ks.poisson"),
    ("shot-noise", "bias.skewed > 20 > 5 > max(bias.quantile, bias.poisson)"),
]
"""A ladder, and a relation between errors, written METRIC.TIER with underscores for hyphens."""


class Errors:
    """The errors of a ladder's tiers by one metric, each computed on access."""

    def __init__(self, run: LadderRun, metric: str) -> None:
        self._run, self._metric = run, metric
        self._ids = {tier.id.replace("-", "_"): tier.id for tier in run.ladder.tiers}

    def __getattr__(self, tier: str) -> float:
        return self._run.error(self._metric, self._ids[tier])


@pytest.mark.parametrize(("ladder_id", "relation"), ORDERS)
def test_errors_are_ordered_as_theory_and_book_say(ladder_id: str, relation: str) -> None:
    run = run_of(ladder_id)
    names: dict[str, Any] = {name.replace("-", "_"): Errors(run, name) for name in run.metrics}
    found = eval(relation, names)
    assert found, [(m, t, run.error(m, t)) for m in run.metrics for t in run.results]


@pytest.mark.parametrize(
    "ladder_id",
    [
        "block-dct", "chromatic-aberration", "corner-refinement", "demosaicing", "depth-of-field",
        "edge-coverage", "inverse-distortion", "inverse-strong", "resampling",
        "rotation-interpolation", "shading", "baked-light",
    ],
)  # fmt: skip
def test_metric_finds_no_error_in_the_reference(ladder_id: str) -> None:
    """For ladders whose results have the reference's form."""
    run = run_of(ladder_id)
    for metric in run.ladder.metrics:
        found = metric.measure(run.truth, run.truth, run.work)
        best = 100.0 if metric.unit == "%" else float("inf")
        assert found == (best if metric.higher_is_better else pytest.approx(0.0, abs=1e-12))
