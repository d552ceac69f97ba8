"""The numbers of the photon transfer: readouts, the lines of the data sheet, and files."""

import json
import math
from collections.abc import Iterator, Mapping

import numpy as np

from simulations.engine.export import Export
from simulations.engine.frame import Readout, format_number, readout, value_with_error
from simulations.engine.stages import Outputs
from simulations.models.sensor.photon_transfer_fit import Estimate, SensorEstimate
from simulations.models.sensor.photon_transfer_standard import standard_estimates
from simulations.scenes.photon_transfer.frames import (
    GAIN_E_PER_DN,
    Frames,
    Measured,
    Settings,
    tone_of,
)

UNKNOWN = "cannot be told"
QUANTITIES = (
    ("gain", "Conversion gain", "e⁻/DN", 1.0),
    ("read", "Read noise, measured", "e⁻", 1.0),
    ("saturation", "Saturation", "e⁻", 1.0),
    ("prnu", "PRNU", "%", 100.0),
    ("dsnu", "DSNU", "e⁻", 1.0),
    ("rows", "Row noise", "e⁻", 1.0),
    ("bend", "Response falls short at saturation by", "%", 100.0),
)
"""Name, label, unit and units per unit of the model."""
STANDARD = (
    ("full_well", "Full well (EMVA 1288)", "e⁻", 1.0),
    ("dynamic_range", "Dynamic range (EMVA 1288)", ": 1", 1.0),
    ("linearity_error", "Linearity error by exposure times (EMVA 1288)", "%", 100.0),
)
HEAD = (
    "plane,first,second,mean_dn,noise_dn2,noise_error_dn2,pattern_dn2,pattern_error_dn2,"
    "correlation,clipped_share,fitted"
)


def estimates_of(sensor: SensorEstimate) -> Mapping[str, Estimate]:
    """Estimates by the names of the readouts."""
    return {
        "gain": sensor.gain,
        "read": sensor.read_noise,
        "saturation": sensor.saturation,
        "prnu": sensor.prnu,
        "dsnu": sensor.dsnu,
        "rows": sensor.row_noise,
        "bend": sensor.bend,
    }


def standard_of(frames: Frames, outputs: Outputs, plane: str) -> Mapping[str, Estimate]:
    """The numbers of the standard."""
    levels: Measured = outputs["levels"][plane]
    found = standard_estimates(
        levels.levels, levels.black_dn, frames.exposures, outputs["sensor"][plane]
    )
    return {
        "full_well": found.full_well,
        "dynamic_range": found.dynamic_range,
        "linearity_error": found.linearity_error,
    }


def value_of(estimate: Estimate, scale: float = 1.0) -> str:
    """The number with its standard error, or what bounds it."""
    value = scale * estimate.value
    if estimate.bound:
        digits = max(1 - math.floor(math.log10(max(value, scale * 1e-9))), 0)
        return f"{estimate.bound} {format_number(value, digits)}"
    return UNKNOWN if estimate.reason else value_with_error(value, scale * estimate.error)


def unit_of(estimate: Estimate, unit: str) -> str:
    return unit if estimate.bound or not estimate.reason else ""


def readouts(outputs: Outputs) -> tuple[Readout, ...]:
    """The gain, its error and truth; the other numbers with their errors; and the pairs used."""
    frames: Frames = outputs["frames"]
    sensor: SensorEstimate = outputs["sensor"][frames.main]
    found, gain = estimates_of(sensor), sensor.gain
    value, error = (
        UNKNOWN if gain.reason else format_number(part, 3) for part in (gain.value, gain.error)
    )
    unit, true = unit_of(gain, "e⁻/DN"), "Conversion gain, true"
    used = f"{int(np.count_nonzero(sensor.fitted))} of {len(sensor.fitted)}"
    return (
        Readout("gain", "Conversion gain, measured", value, unit, role="ray"),
        Readout("gain_error", "Standard error of the gain", error, unit, role="ray"),
        readout("gain_true", true, GAIN_E_PER_DN, "e⁻/DN", digits=3)
        if frames.is_simulated
        else Readout("gain_true", true, "unknown"),
        *(
            Readout(
                name, label, value_of(found[name], scale), unit_of(found[name], unit), role="image"
            )
            for name, label, unit, scale in QUANTITIES[1:5]
        ),
        Readout("used", "Pairs fitted", used),
    )


def measured(outputs: Outputs) -> tuple[int, ...]:
    """Numbers of the photographs that have a partner."""
    frames: Frames = outputs["frames"]
    return tuple(number for pair in frames.numbers for number in pair)


