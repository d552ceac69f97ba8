"""Three pictures after twelve turns, by three interpolations, with the numbers that judge them."""

import numpy as np

from simulations.engine.drafting import label
from simulations.engine.illustration import Illustration, Panel
from simulations.illustrations.moved_or_dulled import HEIGHT, WIDTH, crops, sharp_pictures
from simulations.models.arrays import Floats
from simulations.models.error_measures import psnr_db
from simulations.models.sampling.fine_detail import fine_detail
from simulations.models.sampling.resampling import gather, gather_table
from simulations.pictures.round_windows import INSIDE, SIZE, TURN_RAD, TURNS, pictures_at, places

TITLES = {"nearest": "Nearest", "bilinear": "Bilinear", "spline": "B-spline"}


def turned(kernel: str) -> Floats:
    """(128, 128, 3) the pictures after twelve turns, each of the last result."""
    source = np.stack(places(TURN_RAD), axis=-1) + (SIZE - 1) / 2
    table, pictures = gather_table(source, (SIZE, SIZE), kernel), sharp_pictures()
    for _ in range(TURNS):
        pictures = gather(table, pictures, fill=0.5)
    return pictures


def quality(pictures: Floats, truth: Floats) -> tuple[float, float, float]:
    """PSNR in dB; fine detail present and in place, in %, as means over the pictures."""
    found = [fine_detail(pictures[..., n], truth[..., n]) for n in range(truth.shape[-1])]
    present, in_place = (
        100 * float(np.mean(each))
        for each in zip(*((one.present, one.in_place) for one in found), strict=True)
    )
    return psnr_db(pictures[INSIDE], truth[INSIDE]), present, in_place


def draw() -> Illustration:
    truth = pictures_at(*places(TURNS * TURN_RAD))
    size, foot = (WIDTH, 3 * HEIGHT + 50), 3 * HEIGHT + 23
    panels, results = [Panel("truth", "What belongs there", *size, overlay=crops(truth))], []
    for kernel, title in TITLES.items():
        psnr, present, in_place = quality(pictures := turned(kernel), truth)
        results.append(
            f"{title}: {psnr:.1f} dB, {present:.0f} % present, {in_place:.0f} % in place"
        )
        number = label((WIDTH / 2, foot), f"{psnr:.1f} dB", "image", "middle")
        others = f"{present:.0f} % present, {in_place:.0f} % in place"
        words = label((WIDTH / 2, foot + 20), others, "muted small", "middle")
        panels.append(Panel(kernel, title, *size, overlay=crops(pictures) + number + words))
    return Illustration(
        tuple(panels),
        "Pieces of three pictures after twelve turns. The nearest pixel tears edges, bilinear "
        f"blurs, the spline looks true. {'; '.join(results)}.",
    )
