"""What cameras write into files, against files written by Pillow."""

import io

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


def file_of(kind: str, order: bytes = b"MM", focal: float = 50.0, maker: str = "Maker") -> bytes:
    exif = Image.Exif()
    exif.endian = ">" if order == b"MM" else "<"
    exif[0x010F], exif[0x0110] = maker, "Model 1"
    exposure = exif.get_ifd(0x8769)
    exposure[0x829A], exposure[0x829D] = IFDRational(1, 125), IFDRational(28, 10)
    exposure[0x8827], exposure[0x920A], exposure[0xA405] = 400, IFDRational(focal), 75
    exposure[0xA434] = "50 mm F1.8"
    buffer = io.BytesIO()
    Image.new("RGB", (32, 32), (90, 90, 90)).save(buffer, kind, exif=exif)
    return buffer.getvalue()


@pytest.mark.parametrize("kind", ["JPEG", "PNG"])
@pytest.mark.parametrize("order", [b"MM", b"II"])
def test_the_facts_of_a_file_are_those_written_into_it(kind: str, order: bytes) -> None:
    assert exif_facts(file_of(kind, order)) == pytest.approx(WRITTEN)


def test_a_file_without_facts_has_none() -> None:
    buffer = io.BytesIO()
    Image.new("RGB", (8, 8)).save(buffer, "JPEG")
    assert exif_facts(buffer.getvalue()) == {}


@pytest.mark.parametrize("kind", ["JPEG", "PNG"])
def test_a_file_that_ends_early_or_is_damaged_gives_fewer_facts_and_no_error(kind: str) -> None:
    whole = file_of(kind)
    for cut in range(len(whole)):
        assert exif_facts(whole[:cut]).items() <= exif_facts(whole).items()
    for at in range(0, min(len(whole), 400)):
        exif_facts(whole[:at] + b"\xff" + whole[at + 1 :])


@pytest.mark.parametrize("focal", [0.0, 1e-6, 4e9])
def test_a_number_that_no_camera_has_is_left_out(focal: float) -> None:
    facts = exif_facts(file_of("JPEG", focal=focal))
    assert facts.keys() == WRITTEN.keys() - {"focal_mm"}


def test_texts_are_short_and_printable() -> None:
    maker = exif_facts(file_of("JPEG", maker="<A>\x01\n" + "M" * 5000))["make"]
    assert maker == "<A>" + 77 * "M"
