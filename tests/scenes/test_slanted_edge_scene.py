"""The slanted-edge figure against the formulae, on photographs, and its refusals."""

import csv
import io
import json
import re

import numpy as np
import pytest
from scipy.ndimage import shift as shifted
from support.charts import gaussian_edge, gaussian_half, grain
from support.frames import frame_of, outputs_of, pixels_of, texts_at, texts_of

from simulations.engine.frame import Frame
from simulations.engine.photograph import Mosaic, Photograph
from simulations.engine.reading import UnfitError
from simulations.engine.stages import StageCache
from simulations.models.color.srgb import encode_srgb
from simulations.models.sensor.bayer import mosaic
from simulations.models.sensor.resolution import pixel_pitch_um
from simulations.scenes.slanted_edge.plots import OF_LINE
from simulations.scenes.slanted_edge.results import sheet
from simulations.scenes.slanted_edge.scene import SCENE

HALF = gaussian_half(1.5)


@pytest.mark.parametrize("aperture", [4, 11])
@pytest.mark.parametrize("angle", [3, 14, 26.5, 40])
def test_measured_sharpness_agrees_with_lens_and_pixel(aperture: float, angle: float) -> None:
    shown = texts_at(SCENE, angle=angle, aperture=aperture, noise=0.3)
    assert float(shown["measured"]) == pytest.approx(float(shown["true"]), rel=0.03)


@pytest.mark.parametrize("wave", [0.1, 0.25, 0.4, 0.6])
def test_area_of_the_drawn_product_is_the_printed_contrast(wave: float) -> None:
    """Parts below zero count against those above; faint light beyond the panel is missing."""
    (drawn,) = (each.overlay for each in frame_of(SCENE, wave=wave).panels if each.name == "line")
    (points,) = re.findall(r'class="image fill thin" points="([^"]*)"', drawn)
    x, y = np.array([point.split(",") for point in points.split()], float).T
    area = 0.5 * abs(x @ np.roll(y, 1) - y @ np.roll(x, 1))
    units = (388 - 34) / 8 * (OF_LINE.place(0.0) - OF_LINE.place(1.0))
    assert area / units == pytest.approx(float(texts_at(SCENE, wave=wave)["contrast"]), abs=0.02)


def photograph(width: int, height: int, **facts: float) -> Photograph:
    """An edge through the middle of a file."""
    light = 0.05 + 0.8 * gaussian_edge(height, width, 5.0, 1.5)
    light += grain(light.shape, 0.005, 4)
    codes = np.rint(255 * encode_srgb(np.clip(light, 0, 1))).astype(np.uint8)
    return Photograph(1, np.repeat(codes[..., None], 3, axis=2), "edge.jpg", facts)


def transposed(picture: Photograph) -> Photograph:
    return Photograph(2, np.ascontiguousarray(picture.codes.transpose(1, 0, 2)))


def frame_from(picture: Photograph, **given: object) -> Frame:
    return SCENE.render(SCENE.check(given), "", StageCache(), picture)


@pytest.mark.parametrize(
    ("picture", "given"),
    [
        (photograph(320, 240), {}),
        (photograph(240, 320), {}),
        (photograph(500, 200), {}),
        (transposed(photograph(300, 300)), {}),
        (photograph(3000, 2000), {"width": 10, "height": 10}),
    ],
    ids=["wide", "high", "very wide", "horizontal edge", "large"],
)
def test_photograph_is_measured_in_its_own_pixels(
    picture: Photograph, given: dict[str, object]
) -> None:
    seen = frame_from(picture, **given)
    texts = texts_of(seen)
    assert float(texts["per_px"]) == pytest.approx(HALF, rel=0.02)
    assert (texts["true"], texts["place"]) == ("unknown", "0")
    assert max(pixels_of(seen).shape) <= 1200


