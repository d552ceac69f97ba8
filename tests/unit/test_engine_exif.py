"""Facts that cameras write into files, against files written by Pillow."""

import io
from typing import Any

import pytest
from PIL import Image
from PIL.TiffImagePlugin import IFDRational

from simulations.engine.exif import exif_facts

WRITTEN = {
    "make": "Maker",
    "model": "Model 1",
    "lens": "50 mm F1.8",
    "exposure_s": 1 / 125,
    "f_number": 2.8,
    "iso": 400.0,
    "focal_mm": 50.0,
    "focal_35mm_mm": 75.0,
}


def file_of(kind: str, order: str = ">", focal: float = 50.0, maker: str = "Maker") -> bytes:
    exif: Any = Image.Exif()
    exif.endian = order
    exif.update({0x010F: maker, 0x0110: "Model 1"})
    exif.get_ifd(0x8769).update(
        {0x829A: IFDRational(1, 125), 0x829D: IFDRational(28, 10), 0x8827: 400,
         0x920A: IFDRational(focal), 0xA405: 75, 0xA434: "50 mm F1.8"}
    )  # fmt: skip
    buffer = io.BytesIO()
    Image.new("RGB", (32, 32), (90, 90, 90)).save(buffer, kind, exif=exif)
    return buffer.getvalue()


@pytest.mark.parametrize("kind", ["JPEG", "PNG"])
def test_the_facts_of_a_file_are_those_written_into_it(kind: str) -> None:
    for order in "<>":
        assert exif_facts(file_of(kind, order)) == pytest.approx(WRITTEN)


@pytest.mark.parametrize("kind", ["JPEG", "PNG"])
def test_a_file_that_ends_early_or_is_damaged_gives_fewer_facts_and_no_error(kind: str) -> None:
    whole = file_of(kind)
    for cut in range(len(whole)):
        assert exif_facts(whole[:cut]).items() <= exif_facts(whole).items()
    for at in range(0, min(len(whole), 400)):
        exif_facts(whole[:at] + b"\xff" + whole[at + 1 :])


@pytest.mark.parametrize("focal", [0.0, 1e-6, 4e9])
def test_a_number_that_no_camera_has_is_left_out_and_texts_are_short(focal: float) -> None:
    facts = exif_facts(file_of("JPEG", focal=focal, maker="<A>\x01\n" + "M" * 5000))
    assert facts.keys() == WRITTEN.keys() - {"focal_mm"}
    assert facts["make"] == "<A>" + 77 * "M"
