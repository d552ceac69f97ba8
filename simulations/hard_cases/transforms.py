"""Homographies that divide by nothing, squash the plane, or cannot be told from their points."""

import numpy as np

from simulations.engine.hard_cases import (
    HardCase,
    HardCases,
    LibraryAnswer,
    invalid,
    near,
    refused,
    valid,
)
from simulations.models.geometry import (
    homography_algebra,
    homography_estimation,
    transforms,
    transforms_3d,
)
from simulations.models.projection.view_homographies import (
    in_front,
    plane_between_views,
    turned_camera,
)

HORIZON = np.array([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 0.0, -1.0]])
PICTURE = np.array([[-400.0, -300.0], [400.0, -300.0], [400.0, 300.0], [-400.0, 300.0]])
SQUARE = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
IN_CV2 = "cv2.perspectiveTransform(np.array([[[{}]]]), np.array([{}]))[0, 0]"
ROWS = "[1.0, 0, 0], [0, 1, 0], [1, 0, -1]"

TABLE = HardCases(
    id="transforms",
    title="Transformations of the plane",
    names={
        **vars(transforms),
        **vars(homography_algebra),
        **vars(homography_estimation),
        "transforms_3d": transforms_3d,
        "plane_between_views": plane_between_views,
        "turned_camera": turned_camera,
        "in_front": in_front,
        "K": np.array([[800.0, 0.0, 320.0], [0.0, 800.0, 240.0], [0.0, 0.0, 1.0]]),
        "ABOUT": np.diag([-1.0, 1.0, -1.0]),
        "PICTURE": PICTURE,
        "LINE": np.outer([0.0, 1.0, 3.0], [1.0, 2.0, 3.0]),
        "CORNERS": np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]),
        "HORIZON": HORIZON,
        "SQUARE": SQUARE,
        "inf": np.inf,
        "nan": np.nan,
    },
    cases=(
        HardCase(
            id="on-the-horizon",
            call="apply_homography(HORIZON, [1.0, 2.0])",
            why="The point lies on the line w = 0, which this homography sends to infinity.",
            returns="No image. OpenCV answers (0, 0), a place like any other.",
            expected=invalid,
            naive="np.array([1.0, 2.0]) / 0.0",
            library=LibraryAnswer(IN_CV2.format("1.0, 2.0", ROWS), "[0, 0]"),
        ),
        HardCase(
            id="all-signs-turned",
            call="apply_homography(-np.eye(3), [3.0, 4.0])",
            why="−H is the same map as H, but its w is negative everywhere.",
            returns="The point itself: w is judged by its size and not by its sign.",
            expected=valid([3.0, 4.0]),
            library=LibraryAnswer(
                IN_CV2.format("3.0, 4.0", "[-1.0, 0, 0], [0, -1, 0], [0, 0, -1]"), "[3, 4]"
            ),
        ),
        HardCase(
            id="behind-the-second-camera",
            call="in_front(turned_camera(K, K, ABOUT), [340.0, 240.0])",
            why="The camera has turned its back, yet division by a negative depth gives a pixel.",
            returns="False. Only of a matrix made from two cameras does the sign of w say so.",
            expected=lambda got: not got,
            naive="apply_homography(turned_camera(K, K, ABOUT), [340.0, 240.0])[0]",
        ),
        HardCase(
            id="w-is-rounding",
            call="apply_homography([[1, 0, 0], [0, 1, 0], [0.1, 0.2, -0.3]], [1.0, 1.0])",
            why="0.1 + 0.2 − 0.3 is not 0 in binary, but 5.6e−17.",
            returns="No image: w is judged against the size of the terms it is the sum of.",
            expected=invalid,
            naive="np.array([1.0, 1.0]) / (0.1 + 0.2 - 0.3)",
            library=LibraryAnswer(
                IN_CV2.format("1.0, 1.0", "[1.0, 0, 0], [0, 1, 0], [0.1, 0.2, -0.3]"), "[0, 0]"
            ),
        ),
        HardCase(
            id="small-w-everywhere",
            call="apply_homography(1e-200 * np.eye(3), [3.0, 4.0])",
            why="H and 1e−200·H are the same map, but a fixed threshold on w would drop it.",
            returns="The point itself: thresholds are relative.",
            expected=valid([3.0, 4.0]),
        ),
        HardCase(
            id="all-entries-huge",
            call="projective(1e308 * np.eye(3)) @ [3.0, 4.0, 1.0]",
            why="The norm of the matrix overflows when its entries are squared.",
            returns="The identity: the largest entry is divided out first.",
            expected=near([3.0, 4.0, 1.0]),
            naive="np.sqrt(np.sum((1e308 * np.eye(3)) ** 2))",
        ),
        HardCase(
            id="zero-matrix",
            call="projective(np.zeros((3, 3)))",
            why="Every image would be (0, 0, 0), no point at all.",
            returns="Refused.",
            expected=refused("h", "zero"),
            naive="np.zeros((3, 3)) / 0.0",
        ),
        HardCase(
            id="nan-point",
            call="apply_homography(np.eye(3), [nan, 1.0])",
            why="An unknown coordinate would spread into both of the image.",
            returns="No image, and the mask says so.",
            expected=invalid,
        ),
        HardCase(
            id="image-overflows",
            call="apply_homography(translation(1e308, 0.0), [1e308, 0.0])",
            why="The sum is beyond the largest number.",
            returns="No image, and no warning.",
            expected=invalid,
            naive="np.float64(1e308) + 1e308",
        ),
        HardCase(
            id="clip-across-the-horizon",
            call="len(clip_to_visible(HORIZON, [[0, 0], [3, 0], [3, 1], [0, 1]]))",
            why="Two corners lie beyond w = 0. Joined after the division, edges run backwards.",
            returns="Four corners again: cut along the line before the division.",
            expected=near(4),
        ),
        HardCase(
            id="nothing-in-sight",
            call="clip_to_visible(HORIZON, [[3, 0], [2, 0], [2, 1]]).shape",
            why="The whole polygon lies beyond the line, seen from the origin.",
            returns="An empty polygon of shape (0, 2).",
            expected=near((0, 2)),
        ),
        HardCase(
            id="far-translation-condition",
            call="condition_number(translation(1e6, 0.0))",
            why="Measured in pixels this harmless matrix looks singular.",
            returns="Close to 1, the best there is: units are balanced before the judgement.",
            expected=lambda got: got < 10,
            naive="np.linalg.cond([[1, 0, 1e6], [0, 1, 0], [0, 0, 1]])",
            library=LibraryAnswer("np.linalg.cond([[1, 0, 1e6], [0, 1, 0], [0, 0, 1]])", "1e+12"),
        ),
        HardCase(
            id="tiny-but-fine",
            call="condition_number(1e-150 * np.eye(3))",
            why="The determinant underflows to 0, though this is the identity in other words.",
            returns="1: a determinant says nothing about how close a matrix is to singular.",
            expected=near(1.0),
            naive="np.linalg.det(1e-150 * np.eye(3))",
        ),
        HardCase(
            id="invert-singular",
            call="invert([[1.0, 2.0, 0.0], [2.0, 4.0, 0.0], [0.0, 0.0, 1.0]])",
            why="The plane is squashed onto a line: images cannot be traced back.",
            returns="Refused, with the condition number.",
            expected=refused("condition number", "inf"),
            library=LibraryAnswer(
                "np.linalg.inv([[1.0, 2, 0], [2, 4, 0], [0, 0, 1]])", "LinAlgError"
            ),
        ),
        HardCase(
            id="invert-nearly-singular",
            call="invert([[0.1, 0.7, 0.0], [0.3, 2.1, 0.0], [0.0, 0.0, 1.0]])",
            why="Singular, but for the rounding of 0.1 and 0.3.",
            returns="Refused. NumPy inverts it, into noise of the size 1e16.",
            expected=refused("condition number"),
            naive="np.abs(np.linalg.inv([[0.1, 0.7, 0], [0.3, 2.1, 0], [0, 0, 1]])).max()",
        ),
        HardCase(
            id="scale-zero",
            call="similarity(0.0, 0.5, 1.0, 2.0)",
            why="A similarity that shrinks everything to a point has no angle to keep.",
            returns="Refused.",
            expected=refused("scale", "0.0"),
        ),
        HardCase(
            id="decompose-infinite-origin",
            call="decompose([[1.0, 0, 0], [0, 1, 1], [0, 1, 0]])",
            why="h₃₃ = 0: the origin goes to infinity, and there is no translation to state.",
            returns="Refused.",
            expected=refused("h₃₃"),
            naive="np.eye(3) / 0.0",
        ),
        HardCase(
            id="three-points-on-a-line",
            call="estimate_homography([[0, 0], [1, 1], [2, 2], [0, 1]], SQUARE)",
            why="Three of the four points are collinear: infinitely many solutions, or none.",
            returns="No estimate.",
            expected=lambda got: not got[1],
            library=LibraryAnswer(
                "cv2.getPerspectiveTransform(np.float32([[0, 0], [1, 1], [2, 2], [0, 1]]), "
                "np.float32([[0, 0], [1, 0], [1, 1], [0, 1]]))[2]",
                "[0.5, -0.5, 0]",
            ),
        ),
        HardCase(
            id="too-few-points",
            call="estimate_homography(SQUARE[:3], SQUARE[:3])",
            why="Six equations for eight unknowns.",
            returns="No estimate.",
            expected=invalid,
        ),
        HardCase(
            id="far-off-pictures",
            call="apply_homography(estimate_homography(PICTURE + 1e6, PICTURE - 1e6)[0], "
            "PICTURE + 1e6)[0] + 1e6",
            why="Two pictures, 800 px wide, each a million px away from its origin.",
            returns="The corners again, to a millionth of a pixel: as good as nine numbers can be.",
            expected=lambda got: np.allclose(got, PICTURE, rtol=0.0, atol=1e-6),
        ),
        HardCase(
            id="far-off-points",
            call="estimate_homography(SQUARE + 1e6, SQUARE)[0] @ [1e6 + 0.5, 1e6 + 0.5, 1.0]",
            why="A unit square a million units away: unnormalised, its equations span 1e12.",
            returns="The middle of the square, to six digits and more: normalise first.",
            expected=lambda got: np.allclose(got[:2] / got[2], 0.5, atol=1e-6),
        ),
        HardCase(
            id="coincident-points",
            call="estimate_affine([[1, 1], [1, 1], [1, 1]], [[0, 0], [1, 0], [0, 1]])",
            why="One point cannot go to three places.",
            returns="No estimate; the normalisation finds no spread to divide by.",
            expected=invalid,
            naive="np.sqrt(2.0) / np.float64(0.0)",
        ),
        HardCase(
            id="mirrored-points",
            call="estimate_rigid([[-1, 0], [1, 0], [0, 2], [0, -2]], "
            "[[-1, 0], [1, 0], [0, -2], [0, 2]])",
            why="The target is the mirror image; yet one rotation does come closest.",
            returns="The rotation by π; never a reflection.",
            expected=lambda got: got[1] and np.allclose(got[0], np.diag([-1.0, -1.0, 1.0])),
        ),
        HardCase(
            id="mirrored-circle",
            call="estimate_rigid([[1, 0], [0, 1], [-1, 0], [0, -1]], "
            "[[1, 0], [0, -1], [-1, 0], [0, 1]])",
            why="Mirrored, and equally wide both ways: every rotation is equally bad.",
            returns="No estimate: atan2(0, 0) would invent the angle 0.",
            expected=invalid,
            naive="np.arctan2(0.0, 0.0)",
        ),
        HardCase(
            id="far-from-both-origins",
            call="estimate_homography(SQUARE + 1e6, SQUARE + 1e6)",
            why="In a land survey w is a difference of numbers a million times as large.",
            returns="Invalid: rounding the nine entries would move the corners too far.",
            expected=invalid,
        ),
        HardCase(
            id="on-the-plane-at-infinity-in-space",
            call="transforms_3d.apply_transform(np.eye(4)[[0, 1, 2, 2]], [1.0, 2.0, 0.0])",
            why="w = Z = 0: the plane Z = 0 is sent to infinity.",
            returns="Invalid.",
            expected=invalid,
            naive="np.array([1.0, 2.0, 0.0]) / 0.0",
        ),
        HardCase(
            id="three-points-on-a-line-in-space",
            call="transforms_3d.estimate_similarity(LINE, LINE)[1]",
            why="Any turn about the line brings them into place.",
            returns="False.",
            expected=lambda got: got is False,
        ),
        HardCase(
            id="points-too-close-to-square",
            call="transforms_3d.estimate_similarity(1e-200 * CORNERS, CORNERS)[0][0, 0]",
            why="The sum of the squared distances, which the scale is divided by, underflows to 0.",
            returns="1e200: both sets are brought to the size 1 before anything is squared.",
            expected=near(1e200),
            naive="np.divide(1.0, np.square(1e-200))",
        ),
        HardCase(
            id="plane-through-the-eye",
            call="plane_between_views(np.eye(3), np.eye(3), np.eye(4), [0.0, 1.0, 0.0, 0.0])",
            why="A plane through the first camera’s centre is seen as a line: n/d divides by 0.",
            returns="Refused.",
            expected=refused("plane", "not through the first camera"),
            naive="np.divide([0.0, 1.0, 0.0], 0.0)",
        ),
    ),
)
