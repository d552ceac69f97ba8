"""Where a barrel polynomial folds: below its height two ideal radii for one, above it none."""

import numpy as np

from simulations.engine.drafting import label
from simulations.engine.drawing import dot, line
from simulations.engine.illustration import Illustration, Panel
from simulations.engine.plotting import Axis, Plot, Scale
from simulations.models.distortion import radial_profile
from simulations.models.distortion.radial_profile import RadialProfile, evaluate

PLOT = Plot(Axis(0.0, 1.9, 46, 390), Axis(0.0, 0.84, 226, 12))
LENS = RadialProfile((-0.3,))
DISTORTED, NOWHERE = 0.6, 0.75
ACROSS = Scale(ticks=(0, 0.5, 1, 1.5), tick_style="muted small")
UP = Scale(ticks=(DISTORTED, NOWHERE), tick_style="muted small")


def ideal_radii(distorted: float) -> list[float]:
    """All radii up to the end of the axis that the polynomial maps to ``distorted``."""
    k1 = LENS.numerator[0]
    roots = np.roots([k1, 0.0, 1.0, -distorted])
    real = (float(root.real) for root in roots if abs(root.imag) < 1e-12)
    return sorted(root for root in real if 0 <= root <= PLOT.x.high)


def draw() -> Illustration:
    fold = float(radial_profile.fold_radius(LENS))
    highest = float(radial_profile.largest_image_radius(LENS))
    radii = np.linspace(0.0, PLOT.x.high, 400)
    before, after = radii[radii <= fold], radii[radii >= fold]
    marks = [
        PLOT.frame(ACROSS, UP),
        PLOT.level(NOWHERE, "error dashed"),
        PLOT.level(DISTORTED, "image dashed"),
        line(PLOT.at(fold, 0), PLOT.at(fold, highest), "muted thin dashed"),
        PLOT.curve(before, evaluate(LENS, before), "camera bold"),
        PLOT.curve(after, evaluate(LENS, after), "camera dashed"),
        dot(PLOT.at(fold, highest), "camera", 4.5),
    ]
    for index, r in enumerate(ideal_radii(DISTORTED)):
        marks.append(dot(PLOT.at(r, DISTORTED), "image" if index == 0 else "error", 4.5))
    marks += [
        label((PLOT.at(1.9, NOWHERE)[0], PLOT.at(0, NOWHERE)[1] - 7), "no answer", "error", "end"),
        label((PLOT.x.end, PLOT.at(0, DISTORTED)[1] + 17), "two answers", "image", "end"),
        label((PLOT.at(fold, 0)[0] + 7, PLOT.y.start - 10), f"fold, r = {fold:.3f}", "muted"),
        label((PLOT.x.end, PLOT.y.start + 36), "ideal radius r", "muted small", "end"),
        label((52, 24), "seen at r_d", "muted small"),
    ]
    both = " and ".join(f"{r:.3f}" for r in ideal_radii(DISTORTED))
    words = (
        f"The distorted radius over the ideal one for k1 = {LENS.numerator[0]:g}. It rises to "
        f"{highest:.3f} at the ideal radius {fold:.3f} and falls again. The height {DISTORTED:g} "
        f"is reached twice, at {both}; {NOWHERE:g} is never reached."
    )
    return Illustration((Panel("plot", "", 400.0, 268.0, overlay="".join(marks)),), words)
