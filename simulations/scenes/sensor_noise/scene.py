"""A room and a step wedge photographed by a noisy sensor, and the sensor's gain from the noise.

Twenty-four patches, each half a stop darker than the one before, are counted, read and rounded.
Half the variance of the difference of two frames, against the mean, is the photon-transfer curve;
the slope of its middle part measures the conversion gain without opening the camera.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from simulations.engine.accuracy import Accuracy, tiers
from simulations.engine.drawing import cased, circle, dot, line, rectangle, text
from simulations.engine.frame import (
    Frame,
    Panel,
    Readout,
    Sound,
    format_number,
    readout,
    value_with_error,
)
from simulations.engine.handles import Handle, Point
from simulations.engine.instrument import Instrument
from simulations.engine.plotting.axis import Axis
from simulations.engine.plotting.labels import Label, Rectangle, place_labels
from simulations.engine.plotting.plot import Plot
from simulations.engine.plotting.scale import small_scale
from simulations.engine.plotting.ticks import log_ticks
from simulations.engine.scene import Scene
from simulations.engine.stages import Outputs
from simulations.models.sensor.photon_counting import SHOT_MODELS, Sensor, shot_noise_from_normal
from simulations.scenes.sensor_noise.sensor import (
    CLICKS,
    COLUMNS,
    PHOTOGRAPH_PX,
    ROWS,
    STAGES,
    Settings,
    Transfer,
    estimate,
    floor_e2,
    iso_of,
    patch_light_e,
    patch_means_e,
    saturation_e,
    sensor_of,
)

SIZE = WIDTH, HEIGHT = 396.0, 264.0
PATCH_WIDTH, PATCH_HEIGHT = WIDTH / COLUMNS, HEIGHT / ROWS
DECADES = 4.5  # of the mean axis, below twice the saturation level
LOWEST_DN2 = 0.01  # lower end of the variance axis; smaller variances are drawn at it
SOUND_HZ, SOUND_S = 8000, 4
CLICK = 0.7 * np.exp(-np.arange(24) / 5.0) * np.cos(0.5 * np.pi * np.arange(24))
HISSING = 200.0  # clicks a second from which they grow softer, as they run together


@dataclass(frozen=True, slots=True)
class Curve:
    """The theory of the plot."""

    gain_e_per_dn: float
    floor_dn2: float
    """Variance without light."""
    full_dn: float
    """Level at which the well or the converter is full."""
    dark_dn: float
    """Mean dark signal, which also fills the well but is subtracted from the means."""

    @property
    def plot(self) -> Plot:
        """The axes depend on gain and converter only, so that noise and exposure move the
        points."""
        high_x = 2 * self.full_dn
        high_y = 10.0 ** math.ceil(math.log10(max(5 * self.full_dn / self.gain_e_per_dn, 1.0)))
        return Plot(
            Axis(high_x / 10.0**DECADES, high_x, 56.0, 379.0, log=True),
            Axis(LOWEST_DN2, high_y, 217.0, 26.0, log=True),
        )


def camera_of(settings: Settings) -> Sensor:
    return sensor_of(settings.bits, iso_of(settings), settings.read_noise)


def curve_of(settings: Settings) -> Curve:
    """The theory of the plot, in codes."""
    camera = camera_of(settings)
    gain, floor = camera.gain_e_per_dn, floor_e2(camera, settings.dark)
    return Curve(gain, floor / gain**2, saturation_e(camera) / gain, settings.dark / gain)


def over_wedge(patch: int) -> str:
    """A frame around the chosen patch."""
    corner = (patch % COLUMNS * PATCH_WIDTH + 2, patch // COLUMNS * PATCH_HEIGHT + 2)
    size = PATCH_WIDTH - 4, PATCH_HEIGHT - 4
    return cased(rectangle, corner, *size, style="image bold")


def transfer_plot(
    curve: Curve, transfer: Transfer, patch: int, level_dn: float | None, unequal: bool
) -> str:
    """Measured patches over the theory's three parts.

    ``level_dn`` is the mean that the light of the chosen patch would have in an unlimited well. Of
    ``unequal`` cells, crosses show the variance that a single frame would give.
    """
    plot = curve.plot
    means, variances = (log_ticks(axis.low, axis.high, 3) for axis in (plot.x, plot.y))
    grids = ([value for value, _ in ticks] for ticks in (means, variances))
    across = small_scale("light: mean", "digital numbers (DN)", means, grid=next(grids))
    up = small_scale("noise: variance", "DN²", variances, grid=next(grids))
    parts = [plot.frame(across, up), *theory(plot, curve)]
    crosses: list[Point] = []
    if unequal:
        pairs = zip(transfer.mean_dn.tolist(), transfer.one_frame_dn2.tolist(), strict=True)
        crosses = [plot.clamped(mean, variance) for mean, variance in pairs]
        for x, y in crosses:
            parts.append(line((x - 3, y - 3), (x + 3, y + 3), "error"))
            parts.append(line((x - 3, y + 3), (x + 3, y - 3), "error"))
    measured = zip(transfer.mean_dn.tolist(), transfer.variance_dn.tolist(), strict=True)
    places = [plot.clamped(mean, variance) for mean, variance in measured]
    for place, fitted in zip(places, transfer.fitted, strict=True):
        parts.append(dot(place, "image", 3.5) if fitted else circle(place, 3.5, "image"))
    chosen = places[patch]
    if level_dn is not None:
        foot = plot.clamped(level_dn, plot.y.low)
        parts += [line(foot, chosen, "image thin"), dot(foot, "image", 5)]
    parts.append(cased(circle, chosen, 8, style="image bold"))
    return "".join((*parts, names(plot, curve, chosen, crosses)))


def theory(plot: Plot, curve: Curve) -> Iterator[str]:
    """Floor, shot noise, their sum up to saturation, and the level where all pixels are full."""
    gain, floor_dn2 = curve.gain_e_per_dn, curve.floor_dn2
    full = curve.full_dn - curve.dark_dn
    low, high = plot.x.low, plot.x.high
    means = np.geomspace(low, max(full, low), 60)
    start = max(low, LOWEST_DN2 * gain)  # where the straight line enters the plot
    yield line(plot.clamped(start, start / gain), plot.clamped(high, high / gain), "light dashed")
    yield line(plot.clamped(low, floor_dn2), plot.clamped(high, floor_dn2), "error dashed")
    yield plot.curve(means, np.maximum(means / gain + floor_dn2, LOWEST_DN2), "ray bold")
    if full > low:
        yield plot.upright(full, "muted dashed")


def names(plot: Plot, curve: Curve, chosen: Point, crosses: Sequence[Point]) -> str:
    """Labels of the parts of the theory, where they hide neither the lines nor the chosen patch's;
    and of the crosses of a single frame, next to the highest."""
    gain, floor = curve.gain_e_per_dn, curve.floor_dn2
    low, high = plot.x.low, plot.x.high
    full = max(curve.full_dn - curve.dark_dn, low)
    means = np.geomspace(low, high, 40)
    shot = np.maximum(means / gain, LOWEST_DN2)
    begin = max(low, LOWEST_DN2 * gain)
    middle, *lower = (
        plot.clamped(mean, mean / gain)
        for mean in (full * (begin / full) ** share for share in (0.5, 0.65, 0.8))
    )
    of_shot, style = "shot noise: mean / g", "light small ground"
    labels = [
        Label(
            plot.clamped(high, floor),
            "floor",
            "error small ground",
            prefer="below left",
            distance=6.0,
        ),
        Label(plot.clamped(low, floor), "floor + shot noise", "ray small ground", distance=8.0),
        Label(
            plot.clamped(full, plot.y.high),
            "full",
            "muted small ground",
            prefer="below left",
            distance=5.0,
        ),
        Label(middle, of_shot, style, prefer="below right", others=lower),
    ]
    if crosses:
        highest = min(crosses, key=lambda place: place[1])
        labels.append(
            Label(highest, "one frame", "error small ground", prefer="left", distance=8.0)
        )
    seen: list[Sequence[Point]] = [
        *plot.pieces(means, np.maximum(shot + floor, LOWEST_DN2)),
        *plot.pieces(means, shot),
        [plot.clamped(low, floor), plot.clamped(high, floor)],
        [plot.clamped(full, plot.y.low), plot.clamped(full, plot.y.high)],
        [chosen, (chosen[0], plot.y.start)],
    ]
    inside = Rectangle(plot.x.start + 2, plot.y.end, plot.x.end, plot.y.start - 2)
    return place_labels(labels, inside, seen)


def draw(settings: Settings, outputs: Outputs) -> Frame:
    """The room, the wedge, and the variance of each patch against its mean."""
    transfer: Transfer = outputs["transfer"]
    camera, patch = camera_of(settings), settings.patch - 1
    gain, true_gain = transfer.gain, camera.gain_e_per_dn
    has_photograph = outputs["photograph"] is not None
    mean_e = float(patch_light_e(outputs["light"])[patch])
    floor = floor_e2(camera, settings.dark)
    mean, sigma = float(transfer.mean_dn[patch]), math.sqrt(transfer.variance_dn[patch])
    ratio = measured_ratio(transfer, patch)
    theory = format_number(mean_e / math.sqrt(mean_e + floor), 1)
    span = math.log2(saturation_e(camera) / math.sqrt(floor))
    level = None if has_photograph else mean_e / true_gain
    unequal = bool(settings.unequal) and not has_photograph
    plot = transfer_plot(curve_of(settings), transfer, patch, level, unequal)
    title = "Your picture, in 24 patches" if has_photograph else "24 grey patches"
    signal = f"{mean_e / 1000:.3g}k" if mean_e >= 1000 else f"{mean_e:.3g}"
    share = f"noise {format_number(100 * sigma / mean, 0 if sigma > 0.1 * mean else 1)} %"
    if ratio in ("one code only", "clipped"):
        share = ratio
    elif mean < sigma / 3:
        share = "lost in noise"
    words = text((12, HEIGHT - 14), f"{signal} e⁻, {share}", "image strong ground")
    picture = (
        ("Your picture", outputs["picture"]) if has_photograph else ("The room", outputs["room"])
    )
    frame = over_wedge(patch) + words
    found = value_with_error(gain.e_per_dn, gain.error_e_per_dn) if gain else "not measurable"
    return Frame(
        (
            Panel("room", picture[0], *SIZE, picture[1], pixelated=True, lead=True),
            Panel("wedge", title, *SIZE, outputs["picture"], frame, pixelated=True),
            Panel("transfer", "Noise of every patch, against its light", *SIZE, overlay=plot),
        ),
        (
            readout("mean", "Mean of the patch", mean, "DN", digits=1, role="image"),
            readout("sigma", "Noise of the patch (σ)", sigma, "DN", digits=2, role="image"),
            Readout("snr", "Signal to noise (SNR)", ratio, role="image"),
            Readout(
                "theory",
                "SNR by theory",
                "clipped" if transfer.clipped[patch] else theory,
                role="ray",
            ),
            Readout("gain", "Measured gain", found, "e⁻/DN", role="image"),
            readout("truth", "True gain", true_gain, "e⁻/DN", digits=3, role="light"),
            readout("range", "Dynamic range", span, "stops", digits=1),
        ),
        describe(settings, outputs, ratio),
        sound=clicks(mean_e, settings.new_noise),
    )


def clicks(mean_e: float, take: int) -> Sound:
    """A click for each photon that one cell counts, if the exposure lasts a second."""
    rng = np.random.default_rng((take, CLICKS))
    counted = rng.poisson(mean_e / SOUND_HZ, SOUND_HZ * SOUND_S)
    wave = np.convolve(counted, CLICK / math.sqrt(1.0 + mean_e / HISSING))[: counted.size]
    return Sound(np.clip(wave, -1.0, 1.0).astype(np.float32), SOUND_HZ)


def measured_ratio(transfer: Transfer, patch: int) -> str:
    """Signal-to-noise ratio of a patch, or why there is none."""
    sigma = math.sqrt(transfer.variance_dn[patch])
    if sigma == 0:
        return "one code only"
    if transfer.clipped[patch]:  # part of the noise is cut off, and the ratio would be too good
        return "clipped"
    return format_number(transfer.mean_dn[patch] / sigma, 1)


def describe(settings: Settings, outputs: Outputs, ratio: str) -> str:
    """The picture in one sentence."""
    gain, camera = outputs["transfer"].gain, camera_of(settings)
    has_photograph = outputs["photograph"] is not None
    brightest_e = outputs["light"].reshape(24, -1).max(axis=1) + settings.dark
    full = int(np.count_nonzero(brightest_e > saturation_e(camera)))
    are = "hold cells that are" if has_photograph else "are"
    burnt = f"{full} of 24 patches {are} burnt out" if full else "no patch is burnt out"
    subject = (
        "Your own picture" if has_photograph else "A room, and 24 grey patches from light to dark,"
    )
    words = {"one code only": "shows one code only", "clipped": "is clipped"}
    visibility = words.get(ratio, f"has an SNR of {ratio}")
    floor_dn = math.sqrt(floor_e2(camera, settings.dark)) / camera.gain_e_per_dn
    if gain is None:
        fit = "too few patches with noise of their own are left to measure the conversion gain"
    elif floor_dn < 0.5:
        fit = "the dark patches vary by less than a code and fall into flat steps"
    else:
        off = abs(gain.e_per_dn / camera.gain_e_per_dn - 1)
        fit = f"the variances give the conversion gain to within {math.ceil(100 * off)} %"
    return (
        f"{subject} at ISO {iso_of(settings):.0f} and {settings.bits} bits: "
        f"{burnt}, patch {settings.patch} {visibility}, and {fit}."
    )


def level_at(settings: Settings, outputs: Outputs) -> Point | None:
    """Only for the wedge, as the light of a reader's patches is not ordered."""
    if outputs["photograph"]:
        return None
    plot, gain = curve_of(settings).plot, camera_of(settings).gain_e_per_dn
    return plot.clamped(
        float(patch_means_e(settings.exposure)[settings.patch - 1]) / gain, plot.y.low
    )


