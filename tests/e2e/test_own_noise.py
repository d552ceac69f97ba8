"""Pairs of even photographs, and raw files, go in by the file picker; the sheet is that of this
Python."""

import json
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from playwright.sync_api import Page, expect
from support.dng import dng
from support.edges import gaussian_edge, gaussian_half
from support.noise_files import (
    BLACK,
    PHOTOGRAPHS,
    RAW,
    dng_files,
    sheet_of_photographs,
    sheet_of_raw,
)
from support.reader import Reader

pytestmark = pytest.mark.browser


@pytest.fixture
def files(tmp_path: Path) -> list[Path]:
    """Four pairs, and a photograph with an edge."""
    edge = PHOTOGRAPHS[2].copy()
    edge[:, 90:] //= 2
    paths = [tmp_path / f"{index}.png" for index in range(len(PHOTOGRAPHS) + 1)]
    for path, codes in zip(paths, [*PHOTOGRAPHS, edge], strict=True):
        Image.fromarray(codes).save(path)
    return paths


@pytest.fixture
def raw_files(tmp_path: Path) -> list[Path]:
    """Four pairs, and a file that was cut off."""
    files = dng_files()
    paths = [tmp_path / f"{index}.dng" for index in range(len(files) + 1)]
    for path, data in zip(paths, [*files, files[0][:5000]], strict=True):
        path.write_bytes(data)
    return paths


def saved_lines(page: Page) -> list[list[str]]:
    with page.expect_download() as saved:
        page.locator(".data-sheet").get_by_role("button", name="Save as JSON").click()
    (part,) = json.loads(saved.value.path().read_text(encoding="utf-8"))["instruments"]
    return [[line["label"], line["text"]] for line in part["lines"]]


def test_the_reader_s_pairs_and_raw_files_are_measured_as_in_this_python(
    reader: Reader, files: list[Path], raw_files: list[Path]
) -> None:
    asked = reader.note_requests(".wasm")
    reader.open("measure-your-camera/")
    page = reader.page
    figure = page.locator("simulation-figure[data-simulation=photon-transfer]")
    box = page.locator("figure", has=figure).locator(".intake")
    reader.bring(box)
    reader.settle(figure)
    box.locator("input[type=file]").set_input_files(files)
    expect(box.locator(".intake-said")).to_contain_text(f"{len(PHOTOGRAPHS)} of {len(files)}")
    expect(box.locator(".intake-photo").last).to_contain_text("not evenly lit")
    expect(figure.locator("output[name=gain_true]")).to_contain_text("unknown")
    expect(page.locator(".data-sheet tbody")).to_contain_text("Conversion gain")
    assert saved_lines(page) == sheet_of_photographs()
    assert not any("libraw" in url for url in asked)

    box.get_by_role("button", name="Remove all").click()
    box.locator("input[type=file]").set_input_files(raw_files)
    expect(box.locator(".intake-said")).to_contain_text(
        f"{len(RAW)} of {len(raw_files)} photographs are ready"
    )
    expect(box.locator(".intake-photo").last).to_contain_text("damaged or cut off")
    expect(page.locator(".data-sheet tbody")).to_contain_text("green, row 0")
    reader.settle(figure)
    assert any("libraw" in url for url in asked)
    assert saved_lines(page) == sheet_of_raw()
    measures_the_edge_of_a_raw_file(reader, raw_files[0].with_name("edge.dng"))


def measures_the_edge_of_a_raw_file(reader: Reader, path: Path) -> None:
    """The other instruments get the developed picture, which clips no white."""
    light = 0.05 + 0.85 * gaussian_edge(360, 480, 5.0, 1.0)
    grain = np.random.default_rng(2).normal(0.0, 3.0, light.shape)
    path.write_bytes(dng(np.rint(64 + 4031 * light + grain).astype(np.uint16), black=BLACK[:1]))
    figure = reader.page.locator("simulation-figure[data-simulation=slanted-edge]")
    box = reader.page.locator("figure", has=figure).locator(".intake")
    reader.bring(box)
    box.locator("input[type=file]").set_input_files(path)
    expect(box.locator(".intake-said")).to_contain_text("1 of 1 photograph is ready")
    reader.settle(figure)
    measured = figure.locator("output[name=per_px]").inner_text().split()[0]
    assert float(measured) == pytest.approx(gaussian_half(1.0), rel=0.01)