def fringed() -> Photograph:
    """A dark square, a lens with lateral colour behind it: red 0.3 px to the right of green."""
    lights = []
    for shift in (0.3, 0.0, 0.0):
        edges = [gaussian_edge(400, 600, 5.0), gaussian_edge(600, 400, 5.0).T]
        near = [np.roll(edges[0], -120, 1), np.roll(edges[1], -90, 0)]
        far = [1 - np.roll(edges[0], 60, 1), 1 - np.roll(edges[1], 70, 0)]
        inside = np.prod([*near, *far], axis=0)
        lights.append(0.6 - 0.4 * np.asarray(shifted(inside, (0.0, shift), order=3)))
    light = np.stack(lights, axis=2) + grain((400, 600, 3), 0.003, 1)
    codes = np.rint(255 * encode_srgb(np.clip(light, 0, 1))).astype(np.uint8)
    return Photograph(3, codes, "square.jpg", {"full_width": 600.0, "full_height": 400.0})


def test_edge_near_a_press_is_found_and_has_the_lateral_colour() -> None:
    picture = fringed()
    settings = SCENE.clamp({"x": 68, "y": 36})
    found = SCENE.clamp({**SCENE.pull(settings, "find", (0, 0), "", picture)})
    pressed = SCENE.pull(settings, "rectangle", (272.0, 144.0), "", picture)
    assert pressed["x"] == pytest.approx(found.x, abs=2)
    run = SCENE.run(found, "", StageCache(), picture)
    half, tone = run.outputs["sharpness"].half, run.outputs["sharpness"].tone
    assert half.frequency == pytest.approx(gaussian_half(1.0), rel=0.02)
    assert 0.01 < tone / half.frequency < 0.1
    lines = {line.name: line.text for line in sheet(found, run.outputs)}
    red, _, error = lines["lateral_1"].partition(";")[0].split()
    assert abs(float(red.replace("−", "-"))) == pytest.approx(0.3, abs=4 * float(error))
    raw = Photograph(4, picture.codes, "square.dng", {**picture.facts, "raw": 1})
    assert not SCENE.run(found, "", StageCache(), raw).outputs["sharpness"].tone
    plain = Photograph(5, np.full((400, 600, 3), 90, np.uint8))
    assert SCENE.pull(settings, "find", (0, 0), "", plain) == {}


@pytest.mark.parametrize("apart", [0.0, 0.5, 1.0])
def test_error_counts_how_much_the_colours_differ(apart: float) -> None:
    """Red and blue so many pixels to either side of green; with noise alone, nothing is added."""
    edge = gaussian_edge(240, 320, 5.0, 0.9)
    moved = [np.asarray(shifted(edge, (0.0, off), mode="nearest")) for off in (-apart, 0.0, apart)]
    light = 0.1 + 0.35 * np.stack(moved, axis=2) + grain((240, 320, 3), 0.003, 1)
    picture = Photograph(
        6, np.rint(255 * encode_srgb(light)).astype(np.uint8), "edge.dng", {"raw": 1}
    )
    found = SCENE.run(SCENE.check({}), "", StageCache(), picture).outputs["sharpness"]
    off = abs(found.half.frequency - gaussian_half(0.9))
    assert off < 2 * found.half.error
    assert (found.colour > 0.004) == (apart > 0)
    assert len(found.channels) == 3


@pytest.mark.parametrize("tint", [(1.0, 1.0, 1.0), (1.3, 1.0, 0.4)])
def test_colours_of_a_raw_file_are_measured_by_their_own_cells(tint: tuple[float, ...]) -> None:
    """Whatever the light; the number of the picture is that of green."""
    spots = (1.3, 0.9, 1.1)
    edges = [gaussian_edge(241, 321, 5.0, spot) for spot in spots]
    light = 0.05 + 0.6 * np.stack(edges, axis=2) + grain((241, 321, 3), 0.005, 2)
    codes = np.rint(512 + 15871 * mosaic(tint * light, "GRBG")).astype(np.uint16)
    cells = Mosaic(codes, "GRBG", (512.0,) * 4, 16383)
    shown = np.full((120, 160, 3), 90, np.uint8)
    picture = Photograph(7, shown, "edge.dng", {"raw": 1, "full_width": 321.0}, cells)
    settings = SCENE.check({})
    outputs = SCENE.run(settings, "", StageCache(), picture).outputs
    found = outputs["sharpness"]
    for one, spot in zip(found.channels, spots, strict=True):
        half = one.half_contrast()
        assert abs(half.frequency - gaussian_half(spot)) < 3 * half.error
        assert half.error < 0.02 * half.frequency
    assert found.half == found.channels[1].half_contrast()
    assert "green cells" in sheet(settings, outputs)[0].label