def sheet(_settings: Settings, outputs: Outputs) -> tuple[Readout, ...]:
    """The lines of the data sheet: all numbers of the plane shown, and the gains of the others.

    The main one is the read noise, or where that cannot be told, the noise of one picture.
    """
    frames: Frames = outputs["frames"]
    if not frames.names:
        return ()
    main = "noise" if outputs["sensor"][frames.main].read_noise.reason else "read"
    first = (main, "gain", "pairs", "left_over" if frames.left_over else "taken")
    of = {line.name: line for line in lines(frames, outputs)}
    return tuple(of[name] for name in dict.fromkeys((*first, *of)) if name in of)


def lines(frames: Frames, outputs: Outputs) -> Iterator[Readout]:
    main, left = frames.main, frames.left_over
    given = set[str]()
    found = {**estimates_of(outputs["sensor"][main]), **standard_of(frames, outputs, main)}
    for name, label, unit, scale in (*QUANTITIES, *STANDARD):
        estimate = found[name]
        words = value_of(estimate, scale)
        if estimate.reason and not estimate.bound and estimate.reason not in given:
            words = f"{UNKNOWN}. {estimate.reason}"
            given.add(estimate.reason)
        yield Readout(name, label.partition(",")[0], words, unit_of(estimate, unit))
    if not (tone := tone_of(frames, outputs["levels"])).reason:
        steeper = value_with_error(100 * tone.value, 100 * tone.error)
        yield Readout("tone", "Middle tones steeper than in sRGB by", steeper, "%")
    yield Readout("pixels", "Pixels", main)
    if frames.camera:
        yield Readout("taken", "Taken with", frames.camera)
    if frames.black:  # of a raw file
        level: Measured = outputs["levels"][main]
        ends = f"{format_number(level.black_dn, 1)} and {frames.highest} DN"
        yield Readout("scale", "Black and white", f"{ends}. {level.note}" if level.note else ends)
    for number, (plane, sensor) in enumerate(outputs["sensor"].items()):
        if plane != main and not sensor.gain.reason:
            label = f"Conversion gain, {plane}"
            yield Readout(f"gain_{number}", label, value_of(sensor.gain), "e⁻/DN")
    yield from grain(outputs["levels"][main])
    yield Readout("pairs", "Pairs", str(len(frames.names)))
    lost = f"{left}: without a partner, or of another camera or kind of file" if left else "0"
    yield Readout("left_over", "Pictures left out", lost)


def grain(measured: Measured) -> Iterator[Readout]:
    """Noise of one picture, which any file shows, at the pair nearest to mid-grey."""
    light = np.maximum(measured.mean_dn / measured.span_dn, 1e-6)
    nearest = int(np.argmin(np.abs(np.log(light / 0.18))))
    level, share = measured.levels[nearest], 100 * float(light[nearest])
    noise = math.sqrt(max(level.noise_dn2, 0.0)) / max(level.mean_dn - measured.black_dn, 1e-6)
    label = f"Noise of one picture at {share:.0f}\u00a0% of white"
    yield readout("noise", label, 100 * noise, "% of the light")
    yield readout("shared", "Noise shared by neighbours", 100 * level.correlation, "%", digits=1)


def levels_file(_settings: Settings, outputs: Outputs) -> str:
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


def json_file(settings: Settings, outputs: Outputs) -> str:
    frames: Frames = outputs["frames"]
    found = {
        "pairs": [list(names) for names in frames.names],
        "left_over": frames.left_over,
        "model": frames.model,
        "tone_curve": as_json(tone_of(frames, outputs["levels"])),
        "fitted_up_to_share": settings.most / 100,
        "planes": {
            plane: {
                "black_dn": outputs["levels"][plane].black_dn,
                "pairs_fitted": int(np.count_nonzero(sensor.fitted)),
                **{
                    name: as_json(estimate)
                    for kind in (estimates_of(sensor), standard_of(frames, outputs, plane))
                    for name, estimate in kind.items()
                },
            }
            for plane, sensor in outputs["sensor"].items()
        },
        "units": {"gain": "electrons per DN", "read": "electrons", "saturation": "electrons"}
        | {"prnu": "share of the light", "dsnu": "electrons", "rows": "electrons"}
        | {
            "tone_curve": "share of sRGB's steepness in middle tones",
            "bend": "share of the light",
            "full_well": "electrons",
        }
        | {"dynamic_range": "ratio", "linearity_error": "share of the light"},
    }
    return json.dumps(found, ensure_ascii=False, indent=1, allow_nan=False)


def as_json(estimate: Estimate) -> dict[str, float | str]:
    if estimate.bound:
        return {estimate.bound: estimate.value, "reason": estimate.reason}
    if estimate.reason:
        return {"cannot_be_told": estimate.reason}
    return {"value": estimate.value, "standard_error": estimate.error}


EXPORTS: tuple[Export[Settings], ...] = (
    Export("photon-transfer", "Levels, CSV", ".csv", levels_file),
    Export("sensor", "Results, JSON", ".json", json_file),
)