def level_pulled(settings: Settings, place: Point) -> dict[str, float]:
    """The exposure at which the chosen patch receives the light of this mean."""
    axis, gain = curve_of(settings).plot.x, camera_of(settings).gain_e_per_dn
    mean_dn = axis.value(min(max(place[0], axis.start), axis.end))
    at_0_ev = float(patch_means_e(0.0)[settings.patch - 1])
    return {"exposure": math.log2(mean_dn * gain / at_0_ev)}


def middle(_settings: Settings, _outputs: Outputs) -> Point:
    return WIDTH / 2, HEIGHT / 2


def patch_pulled(_settings: Settings, place: Point) -> dict[str, int]:
    column = min(max(math.floor(place[0] / PATCH_WIDTH), 0), COLUMNS - 1)
    row = min(max(math.floor(place[1] / PATCH_HEIGHT), 0), ROWS - 1)
    return {"patch": row * COLUMNS + column + 1}


SCENE = Scene(
    "sensor-noise",
    "Sensor Noise",
    Settings,
    draw,
    STAGES,
    (
        Handle(
            "level",
            "transfer",
            "Light",
            drives=("exposure",),
            at=level_at,
            pull=level_pulled,
            reach="press",
            role="image",
        ),
        Handle("patch", "wedge", "Patch to look at", ("patch",), middle, patch_pulled, reach="aim"),
    ),
    instrument=Instrument(photograph=PHOTOGRAPH_PX),
    accuracy=Accuracy(
        levels=tiers(*SHOT_MODELS), default="quantile", ladder="shot-noise", estimate=estimate
    ),
    parameters=lambda settings, _tier: {"iso": iso_of(settings)},
    formula=shot_noise_from_normal,
)
