"""Light from below, grazing light, normals of no length, highlights as sharp as a needle."""

import numpy as np

from simulations.engine.hard_cases import (
    HardCase,
    HardCases,
    LibraryAnswer,
    exactly,
    near,
    refused,
)
from simulations.models.light import reflectance

TABLE = HardCases(
    id="reflectance",
    title="Light and reflectance",
    names={**vars(reflectance), "inf": np.inf, "nan": np.nan},
    cases=(
        HardCase(
            id="from-behind",
            call="lambert([0.0, 0.0, 1.0], [0.0, 0.0, -1.0])",
            why="The light is below the surface's horizon: n · l is negative.",
            returns="0. A surface cannot reflect less than no light.",
            expected=exactly(0.0),
            naive="np.dot([0, 0, 1.0], [0, 0, -1.0])",
        ),
        HardCase(
            id="grazing",
            call="lambert([0.0, 0.0, 1.0], [1.0, 0.0, 0.0])",
            why="Along the surface: the border between lit and dark.",
            returns="0, and continuous from either side.",
            expected=exactly(0.0),
        ),
        HardCase(
            id="no-normal",
            call="lambert([0.0, 0.0, 0.0], [0.0, 0.0, 1.0])",
            why="Where a ray met nothing there is no normal.",
            returns="0: nothing there is lit.",
            expected=exactly(0.0),
        ),
        HardCase(
            id="normalise-zero",
            call="normalise([0.0, 0.0, 0.0])",
            why="0/0 three times over.",
            returns="Zero stays zero, so that pictures with holes need no special case.",
            expected=exactly([0.0, 0.0, 0.0]),
            naive="np.zeros(3) / np.linalg.norm(np.zeros(3))",
        ),
        HardCase(
            id="normalise-tiny",
            call="normalise([3e-200, 0.0, 4e-200])",
            why="The squares underflow: the length seems to be zero.",
            returns="(0.6, 0, 0.8).",
            expected=near([0.6, 0.0, 0.8]),
            naive="np.array([3e-200, 0, 4e-200]) / np.sqrt(np.sum(np.square([3e-200, 4e-200])))",
            library=LibraryAnswer(
                "cv2.normalize(np.array([3e-200, 0.0, 4e-200]), None).ravel()", "[0, 0, 0]"
            ),
        ),
        HardCase(
            id="normalise-huge",
            call="normalise([3e200, 0.0, 4e200])",
            why="The squares overflow.",
            returns="(0.6, 0, 0.8).",
            expected=near([0.6, 0.0, 0.8]),
            naive="np.array([3e200, 0, 4e200]) / np.sqrt(np.sum(np.square([3e200, 4e200])))",
            library=LibraryAnswer(
                "cv2.normalize(np.array([3e200, 0.0, 4e200]), None).ravel()", "[0, 0, 0]"
            ),
        ),
        HardCase(
            id="above-one-by-an-ulp",
            call="cosine(np.float32([1.0000001, 0, 0]), np.float32([1.0000001, 0, 0]))",
            why="A float32 unit vector times itself can exceed 1 by an ulp.",
            returns="1: clamped before anything is raised to a power.",
            expected=exactly(1.0),
            naive="np.float32(1.0000001) ** 2 > 1",
        ),
        HardCase(
            id="needle-highlight",
            call="phong(np.float32([1.0000001, 0, 0]), [1.0, 0, 0], [1.0, 0, 0], 0.0, "
            "shininess=1e9)",
            why="1.0000001 to the power of a billion is 3e43.",
            returns="0.5, the specular share: the cosine was held to 1 first.",
            expected=near(0.5, 1e-6),
            naive="0.5 * np.float64(1.0000001) ** 1e9",
        ),
        HardCase(
            id="mirror-off-the-peak",
            call="phong([0.0, 0.0, 1.0], [0.0, 0.0, 1.0], [0.0, 0.6, 0.8], 0.0, shininess=1e300)",
            why="0.8 to the power 1e300 underflows.",
            returns="0, silently: a perfect mirror shows the light in one direction only.",
            expected=exactly(0.0),
        ),
        HardCase(
            id="shininess-zero",
            call="phong([0.0, 0.0, 1.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0], 0.0, shininess=0.0)",
            why="0⁰: seen from the side, with no shininess at all.",
            returns="0.5: the highlight is spread evenly, as 0⁰ = 1 says.",
            expected=exactly(0.5),
        ),
        HardCase(
            id="highlight-in-the-shade",
            call="phong([0.0, 0.0, 1.0], [0.0, 0.6, -0.8], [0.0, -0.6, 0.8], 0.5)",
            why="The light is below the horizon, yet 2(n·l)n − l still points somewhere.",
            returns="0: no light, no highlight.",
            expected=exactly(0.0),
            naive="0.5 * 1.0**32",
        ),
        HardCase(
            id="light-opposite-the-eye",
            call="blinn_phong([0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [0.0, -1.0, 0.0], 0.5)",
            why="Light and eye exactly opposed: the halfway vector is (0, 0, 0).",
            returns="0: there is no halfway direction, and no highlight.",
            expected=exactly(0.0),
            naive="(np.zeros(3) / np.linalg.norm(np.zeros(3)))[2]",
        ),
        HardCase(
            id="opposed-without-shininess",
            call="blinn_phong([0.0, 0.0, 1.0], [0.0, 0.0, 1.0], [0.0, 0.0, -1.0], 0.0, "
            "shininess=0.0)",
            why="No halfway direction, and no shininess: the cosine that is not there, to the "
            "power 0, is 0⁰ = 1.",
            returns="0: what no direction mirrors into the eye has no highlight, of any shape.",
            expected=exactly(0.0),
            naive="0.5 * np.float64(0.0) ** 0.0",
        ),
        HardCase(
            id="opposed-but-for-rounding",
            call="blinn_phong([0.0, 0.0, 1.0], [0.0, 0.0, 1.00005], [0.0, 0.0, -1.0], 0.0)",
            why="A length that is off by 5e−5 leaves a halfway vector of (0, 0, 5e−5), which "
            "normalises to n itself.",
            returns="0: shorter than the lengths are known, it points nowhere.",
            expected=exactly(0.0),
            naive="0.5 * (np.float64(1.00005 - 1.0) / abs(1.00005 - 1.0)) ** 128",
        ),
        HardCase(
            id="light-of-wrong-length",
            call="lambert([0.0, 0.0, 1.0], [0.0, 0.0, 2.0])",
            why="A direction that was never normalised would make the wall twice as bright.",
            returns="Refused.",
            expected=refused("light", "length 1"),
            naive="np.dot([0, 0, 1.0], [0, 0, 2.0])",
        ),
        HardCase(
            id="albedo-above-one",
            call="lambert([0.0, 0.0, 1.0], [0.0, 0.0, 1.0], 1.2)",
            why="A surface that gives back more light than it gets.",
            returns="Refused.",
            expected=refused("albedo", "1.2"),
        ),
        HardCase(
            id="at-the-lamp",
            call="attenuation(0.0)",
            why="The inverse square of zero distance.",
            returns="The value at the lamp's own radius, 1 cm: no point is nearer than that.",
            expected=near(1e4),
            naive="1 / np.float64(0.0) ** 2",
        ),
        HardCase(
            id="infinitely-far-lamp",
            call="attenuation(inf)",
            why="1/∞².",
            returns="0.",
            expected=exactly(0.0),
        ),
        HardCase(
            id="very-far-lamp",
            call="attenuation(1e200)",
            why="The square of the distance overflows; the light is merely very faint.",
            returns="0, without a warning: 1e−400 is below the smallest number.",
            expected=exactly(0.0),
        ),
        HardCase(
            id="negative-distance",
            call="attenuation(-1.0)",
            why="Squared, a negative distance looks like a positive one.",
            returns="Refused.",
            expected=refused("distance", "-1.0"),
            naive="1 / np.float64(-1.0) ** 2",
        ),
        HardCase(
            id="far-point-light",
            call="irradiance([0.0, 0.0, 0.0], [0.0, 0.0, 1.0], "
            "[PointLight((0.0, 0.0, 1e200), (1.0, 1.0, 1.0))])",
            why="The distance to the lamp overflows when its components are squared.",
            returns="0 in all three colours.",
            expected=exactly([0.0, 0.0, 0.0]),
        ),
        HardCase(
            id="unlit",
            call="irradiance([0.0, 0.0, 0.0], [0.0, 0.0, 1.0], [])",
            why="A sum over no lights.",
            returns="Darkness.",
            expected=exactly([0.0, 0.0, 0.0]),
        ),
        HardCase(
            id="undefined-highlight",
            call="phong((0.0, 0.0, 1.0), (0.0, 0.0, 1.0), (0.0, 0.0, 1.0), specular=nan)",
            why="A single undefined parameter would blacken or blanch the whole picture.",
            returns="Refused, by name.",
            expected=refused("specular", "nan"),
        ),
        HardCase(
            id="negative-lamp",
            call="PointLight((0.0, 0.0, 1.0), (1.0, -1.0, 1.0))",
            why="A lamp that takes light away.",
            returns="Refused.",
            expected=refused("intensity", "-1.0"),
        ),
    ),
)
