"""The instruments of a page in the browser, and files for them."""

import io
import json
import struct
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from PIL import Image
from PIL.PngImagePlugin import PngInfo
from playwright.sync_api import Locator, expect
from support.reader import Reader

from simulations.engine.photograph import Codes

PAGE = "measure-your-camera/"


def png(codes: Codes) -> bytes:
    """A PNG file whose gamma chunk, claiming linear codes, must be ignored."""
    file, info = io.BytesIO(), PngInfo()
    info.add(b"gAMA", struct.pack(">I", 100_000))
    Image.fromarray(codes).save(file, "PNG", pnginfo=info)
    return file.getvalue()


def write_files(folder: Path, contents: dict[str, bytes]) -> list[Path]:
    for name, content in contents.items():
        (folder / name).write_bytes(content)
    return [folder / name for name in contents]


class Instrument:
    """One instrument of the page."""

    def __init__(self, reader: Reader, scene: str) -> None:
        self.reader = reader
        self.figure = reader.page.locator(
            f"simulation-figure[data-simulation={scene}]:not([data-with])"
        )
        self.whole = reader.page.locator("figure", has=self.figure)
        self.box = self.whole.locator(".intake")
        self.status = self.box.locator(".intake-status")
        self.photographs = self.box.locator(".intake-photo")
        reader.scroll_to(self.box)
        reader.settle(self.figure)

    def give(self, files: Sequence[Path]) -> None:
        self.box.locator("input[type=file]").set_input_files(files)

    def add(self, files: Sequence[Path]) -> None:
        with self.reader.next_frame(self.figure):
            self.give(files)
        expect(self.status).to_contain_text("ready")

    def click(self, button: Locator) -> None:
        """Click, and wait for the frame that this makes."""
        with self.reader.next_frame(self.figure):
            button.click()

    def clear(self) -> None:
        self.box.locator(".intake-clear").click()

    def states(self) -> list[str]:
        return [one.get_attribute("data-state") or "" for one in self.photographs.all()]

    def readout(self, name: str) -> Locator:
        return self.figure.locator(f"output[name={name}]")

    def sheet(self) -> Any:
        """The data sheet's part for the only instrument in use, saved as JSON."""
        page = self.reader.page
        with page.expect_download() as download:
            page.locator(".data-sheet").get_by_role("button", name="Save as JSON").click()
        text = download.value.path().read_text(encoding="utf-8")
        (part,) = json.loads(text)["instruments"]
        return {**part, "lines": [[line["label"], line["text"]] for line in part["lines"]]}
