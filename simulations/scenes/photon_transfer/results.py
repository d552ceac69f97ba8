"""What the photon transfer says: readouts, the lines of the data sheet, and files."""

import json
import math
from collections.abc import Iterable, Iterator, Mapping

import numpy as np

from simulations.engine.export import Export
from simulations.engine.frame import Readout, format_number, readout
from simulations.engine.stages import Outputs
from simulations.models.sensor.photon_transfer_fit import Estimate, SensorEstimate
from simulations.scenes.photon_transfer.settings import Settings
from simulations.scenes.photon_transfer.stages import GAIN_E_PER_DN, Frames, Measured

UNTOLD = "cannot be told"
QUANTITIES = (
    ("gain", "Conversion gain", "e⁻/DN", 1.0),
    ("read", "Read noise, measured", "e⁻", 1.0),
    ("saturation", "Saturation", "e⁻", 1.0),
    ("prnu", "PRNU", "%", 100.0),
    ("dsnu", "DSNU", "e⁻", 1.0),
)
"""Name, label, unit and units per unit of the model."""


def estimates_of(sensor: SensorEstimate) -> Mapping[str, Estimate]:
    """By the names of the readouts."""
    return {
        "gain": sensor.gain,
        "read": sensor.read_noise,
        "saturation": sensor.saturation,
        "prnu": sensor.prnu,
        "dsnu": sensor.dsnu,
    }


def readouts(_settings: Settings, outputs: Outputs) -> tuple[Readout, ...]:
    """The gain, its error and truth; the other numbers with their errors; and the pairs used."""
    frames: Frames = outputs["frames"]
    sensor: SensorEstimate = outputs["sensor"][frames.main]
    gain = sensor.gain
    error = format_number(gain.error, 3) if not gain.reason else UNTOLD
    found = estimates_of(sensor)
    used = int(np.count_nonzero(sensor.fitted))
    return (
        Readout("gain", "Conversion gain, measured", _value(gain, 3), _unit(gain, "e⁻/DN"), "ray"),
        Readout("gain_error", "Standard error of the gain", error, _unit(gain, "e⁻/DN"), "ray"),
        readout("gain_true", "Conversion gain, true", GAIN_E_PER_DN, "e⁻/DN", digits=3)
        if frames.is_simulated
        else Readout("gain_true", "Conversion gain, true", "unknown"),
        *(
            Readout(name, label, with_error(found[name], scale), _unit(found[name], unit), "image")
            for name, label, unit, scale in QUANTITIES[1:]
        ),
        Readout("used", "Pairs fitted", f"{used} of {len(sensor.fitted)}"),
    )


def _value(estimate: Estimate, digits: int) -> str:
    return UNTOLD if estimate.reason else format_number(estimate.value, digits)


def _unit(estimate: Estimate, unit: str) -> str:
    return unit if estimate.bound or not estimate.reason else ""


def with_error(estimate: Estimate, scale: float = 1.0) -> str:
    """The number with its standard error, to two digits of the latter; or what bounds it."""
    if estimate.bound:
        digits = max(1 - math.floor(math.log10(scale * max(estimate.value, 1e-9))), 0)
        return f"{estimate.bound} {format_number(scale * estimate.value, digits)}"
    if estimate.reason:
        return UNTOLD
    error = scale * estimate.error
    digits = 5 if error == 0 else min(max(1 - math.floor(math.log10(error)), 0), 5)
    return f"{format_number(scale * estimate.value, digits)} ± {format_number(error, digits)}"


def measured(outputs: Outputs) -> tuple[int, ...]:
    """Numbers of the photographs that have a partner."""
    frames: Frames = outputs["frames"]
    return tuple(number for pair in frames.numbers for number in pair)


def sheet(_settings: Settings, outputs: Outputs) -> tuple[Readout, ...]:
    """The lines of the data sheet: all numbers of the plane shown, and the gains of the others."""
    frames: Frames = outputs["frames"]
    if not frames.names:
        return ()
    main = frames.main
    sensor: SensorEstimate = outputs["sensor"][main]
    return (
        Readout("pixels", "Pixels", main),
        *_scale(frames),
        *_lines(sensor),
        *_other_gains(outputs["sensor"], main),
        *_grain(outputs["levels"][main]),
        Readout("pairs", "Pairs", str(len(frames.names))),
        Readout("left_over", "Pictures left out", _left_over(frames.left_over)),
    )


