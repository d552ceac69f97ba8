"""Lenses that fold the picture, coefficients that overflow, rays that a fisheye just catches."""

import numpy as np

from simulations.engine.hard_cases import (
    HardCase,
    HardCases,
    LibraryAnswer,
    exactly,
    invalid,
    near,
    refused,
    valid,
)
from simulations.models.distortion import fisheye, lens_model, undistortion
from simulations.models.distortion.lens_model import Distortion, distort

UNDO = (
    "cv2.undistortPoints(np.array([[[{}]]]), np.eye(3), np.array([{}]), "
    "criteria=(cv2.TERM_CRITERIA_COUNT + cv2.TERM_CRITERIA_EPS, {}, 1e-12))[0, 0]"
)

NEARLY_FLAT = Distortion(k1=-0.3, k2=0.04050002)

TABLE = HardCases(
    id="distortion",
    title="Lens distortion and fisheyes",
    names={
        **vars(undistortion),
        **vars(fisheye),
        **vars(lens_model),  # last: its fold_radius is a lens's, not a profile's
        "BARREL": Distortion(k1=-0.3),
        "PINCUSHION": Distortion(k1=0.5),
        "NARROW": Distortion(k1=-0.3, k2=0.0404, p1=1e-4),
        "inf": np.inf,
        "nan": np.nan,
    },
    cases=(
        HardCase(
            id="optical-axis",
            call="undistort([0.0, 0.0], BARREL)",
            why="r/r at the axis itself, where every direction is equally good.",
            returns="The axis, exactly.",
            expected=valid([0.0, 0.0], 0.0),
            naive="np.zeros(2) * (np.float64(0.0) / 0.0)",
        ),
        HardCase(
            id="beyond-the-fold",
            call="undistort([0.75, 0.0], BARREL)",
            why="No ideal point has this image: the map turns back at ⅔ of the fold radius, 0.703.",
            returns="No point.",
            expected=invalid,
            naive="undistort_fixed_point([0.75, 0.0], BARREL, 100)",
            library=LibraryAnswer(UNDO.format("0.75, 0.0", "-0.3, 0, 0, 0.0", 100), "[1.1409, 0]"),
        ),
        HardCase(
            id="border-of-the-lens",
            call="undistort_clamped([0.75, 0.0], BARREL)",
            why="The same, asked by a figure that has to draw where the lens ends.",
            returns="The fold circle, a border to draw and no answer: the mask is False as well.",
            expected=lambda got: not got[1] and np.isclose(got[0][0], np.sqrt(1 / 0.9)),
        ),
        HardCase(
            id="just-inside-the-fold",
            call="undistort([0.7027, 0.0], BARREL)",
            why="The slope is almost zero, and Newton's step almost infinite.",
            returns="The root on the near side, by steps that bisection keeps in bounds.",
            expected=lambda got: (
                got[1] and np.isclose(got[0][0] * (1 - 0.3 * got[0][0] ** 2), 0.7027)
            ),
            library=LibraryAnswer(UNDO.format("0.7027, 0.0", "-0.3, 0, 0, 0.0", 5), "[0.9561, 0]"),
        ),
        HardCase(
            id="two-answers",
            call="distort([[0.8, 0.0], [1.2891, 0.0]], BARREL)[:, 0]",
            why="Two ideal points, one on each side of the fold, share an image.",
            returns="The same radius twice. Only the inner one comes back from undistort.",
            expected=lambda got: abs(got[0] - got[1]) < 1e-4,
        ),
        HardCase(
            id="fold-radius",
            call="fold_radius(BARREL)",
            why="Where 1 + 3k₁r² is zero.",
            returns="√(1/0.9).",
            expected=near(np.sqrt(1 / 0.9)),
        ),
        HardCase(
            id="no-fold",
            call="fold_radius(PINCUSHION)",
            why="A pincushion grows for ever: the polynomial has no positive root.",
            returns="∞, and the largest image radius is ∞ too.",
            expected=exactly(np.inf),
            naive="np.sqrt(-1 / (3 * np.float64(0.5)))",
        ),
        HardCase(
            id="vanishing-highest-term",
            call="fold_radius(Distortion(k1=-0.3, k2=1e-300))",
            why="A leading coefficient of 1e−300 sends the formula for quadratics to 0/0.",
            returns="The fold of k₁ alone: roots are sought in 1/r², where the term does no harm.",
            expected=near(np.sqrt(1 / 0.9)),
            naive="(0.9 - np.sqrt(0.81 - 4 * 5e-300)) / (2 * 5e-300)",
        ),
        HardCase(
            id="strong-pincushion",
            call="undistort([3.0, 0.0], PINCUSHION)",
            why="A perfectly good inverse exists, but the fixed-point iteration runs from it.",
            returns="The root, r = 1.456: bracketed Newton cannot diverge.",
            expected=lambda got: got[1] and np.isclose(got[0][0] * (1 + 0.5 * got[0][0] ** 2), 3.0),
            naive="undistort_fixed_point([3.0, 0.0], PINCUSHION, 100)",
            library=LibraryAnswer(UNDO.format("3.0, 0.0", "0.5, 0, 0, 0.0", 5), "[1.4561, 0]"),
        ),
        HardCase(
            id="nearly-flat",
            call="undistort([0.795, 0.0], Distortion(k1=-0.3, k2=0.04050002))",
            why="The slope comes within 4e−7 of zero and rises again: no fold, but almost one.",
            returns="The root, r = 1.4478. A hundred divisions end 31 px short at f = 1000 px.",
            expected=lambda got: (
                got[1] and np.isclose(distort(got[0], NEARLY_FLAT)[0], 0.795, rtol=1e-15, atol=0.0)
            ),
            naive="undistort_fixed_point([0.795, 0.0], Distortion(k1=-0.3, k2=0.04050002), 100)",
            library=LibraryAnswer(
                UNDO.format("0.795, 0.0", "-0.3, 0.04050002, 0, 0.0", 100), "[1.4168, 0]"
            ),
        ),
        HardCase(
            id="neutral-lens-far-out",
            call="distort([1e200, 0.0], Distortion())",
            why="r² overflows, although nothing needs it when all coefficients are zero.",
            returns="The same point: a neutral lens touches nothing.",
            expected=exactly([1e200, 0.0]),
            naive="1e200 * (1 + 0.0 * np.float64(1e200) ** 2)",
            library=LibraryAnswer(
                "cv2.projectPoints(np.array([[[1e200, 0.0, 1.0]]]), np.zeros(3), np.zeros(3), "
                "np.eye(3), np.zeros(4))[0][0, 0]",
                "[nan, nan]",
            ),
        ),
        HardCase(
            id="far-out-through-a-barrel",
            call="distort([1e200, 0.0], BARREL)",
            why="r² overflows, and so does the true answer.",
            returns="−∞ along x, 0 along y: the sign that the polynomial gives, and no NaN.",
            expected=exactly([-np.inf, 0.0]),
            naive="np.array([1e200, 0.0]) * (1 - 0.3 * np.float64(1e200) ** 2)",
        ),
        HardCase(
            id="infinite-coefficient",
            call="Distortion(k1=inf)",
            why="A calibration that diverged.",
            returns="Refused at once, before a picture is spoiled.",
            expected=refused("finite"),
        ),
        HardCase(
            id="pole",
            call="fold_radius(Distortion(k4=-1.0))",
            why="The rational model has a pole where its denominator is zero: at r = 1.",
            returns="1: the pole bounds what can be inverted, like a fold.",
            expected=near(1.0),
            naive="1.0 / (1.0 - np.float64(1.0))",
        ),
        HardCase(
            id="tangential-fold",
            call="undistort([0.0, -30.0], Distortion(p1=0.1))",
            why="Tangential terms alone can fold the plane: y + 0.3 y² never falls below −0.83.",
            returns="No point.",
            expected=invalid,
            library=LibraryAnswer(UNDO.format("0.0, -30.0", "0, 0, 0.1, 0.0", 100), "[nan, nan]"),
        ),
        HardCase(
            id="narrow-fold-off-centre",
            call="undistort(distort([0.0, 2.1], NARROW), NARROW)",
            why="The map turns back at 1.455 and forth again at 1.529: 1.3° of the view.",
            returns="Invalid: whether it turns over on the way is decided, and not sampled.",
            expected=lambda got: not got[1],
        ),
        HardCase(
            id="undistort-nan",
            call="undistort([nan, 0.2], BARREL)",
            why="A corner that the detector did not find.",
            returns="No point: half of it is not known, and neither half of the answer is.",
            expected=invalid,
        ),
        HardCase(
            id="tiny-radius",
            call="undistort([1e-200, 0.0], BARREL)",
            why="Squared, the radius underflows.",
            returns="The same point, to the last digit.",
            expected=valid([1e-200, 0.0], 1e-210),
        ),
        HardCase(
            id="fisheye-side",
            call="project_ideal([1.0, 0.0, 0.0], 'equidistant')",
            why="At 90° to the axis a flat picture has no room; X/Z is 1/0.",
            returns="π/2 focal lengths from the centre. That is what a fisheye is for.",
            expected=valid([np.pi / 2, 0.0]),
            naive="np.divide(1.0, 0.0)",
            library=LibraryAnswer(
                "cv2.fisheye.projectPoints(np.array([[[1.0, 0.0, 0.0]]]), np.zeros(3), "
                "np.zeros(3), np.eye(3), np.zeros(4))[0][0, 0]",
                "[0.7854, 0]",
            ),
        ),
        HardCase(
            id="fisheye-behind",
            call="project_ideal([1.0, 0.0, -1.0], 'equidistant')",
            why="135° from the axis: behind the lens, yet some lenses see it.",
            returns="¾π focal lengths out. OpenCV divides by a negative Z and turns it around.",
            expected=valid([0.75 * np.pi, 0.0]),
            naive="np.arctan(np.divide(1.0, -1.0))",
            library=LibraryAnswer(
                "cv2.fisheye.projectPoints(np.array([[[1.0, 0.0, -1.0]]]), np.zeros(3), "
                "np.zeros(3), np.eye(3), np.zeros(4))[0][0, 0]",
                "[-0.7854, 0]",
            ),
        ),
        HardCase(
            id="exactly-backwards",
            call="project_ideal([0.0, 0.0, -1.0], 'equidistant')",
            why="180°: a whole circle of image points, none better than another.",
            returns="No image.",
            expected=invalid,
        ),
        HardCase(
            id="flat-lens-sideways",
            call="project_ideal([1.0, 0.0, 0.0], 'perspective')",
            why="tan 90° is not infinite in floating point, but 1.6e16.",
            returns="No image: the limit of the model is its limit, whatever tan says.",
            expected=invalid,
            naive="np.tan(np.pi / 2)",
        ),
        HardCase(
            id="outside-the-image-circle",
            call="unproject_ideal([1.5, 0.0], 'orthographic')",
            why="r = sin θ cannot exceed 1: arcsin(1.5).",
            returns="No direction.",
            expected=invalid,
            naive="np.arcsin(1.5)",
        ),
        HardCase(
            id="fisheye-fold",
            call="project_fisheye([1.0, 0.0, 0.0], Fisheye(k1=-0.5))",
            why="The polynomial θ − 0.5 θ³ turns back at 47°.",
            returns="No image beyond: 90° would land at −0.37, on the opposite side.",
            expected=invalid,
            naive="np.pi / 2 * (1 - 0.5 * (np.pi / 2) ** 2)",
            library=LibraryAnswer(
                "cv2.fisheye.projectPoints(np.array([[[1.0, 0.0, 0.001]]]), np.zeros(3), "
                "np.zeros(3), np.eye(3), np.array([-0.5, 0, 0, 0]))[0][0, 0]",
                "[-0.3644, 0]",
            ),
        ),
        HardCase(
            id="no-direction",
            call="project_fisheye([0.0, 0.0, 0.0], Fisheye())",
            why="atan2(0, 0) is 0 by convention, which would look like “straight ahead”.",
            returns="No image.",
            expected=invalid,
            naive="np.arctan2(0.0, 0.0)",
        ),
        HardCase(
            id="infinite-point",
            call="distort([inf, 0.0], PINCUSHION)",
            why="∞ divided by ∞ on the way.",
            returns="The horizon stays on its side.",
            expected=exactly(np.array([np.inf, 0.0])),
            naive="np.array([np.inf, 0.0]) * (1 + 0.5 * np.inf)",
        ),
        HardCase(
            id="three-coordinates",
            call="distort([0.1, 0.2, 1.0], BARREL)",
            why="A homogeneous point: its first two entries alone would seem to do.",
            returns="Refused.",
            expected=refused("(3,)", "(..., 2)"),
        ),
    ),
)
