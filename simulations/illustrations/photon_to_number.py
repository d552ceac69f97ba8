"""The chain from photons to a code, and the noise of each step."""

import math

from simulations.engine.drafting import box, label
from simulations.engine.drawing import arrow
from simulations.engine.illustration import Illustration, Panel
from simulations.models.sensor.photon_counting import Sensor, expose, quantise

SENSOR = Sensor(full_well_e=20_000, read_noise_e=3.0, dark_current_e_per_s=0.5, gain_e_per_dn=4.88)
PHOTONS_PER_S, EXPOSURE_S = 2000.0, 1.0
LEFT, BOX_WIDTH, BOX_HEIGHT, GAP = 132.0, 136.0, 38.0, 42.0


def mean_electrons() -> float:
    return float(expose(PHOTONS_PER_S, EXPOSURE_S, SENSOR))


def stations() -> tuple[tuple[str, str, str, str], ...]:
    """The quantity after each step, its unit, and the noise of the step."""
    mean = mean_electrons()
    gain, black = SENSOR.gain_e_per_dn, SENSOR.black_level_dn
    code = int(quantise(mean / gain + black, SENSOR.bits))
    photons = PHOTONS_PER_S * EXPOSURE_S
    counted = f"× {SENSOR.quantum_efficiency:g}, + {SENSOR.dark_current_e_per_s:g} dark"
    read = f"read noise ± {SENSOR.read_noise_e:g} e^−"
    rounded = f"rounding ± {1 / math.sqrt(12):.2f} DN"
    return (
        (f"{photons:.0f} photons", "light", "", ""),
        (f"{mean:.0f} electrons", "world", counted, f"shot noise ± {math.sqrt(mean):.0f} e^−"),
        (f"{mean / gain:.1f} DN", "camera", f"÷ {gain:g} e^− per DN", read),
        (f"code {code}", "image", f"+ {black:g} DN, rounded", rounded),
    )


def draw() -> Illustration:
    marks = []
    for index, (name, role, unit_step, chance) in enumerate(stations()):
        y = 14 + index * (BOX_HEIGHT + GAP)
        marks.append(box((LEFT, y), BOX_WIDTH, BOX_HEIGHT, 4, f"{role} fill"))
        marks.append(label((LEFT + BOX_WIDTH / 2, y + 25), name, f"{role} strong", "middle"))
        if index:
            top, x = y - GAP, LEFT + BOX_WIDTH / 2
            marks.append(arrow((x, top), (x, y), "muted"))
            marks.append(label((x - 10, top + 26), unit_step, "muted small", "end"))
            marks.append(arrow((x + 44, top + 21), (x + 4, top + 21), "error", 7))
            marks.append(label((x + 50, top + 26), chance, "error small"))
    words = "From the top down: " + "; ".join(
        name if not chance else f"{unit_step}, {chance}: {name}"
        for name, _, unit_step, chance in stations()
    ).replace("^−", "⁻")
    return Illustration((Panel("chain", "", 400.0, 296.0, overlay="".join(marks)),), f"{words}.")