def _left_over(count: int) -> str:
    return f"{count}: without a partner, or of another camera or kind of file" if count else "0"


def _scale(frames: Frames) -> Iterator[Readout]:
    """What a raw file says."""
    if frames.black:
        black = format_number(frames.black[frames.main], 0)
        yield Readout("scale", "Black and white", f"{black} and {frames.highest}", "DN")


def _lines(sensor: SensorEstimate) -> Iterator[Readout]:
    said: set[str] = set()
    found = estimates_of(sensor)
    for name, label, unit, scale in QUANTITIES:
        estimate = found[name]
        words = with_error(estimate, scale)
        if estimate.reason and not estimate.bound and estimate.reason not in said:
            words = f"{UNTOLD}. {estimate.reason}"
            said.add(estimate.reason)
        yield Readout(name, label.partition(",")[0], words, _unit(estimate, unit))


def _other_gains(sensors: Mapping[str, SensorEstimate], main: str) -> Iterator[Readout]:
    for number, (plane, sensor) in enumerate(sensors.items()):
        if plane != main and not sensor.gain.reason:
            label = f"Conversion gain, {plane}"
            yield Readout(f"gain_{number}", label, with_error(sensor.gain), "e⁻/DN")


def _grain(measured: Measured) -> Iterable[Readout]:
    """Noise of one picture, which any file tells, at the pair nearest to mid-grey."""
    light = np.maximum(measured.mean_dn / measured.span_dn, 1e-6)
    level = measured.levels[int(np.argmin(np.abs(np.log(light / 0.18))))]
    share = 100 * float(light[measured.levels.index(level)])
    noise = math.sqrt(max(level.noise_dn2, 0.0)) / max(level.mean_dn - measured.black_dn, 1e-6)
    label = f"Noise of one picture at {share:.0f}\u00a0% of white"
    yield readout("noise", label, 100 * noise, "% of the light")
    yield readout("shared", "Noise shared by neighbours", 100 * level.correlation, "%", digits=1)


HEAD = (
    "plane,first,second,mean_dn,noise_dn2,noise_error_dn2,pattern_dn2,pattern_error_dn2,"
    "correlation,clipped_share,fitted"
)


def _levels_file(_settings: Settings, outputs: Outputs) -> str:
    frames: Frames = outputs["frames"]
    rows = [HEAD]
    for plane, measured in outputs["levels"].items():
        fitted = outputs["sensor"][plane].fitted.tolist()
        for level, names, use in zip(measured.levels, frames.names, fitted, strict=True):
            numbers = (
                level.mean_dn,
                level.noise_dn2,
                level.noise_error_dn2,
                level.pattern_dn2,
                level.pattern_error_dn2,
                level.correlation,
                level.clipped,
            )
            quoted = (f'"{name.replace('"', '""')}"' for name in (plane, *names))
            rows.append(",".join([*quoted, *(f"{n:.6g}" for n in numbers), str(int(use))]))
    return "\n".join((*rows, ""))


def _json_file(settings: Settings, outputs: Outputs) -> str:
    frames: Frames = outputs["frames"]
    found = {
        "pairs": [list(names) for names in frames.names],
        "left_over": frames.left_over,
        "fitted_up_to_share": settings.most / 100,
        "planes": {
            plane: {
                "black_dn": outputs["levels"][plane].black_dn,
                "pairs_fitted": int(np.count_nonzero(sensor.fitted)),
                **{name: _as_json(estimate) for name, estimate in estimates_of(sensor).items()},
            }
            for plane, sensor in outputs["sensor"].items()
        },
        "units": {"gain": "electrons per DN", "read": "electrons", "saturation": "electrons"}
        | {"prnu": "share of the light", "dsnu": "electrons"},
    }
    return json.dumps(found, ensure_ascii=False, indent=1, allow_nan=False)


def _as_json(estimate: Estimate) -> dict[str, float | str]:
    if estimate.bound:
        return {estimate.bound: estimate.value, "reason": estimate.reason}
    if estimate.reason:
        return {"cannot_be_told": estimate.reason}
    return {"value": estimate.value, "standard_error": estimate.error}


EXPORTS: tuple[Export[Settings], ...] = (
    Export("photon-transfer", "Levels, CSV", ".csv", _levels_file),
    Export("sensor", "Results, JSON", ".json", _json_file),
)