def test_reduced_photograph_gives_no_number() -> None:
    settings = SCENE.check({"kept": ";0.4,0.3_0.6,0.6"})
    run = SCENE.run(settings, "", StageCache(), photograph(300, 200, full_width=600.0))
    assert "scaled down" in run.outputs["sharpness"].refusal
    assert not sheet(settings, run.outputs)


def test_pixel_pitch_follows_from_focal_length_and_equivalent() -> None:
    """A full-frame camera of 6000 × 4000 pixels, a crop of 1.5, and a telephone."""
    assert pixel_pitch_um(50, 50, 6000, 4000) == pytest.approx(6.0, rel=1e-3)
    assert pixel_pitch_um(50, 75, 6000, 4000) == pytest.approx(4.0, rel=1e-3)
    facts = {"focal_mm": 4.2, "focal_35mm_mm": 26.0, "full_width": 300.0, "full_height": 225.0}
    settings = SCENE.check({})
    run = SCENE.run(settings, "", StageCache(), photograph(300, 200, **facts))
    lines = {line.name: line.text for line in sheet(settings, run.outputs)}
    assert float(lines["pitch"]) == pytest.approx(18.64, abs=0.01)
    per_mm, per_px = (float(lines[name].split()[0]) for name in ("mtf50_mm_1", "mtf50_1"))
    assert per_mm == pytest.approx(1000 / 18.64 * per_px, rel=0.02)
    assert lines["mtf50_1"].startswith(f"{HALF:.2f}")


def test_refused_edge_gives_neither_sheet_nor_file() -> None:
    settings, outputs = SCENE.check({"x": 20}), outputs_of(SCENE, x=20)
    assert "Too little contrast" in frame_of(SCENE, x=20).panels[0].overlay
    assert sheet(settings, outputs) == ()
    with pytest.raises(UnfitError, match="contrast"):
        SCENE.instrument.exports[0].make(settings, outputs)


def test_files_agree_with_the_figure() -> None:
    made = {e.name: e.make(SCENE.check({}), outputs_of(SCENE)) for e in SCENE.instrument.exports}
    found = json.loads(made["sharpness"])
    assert f"{found['rectangle']['mtf50_cycles_per_px']:.3f}" == texts_at(SCENE)["per_px"]
    assert found["kept"] == []
    mtf, light = (list(csv.DictReader(io.StringIO(made[name]))) for name in ("mtf", "esf"))
    assert float(mtf[0]["contrast"]) == 1.0
    assert (mtf[25]["cycles_per_px"], mtf[25]["cycles_per_mm"]) == ("0.5", "125")
    assert [float(row["light"]) for row in (light[0], light[-1])] == pytest.approx([0, 1], abs=0.02)


def test_kept_places_appear_in_picture_sheet_and_file() -> None:
    kept: dict[str, object] = {"y": 20.0, "height": 20.0}
    for y in (60.0, 37.5):
        kept = {**kept, **SCENE.pull(SCENE.check(kept), "keep", (0.0, 0.0)), "y": y}
    settings, cache, picture = SCENE.check(kept), StageCache(), photograph(320, 240)
    outputs = SCENE.run(settings, "", cache, picture).outputs
    places = outputs["places"]
    assert [(each.box.top, each.box.bottom) for each in places] == [(32, 96), (160, 224)]
    halves = [each.sharpness.half.frequency for each in places]
    overlay = SCENE.render(settings, "", cache, picture).panels[0].overlay
    assert all(f">{half:.3f}<" in overlay for half in halves)
    lines = [line for line in sheet(settings, outputs) if line.unit == "cycles/px"]
    values = [float(line.text.partition(" ± ")[0]) for line in lines]
    assert values == pytest.approx(halves, abs=0.001)
    assert "28 %" in lines[0].label
    (made,) = (each.make for each in SCENE.instrument.exports if each.name == "sharpness")
    assert len(json.loads(made(settings, outputs))["kept"]) == 2
    assert SCENE.pull(settings, "forget", (0.0, 0.0)) == {"kept": ""}
