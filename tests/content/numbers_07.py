"""Chapter 7: sampling."""

import json

import numpy as np
import skimage
from support.frames import outputs_of
from support.worked_numbers import CONTENT, Phrases

from simulations.illustrations.twelve_turns import TITLES, quality, turned
from simulations.models.lens.diffraction import lens_transfer
from simulations.models.sampling.first_fall import first_fall
from simulations.models.sampling.resampling import KERNELS
from simulations.models.sensor.resolution import pixel_transfer
from simulations.pictures.round_windows import TURN_RAD, TURNS, pictures_at, places
from simulations.scenes.slanted_edge.edge import Sharpness
from simulations.scenes.slanted_edge.scene import SCENE as SLANTED_EDGE

CHAPTER = "07-sampling-and-aliasing"


def _sharpness(**settings: object) -> Sharpness:
    found: Sharpness = outputs_of(SLANTED_EDGE, **settings)["sharpness"]
    return found


def the_error_of_one_edge() -> Phrases:
    found = _sharpness()
    assert found.reading is not None
    rows = found.reading.pixels.line.rows.size
    yield f"The rectangle of the figure holds {rows} rows, and the noise is 1 % of the step"
    half = found.half.frequency
    contrast, errors = found.reading.transfer(half * np.array([0.8, 1.0, 1.2]))
    fall = float(contrast[0] - contrast[2]) / (0.4 * half)
    error = float(errors[1]) / fall
    yield f"falls to one half at {half:.3f} cycles per pixel, where its standard error is "
    yield f"its standard error is {errors[1]:.4f}. From 0.8 to 1.2 times that frequency"
    yield f"it falls from {contrast[0]:.3f} to {contrast[2]:.3f}, by {fall:.2f} per cycle per pixel"
    yield f"is ${errors[1]:.4f} / {fall:.2f} = {error:.4f}$ cycles per pixel"
    yield f"{250 * error:.1f} cycles per millimetre: an error of {100 * error / half:.1f} %"
    assert np.isclose(error, found.half.error, rtol=0.02)


def halfway_between_two_samples() -> Phrases:
    def value(count: int) -> float:
        n = np.arange(1 - count // 2, 1 + count // 2)
        return float(np.cos(0.4 * np.pi * n) @ np.sinc(0.5 - n))

    one, two = np.sinc([0.5, 1.5])
    wave = np.cos(0.4 * np.pi * np.arange(-1, 3))
    yield f"{one:.3f} \\cdot {1 + wave[2]:.3f} = {value(2):.3f}$"
    yield f"${two:.3f} \\cdot ({wave[0] + wave[3]:.1f}) = {two * (wave[0] + wave[3]):.3f}$"
    yield f"which makes it worse: {value(4):.3f}. Six samples give {value(6):.3f}"
    yield f"ten {value(10):.3f}, a hundred {value(100):.3f} and a thousand {value(1000):.3f}"
    n = np.arange(-2, 4)
    weights = KERNELS["lanczos3"].weigh(0.5 - n)
    windowed = np.cos(0.4 * np.pi * n) @ weights / weights.sum()
    yield f"the sinc makes {windowed:.3f} of the six samples"
    yield f"in place of {value(6):.3f}, where {np.cos(np.pi / 5):.3f} is right"


def edges_and_waves_after_a_small_spot() -> Phrases:
    spot = np.array([0.25, 0.5, 0.25])
    assert np.convolve([0, 0, 0, 1, 1, 1], spot, "same")[1:5].tolist() == [0, 0.25, 0.75, 1]
    yield "An edge with the values 0, 0, 1, 1 then becomes 0, ¼, ¾, 1"
    sums = [spot @ np.cos(2 * np.pi * f * np.arange(-1, 2)) for f in (0, 0.25, 0.5)]
    assert np.allclose(sums, [1, 0.5, 0])
    yield "1 at $f = 0$, ½ at a quarter cycle per pixel and 0 at Nyquist"


def mtf50_with_pixels_as_small_as_points() -> Phrases:
    frequency = np.linspace(0, 200, 20001)
    half = first_fall(frequency, lens_transfer(frequency, 0.55, 8), 0.5)
    yield f"even pixels as small as points would not bring it beyond {half:.0f}"
    four, two = (_mtf50_at_f_8(pitch) for pitch in (4, 2))
    yield "by a seventh, not by a factor of two"
    assert round(1 / (two / four - 1)) == 7
    yield "At this frequency a pixel of 4 µm takes about a seventh of the contrast"
    assert round(1 / (1 - float(pixel_transfer(four, 4)))) == 7


def _mtf50_at_f_8(pitch: float) -> float:
    frequency = np.linspace(0, 200, 20001)
    both = lens_transfer(frequency, 0.55, 8) * pixel_transfer(frequency, pitch)
    return first_fall(frequency, both, 0.5)


def a_shift_costs_more_than_a_blur_on_photographs() -> Phrases:
    for name in ("astronaut", "camera", "chelsea", "coffee", "rocket"):
        photograph = getattr(skimage.data, name)() / 255
        across = np.fft.fftfreq(photograph.shape[1])
        coarse = np.hypot(np.fft.fftfreq(len(photograph))[:, None], across) < 1 / 6
        waves = np.fft.fft2(photograph.T) * coarse.T
        errors = (
            np.roll(photograph, 2, axis=1) - photograph,
            np.fft.ifft2(waves).real.T - photograph,
        )
        moved, dulled = (np.mean(error[16:-16, 16:-16] ** 2) for error in errors)
        assert 10 * np.log10(moved / dulled) > 5
    yield "On five photographs the result is the same."


def detail_after_twelve_turns() -> Phrases:
    """The pictures in the page have the numbers that the ladder measured."""
    ladder = json.loads((CONTENT / "measurements.json").read_text("utf-8"))["ladders"]["resampling"]
    truth = pictures_at(*places(TURNS * TURN_RAD))
    for kernel in TITLES:
        errors = ladder["tiers"][kernel]["errors"]
        measured = [errors[name] for name in ("psnr-often", "present", "in-place")]
        np.testing.assert_allclose(quality(turned(kernel), truth), measured, rtol=1e-3)
    yield "more than 100 % is present, and little of it in place"


def weights_of_the_cubic_halfway() -> Phrases:
    far, near = 16 * KERNELS["bicubic"].weigh(np.array([1.5, 0.5]))
    assert np.isclose(2 * (far + near), 16), "they add up to one"
    yield "are 1.5, 0.5, 0.5 and 1.5 pixels away"
    yield f"are ${far:g}/16$, ${near:g}/16$, ${near:g}/16$ and ${far:g}/16$"


def weights_of_the_spline_halfway() -> Phrases:
    far, near = 48 * KERNELS["spline"].weigh(np.array([1.5, 0.5]))
    assert np.isclose(2 * (far + near), 48)
    yield f"are ${far:g}/48$, ${near:g}/48$, ${near:.0f}/48$ and ${far:g}/48$"
    own, beside = 6 * KERNELS["spline"].weigh(np.array([0.0, 1.0]))
    yield f"it has ${own:g}/6$ on its own sample and ${beside:g}/6$ on each"
