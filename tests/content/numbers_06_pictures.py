"""Chapter 6: pictures through the mosaic and through JPEG."""

import io
import re
from functools import cache

import numpy as np
import skimage.data
from PIL import Image
from support.worked_numbers import Says

from simulations.engine.stages import StageCache
from simulations.models.arrays import Floats
from simulations.models.color.cie import (
    rgb_to_xyz_matrix,
)
from simulations.models.color.srgb import decode_srgb, encode_srgb
from simulations.models.compression import jpeg
from simulations.models.compression.chroma_upsampling import METHODS as UPSAMPLING
from simulations.models.error_measures import psnr_db
from simulations.models.sensor.demosaicing import METHODS, demosaic, mosaic
from simulations.models.sensor.shared_detail import shared_detail
from simulations.pictures.balloon import WHOLE
from simulations.pictures.mosaic_subjects import SUBJECTS
from simulations.scenes.jpeg import SCENE as JPEG

CHAPTER = "06-digital-sensor"


PHOTOGRAPHS = {"coffee": "coffee", "cat": "chelsea", "astronaut": "astronaut"}


@cache
def photograph(name: str) -> Floats:
    """Of scikit-image, in linear light, at half size: its own camera has demosaiced it."""
    linear = decode_srgb(getattr(skimage.data, PHOTOGRAPHS[name])() / 255)
    rows, columns = (side // 2 for side in linear.shape[:2])
    halves = linear[: 2 * rows, : 2 * columns].reshape(rows, 2, columns, 2, 3)
    return np.asarray(halves.mean(axis=(1, 3)))


def photographs_through_the_mosaic() -> Says:
    shared: list[float] = []
    on_screen, in_light = [], []
    for name in PHOTOGRAPHS:
        truth = photograph(name)
        shared.extend(shared_detail(truth))
        guessed = [
            np.clip(demosaic(mosaic(truth), method=method), 0, 1)
            for method in ("bilinear", "menon-unrefined")
        ]
        shown = [psnr_db(encode_srgb(g), encode_srgb(truth), crop=8) for g in guessed]
        light = [psnr_db(g, truth, crop=8) for g in guessed]
        on_screen.append(shown[1] - shown[0])
        in_light.append(light[1] - light[0])
        cells = (f"{bilinear:.1f}, {menon:.1f}" for bilinear, menon in (shown, light))
        yield f"| {name} | {' | '.join(cells)} |"
    yield f"the correlations lie between {min(shared):.2f} and {max(shared):.2f}"
    yield "it wins by 4 to 6 dB in light, and on the screen by as little as 0.4 dB"
    assert round(min(in_light)) == 4
    assert round(max(in_light)) == 6
    assert round(min(on_screen), 1) == 0.4


def photographs_with_coarser_colour() -> Says:
    def psnr(name: str, subsampling: str, upsampling: str = "triangle") -> float:
        picture = np.rint(255 * encode_srgb(photograph(name))) / 255
        coded = jpeg.encode(jpeg.to_planes(picture), 100, subsampling)
        return psnr_db(np.rint(255 * jpeg.decode(coded, upsampling)) / 255, picture)

    coarse = {name: psnr(name, "4:2:0") for name in PHOTOGRAPHS}
    lost = {name: psnr(name, "4:4:4") - coarse[name] for name in PHOTOGRAPHS}
    yield (
        "lose "
        + ", ".join(f"{lost[n]:.0f} dB ({n})" for n in ("coffee", "cat"))
        + (f" and {lost['astronaut']:.0f} dB (astronaut)")
    )
    yield f"end between {min(coarse.values()):.0f} and {max(coarse.values()):.0f} dB"
    gains = [psnr(name, "4:2:0", "guided") - coarse[name] for name in PHOTOGRAPHS]
    best = {m: jpeg_psnr(quality=100, upsampling=m) for m in ("triangle", "guided")}
    yield (
        f"following luma gains {min(gains):.1f} to {max(gains):.1f} dB over the triangle, "
        f"and not {best['guided'] - best['triangle']:.1f} dB as here"
    )
    full = jpeg_psnr(quality=100, subsampling="4:4:4")
    yield f"4:2:0 costs {full - best['triangle']:.0f} dB at quality 100"


def jpeg_psnr(**given: object) -> float:
    """What the figure shows."""
    return float(JPEG.run(JPEG.check(given), "", StageCache()).outputs["psnr"])


def transforms_that_round_otherwise() -> Says:
    def changed(tier: str, **given: object) -> tuple[float, int]:
        *_, last = JPEG.estimates(JPEG.check(given), tier, StageCache())
        found = re.search(r"\((\d+) round otherwise\)", last.label)
        assert found is not None
        return float(last.text) if tier == "fixed-point" else 0.0, int(found[1])

    best = {"quality": 100, "subsampling": "4:4:4"}
    error, at_low = changed("fixed-point", quality=30)
    assert 1 / 3 < error < 0.5
    yield "may be more than a third of a code off"
    assert 12 <= at_low <= 28
    yield "At quality 30 that moves some twenty of the numbers kept."
    assert changed("fixed-point", **best)[1] > 2000
    yield "it moves thousands of them"
    for tier in ("separable-32", "direct-32"):
        assert 25 <= changed(tier, **best)[1] <= 35
    yield "moves some thirty"


def threads_of_red_and_cyan() -> Says:
    red, green, blue = rgb_to_xyz_matrix()[1]
    threads = np.zeros((96, 96, 3))
    on = np.arange(96) // 3 % 2 == 0
    threads[:, on, 0], threads[:, ~on, 1:] = 0.6, 0.6 * red / (green + blue)
    blurred = (threads + np.roll(threads, 1, axis=1) + np.roll(threads, -1, axis=1)) / 3
    psnr = {
        method: psnr_db(
            encode_srgb(np.clip(demosaic(mosaic(blurred), method=method), 0, 1)),
            encode_srgb(blurred),
            crop=8,
        )
        for method in ("bilinear", "malvar")
    }
    yield f"Bilinear interpolation gives about {psnr['bilinear']:.0f} dB"
    assert psnr["malvar"] < psnr["bilinear"] - 5
    yield "the result is worse by several decibels"
    yield "There Malvar's method does much worse than plain bilinear interpolation."


@cache
def scores(picture: str) -> dict[str, tuple[float, float]]:
    """Of each method on a picture: PSNR as displayed, and in light."""
    truth = SUBJECTS[picture].draw(WHOLE)
    guessed = {m: np.clip(demosaic(mosaic(truth), method=m), 0, 1) for m in METHODS}
    return {
        m: (psnr_db(encode_srgb(guess), encode_srgb(truth), crop=8), psnr_db(guess, truth, crop=8))
        for m, guess in guessed.items()
    }


def what_the_methods_gain() -> Says:
    room, balloon, soft = (
        {method: shown for method, (shown, _) in scores(name).items()}
        for name in ("room", "balloon", "soft")
    )
    default = "menon-unrefined"
    assert room[default] > room["bilinear"] + 7
    yield "which share none, it is the other way round"
    assert soft[default] < soft["bilinear"] - 7
    yield "which shares some, the two are level"
    assert abs(balloon[default] - balloon["bilinear"]) < 0.5
    yield "it gains two tenths of a decibel in the room, and loses on the other two pictures"
    assert round(room["menon"] - room[default], 1) == 0.2
    for other in (balloon, soft):
        assert other["menon"] < other[default] - 0.3
    yield "on the screen it is slightly behind"
    assert -1 < balloon["malvar"] - balloon["bilinear"] < -0.2
    yield "and lost in light, by sending the mosaic through the curve first"
    light = {method: light for method, (_, light) in scores("balloon").items()}
    assert light["menon-encoded"] < light[default] - 1
    assert balloon["menon-encoded"] > balloon[default] + 1
    assert light["malvar"] > light["bilinear"] + 2


def errors_in_the_dark() -> Says:
    truth = SUBJECTS["balloon"].draw(WHOLE)
    guess = np.clip(demosaic(mosaic(truth), method="malvar"), 0, 1)
    squared = np.square(encode_srgb(guess) - encode_srgb(truth), dtype=np.float64)
    inner = (slice(8, -8), slice(8, -8))
    dark = truth[inner] < 1 / 20
    assert 0.47 < squared[inner][dark].sum() / squared[inner].sum() < 0.55
    assert 1 / 10 < dark.mean() < 1 / 8
    yield "Half of Malvar's squared error on the screen lies in the darkest ninth of the values"
    yield "those below a twentieth of white"


def colour_filled_in_at_quality_30() -> Says:
    coarse = {method: jpeg_psnr(upsampling=method) for method in UPSAMPLING}
    best = max(coarse.values())
    yield "all but repetition lie within a quarter of a decibel"
    assert all(best - coarse[m] < 0.25 for m in UPSAMPLING if m != "repeated")
    assert best - coarse["repeated"] > 0.4
    assert coarse["triangle"] > best - 0.02
    fine = {method: jpeg_psnr(upsampling=method, quality=100) for method in UPSAMPLING}
    yield "The parabola and *following luma* gain much at quality 100"
    assert fine["parabola"] > fine["triangle"] + 1
    assert fine["guided"] > fine["parabola"] + 2


def files_of_the_picture() -> Says:
    """Pillow's entropy-coded data, with codes fitted to the picture or ready-made."""
    excess: dict[bool, list[float]] = {True: [], False: []}
    for quality in (30, 50, 75, 90):
        outputs = JPEG.run(JPEG.check({"quality": quality}), "", StageCache()).outputs
        picture = Image.fromarray(np.rint(255 * outputs["original"]).astype(np.uint8))
        for fitted, found in excess.items():
            file = io.BytesIO()
            picture.save(file, "JPEG", quality=quality, subsampling=2, optimize=fitted)
            data = file.getvalue()
            scan = data.index(b"\xff\xda")
            start = scan + 2 + int.from_bytes(data[scan + 2 : scan + 4])
            bits = 8 * len(data[start:-2].replace(b"\xff\x00", b"\xff"))
            found.append(bits / outputs["size"].bits - 1)
    assert all(0.01 < share < 0.025 for share in excess[True])
    assert all(0.04 < share < 0.06 for share in excess[False])
    yield "one or two per cent larger when their codes are fitted to the picture"
    yield "about five when they are the ready-made ones"
