"""Numbers and words that a figure shows, worked out by hand or printed in a chapter."""

from collections.abc import Mapping

import pytest
from support.frames import frame_of, texts_of

from simulations.registry import load_scene

type Given = Mapping[str, object]
type Shown = Mapping[str, str]

TURNED = {"pan": 90, "tilt": 0, "roll": 0}
NUMBERS: list[tuple[str, Given, Shown]] = [
    *(
        ("aliasing", {"frequency": true}, {"alias": seen})
        for true, seen in (
            (0.3, "0.30"),
            (0.5, "0.50"),
            (0.7, "0.30"),
            (0.8, "0.20"),
            (1.2, "0.20"),
        )
    ),
    *(
        (
            "aliasing",
            {"frequency": 0.7, "rate": rate},
            {"alias": seen, "nyquist": f"{rate / 2:.2f}"},
        )
        for rate, seen in ((1, "0.30"), (1.5, "0.70"), (0.5, "0.20"), (0.7, "0.00"))
    ),
    ("aliasing", {"frequency": 0.5, "prefilter": "box"}, {"passed": "0.637"}),
    ("aliasing", {"frequency": 0.8, "prefilter": "box"}, {"passed": "0.234", "period": "5.0"}),
    ("aliasing", {"frequency": 1, "prefilter": "box"}, {"passed": "0.000"}),
    ("aliasing", {"frequency": 1}, {"kept": "0.000", "period": "∞"}),
    ("bayer-demosaic", {}, {"samples": "25 / 50 / 25"}),
    ("camera-pose", {}, {"t": "(0.0, 0.0, 10.0)", "lamp": "(3.0, −1.0, 8.0)"}),
    (
        "depth-of-field",
        {"focal_length": 50, "aperture": 1.4, "focus": 3.2},
        {"far_mm": "0.340", "far_px": "2.5", "near_px": "3.0"},
    ),
    ("depth-of-field", {"focal_length": 24, "aperture": 8, "focus": 2}, {"far_limit": "∞"}),
    *(("gimbal", {"tilt": tilt}, {"rank": "2 of 3", "smallest": "0.000"}) for tilt in (-90, 90)),
    (
        "lambertian-shading",
        {},
        {"cosine": "0.866", "theta": "30", "albedo": "0.80", "brightness": "0.693", "code": "217"},
    ),
    ("lens-aberrations", {"stop": 0}, {"lateral": "0.00"}),
    *(
        ("lens-aberrations", {"aperture": aperture, "rim": 0}, {"natural_stops": "−2.00"})
        for aperture in (1.4, 16)
    ),
    ("lens-aberrations", {"natural": "false", "rim": 0}, {"corner_stops": "0.00"}),
    ("lens-distortion", {}, {"kind": "none", "bow": "0.0", "corner": "0.0", "fold": "none"}),
    # The corner moves by k₁ · 200 px; the middle of the upper edge, at y = 0.6, by 0.36 of that.
    ("lens-distortion", {"k1": -0.1}, {"kind": "barrel", "corner": "−20.0", "bow": "7.7"}),
    ("lens-distortion", {"k1": 0.1}, {"kind": "pincushion", "corner": "20.0"}),
    ("lens-distortion", {"k1": -0.2, "k2": 0.2}, {"kind": "moustache", "corner": "0.0"}),
    ("lens-distortion", {"k1": -0.5}, {"corner": "past the fold", "fold": "0.816"}),
    (
        "perspective-projection",
        {},
        {"X": "1.0", "Y": "0.5", "Z": "5.0", "f": "80", "x": "16.0", "y": "8.0", "view": "102.7"},
    ),
    *(
        ("perspective-projection", {"depth": depth}, {"x": shown, "y": shown})
        for depth, shown in (
            (-2, "behind"),
            (-0.1, "behind"),
            (0, "undefined"),
            (1e-17, "undefined"),
        )
    ),
    *(
        (
            "perspective-projection",
            {"camera": "scaled-orthographic", **given},
            {"x": "16.0", "y": "8.0"},
        )
        for given in ({"depth": -2}, {"depth": 0}, {"depth": 20})
    ),
    (
        "perspective-projection",
        {"camera": "scaled-orthographic", "focal_length": 160},
        {"x": "32.0"},
    ),
    # 100 px are 3 m wide at any distance: 33.3 px to the metre.
    *(
        (
            "perspective-projection",
            {"camera": "orthographic", **given},
            {"x": "33.3", "y": "16.7", "view": "6.0"},
        )
        for given in ({}, {"depth": 20}, {"depth": -2}, {"focal_length": 200})
    ),
    ("phong", {"light_angle": 180}, {"n_dot_h": "undefined"}),
    ("pinhole", {"hole": 1.0}, {"light": "25.00"}),
    ("real-lens", {"front": -20, "back": -20}, {"thick_at": "virtual"}),
    ("real-lens", {"front": 10, "back": -10}, {"focal_thin": "∞", "thin_at": "∞"}),
    *(
        ("rotation-3d", {"blend": b, "t": 0.37}, {"determinant": "1.000"})
        for b in ("slerp", "euler")
    ),
    ("rotation-3d", {**TURNED, "blend": "matrix", "t": 0.5}, {"determinant": "0.500"}),
    *(
        ("rotation-3d", {"pan": 0, "tilt": 0, "roll": 0, angle: 80}, {"off": "0.0"})
        for angle in ("pan", "tilt", "roll")
    ),
    ("sensor-noise", {"patch": 13}, {"theory": "23.2"}),
    ("sensor-noise", {"patch": 13, "iso": "800"}, {"theory": "23.2"}),
    ("sensor-noise", {"patch": 1}, {"theory": "clipped", "snr": "clipped"}),
    ("sensor-noise", {"bits": 4, "patch": 18, "read_noise": 0}, {"snr": "one code only"}),
    ("sensor-noise", {"bits": 4, "exposure": -6, "read_noise": 0}, {"gain": "not measurable"}),
    # 20 000 electrons over 3: 12.7 stops, less what rounding at 14 bits takes.
    ("sensor-noise", {"read_noise": 3, "bits": 14}, {"range": "12.7"}),
    ("slanted-edge", {"angle": 0}, {"measured": "—"}),
    ("slanted-edge", {"angle": 5}, {"rows": "11.4"}),
    ("stability", {"formula": "angle", "digits": "float32", "power": -12}, {"digits": "no inputs"}),
    ("tiled-floor", {"pitch": 0}, {"v3": "at infinity"}),
    ("tiled-floor", {"yaw": 0}, {"v2": "at infinity"}),
    (
        "transform-2d",
        {},
        {"matrix": "1.00 0.00 30.00\n0.00 1.00 15.00\n0 0 1", "freedoms": "2", "area": "1.000"},
    ),
    (
        "transform-2d",
        {"transform": "similarity", "amount": 100},
        {
            "area": "2.250",
            "lengths": "changed by up to 50.0 %",
            "orientation": "changed by up to 50.0°",
        },
    ),
    (
        "transform-2d",
        {"transform": "projective", "amount": 58},
        {"area": "∞", "lengths": "changed without bound"},
    ),
    # w = 1 − 0.01 · 60 + 0.0333 · (−12) = 0.
    (
        "transform-2d",
        {"transform": "projective", "amount": 100, "point_x": 60, "point_y": -12},
        {"x": "at infinity", "y": "at infinity"},
    ),
    # 80 px·m at 8 m: 10 px, give or take 2.
    ("two-views", {"matching_error": 2}, {"interval": "6.67 to 10.00", "first_order": "1.60"}),
    ("two-views", {"matching_error": 0}, {"interval": "8.00"}),
    ("two-views", {"toe_in": 20}, {"parallel": "none: d < 0"}),
    (
        "wagon-wheel",
        {"speed": 2.9, "spokes": 8, "frame_rate": 24},
        {"passing": "23.2", "apparent": "−0.10", "direction": "turn anticlockwise"},
    ),
    ("wagon-wheel", {"speed": 3, "spokes": 8, "frame_rate": 24}, {"direction": "stand still"}),
    *(
        (
            "wagon-wheel",
            {"speed": speed, "spokes": 8, "frame_rate": 24},
            {"apparent": "±1.50", "direction": "turn either way"},
        )
        for speed in (-4.5, -1.5, 1.5, 4.5)
    ),
]
WORDS: list[tuple[str, Given, str]] = [
    (
        "brdf",
        {"model": "phong", "specular": 0.5, "roughness": 0.6, "light_angle": -85},
        "more than came",
    ),
    ("gimbal", {"tilt": 90}, "one degree of freedom is lost"),
    ("lens-distortion", {"k1": -0.5}, "images nothing"),
    ("perspective-projection", {"depth": -2}, "behind the camera"),
    ("perspective-projection", {"depth": 0}, "undefined"),
    (
        "perspective-projection",
        {"depth": 0.5, "focal_length": 200},
        "x = 400.0 px, y = 200.0 px, outside the picture.",
    ),
    # Twice the reference depth: perspective has the point at half the distance from the middle.
    (
        "perspective-projection",
        {"camera": "scaled-orthographic", "depth": 10},
        "that is 8.9 px from where perspective has it.",
    ),
    ("phong", {"light_angle": 180}, "no highlight"),
    ("pinhole", {"hole": 0.2}, "mostly because of diffraction"),
    ("sensor-noise", {"patch": 1}, "patch 1 is clipped"),
    ("sensor-noise", {"bits": 4, "patch": 18, "read_noise": 0}, "one code only"),
    ("sensor-noise", {"bits": 4, "exposure": -6, "read_noise": 0}, "too few patches"),
    ("slanted-edge", {"angle": 0}, "no MTF"),
    ("spectrum-to-rgb", {"band": 500, "width": 10}, "no display"),
    ("tiled-floor", {"yaw": 0}, "those across them at infinity"),
    (
        "transform-2d",
        {"transform": "projective", "amount": 100, "point_x": 60, "point_y": -12},
        "P at (60, −12) goes to infinity.",
    ),
    ("two-views", {"depth": 20, "matching_error": 4}, "open from 10.00 m on"),
    ("two-views", {"depth": 2, "baseline": 1, "left_x": -50}, "outside the right picture"),
    (
        "wagon-wheel",
        {"speed": 1.5, "spokes": 8, "frame_rate": 24},
        "nothing in the film says which way",
    ),
]


@pytest.mark.parametrize(("scene", "given", "expected"), NUMBERS)
def test_a_figure_shows_known_numbers(scene: str, given: Given, expected: Shown) -> None:
    shown = texts_of(frame_of(load_scene(scene), **given))
    assert {name: plain(shown[name]) for name in expected} == {
        name: plain(text) for name, text in expected.items()
    }


def plain(text: str) -> str:
    """Lines with single spaces."""
    return "\n".join(" ".join(line.split()) for line in text.split("\n"))


@pytest.mark.parametrize(("scene", "given", "words"), WORDS)
def test_a_description_says_what_is_special(scene: str, given: Given, words: str) -> None:
    special, usual = (frame_of(load_scene(scene), **each).description for each in (given, {}))
    assert words in special
    assert words not in usual
