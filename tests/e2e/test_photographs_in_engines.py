"""The reader's photographs and raw files in the engines that the other tests do not use."""

import io
from base64 import b64encode
from pathlib import Path

import pytest
from PIL import Image
from support.engines import ENGINES, HOW_TO
from support.engines.engine import Engine, wait_for
from support.noise_files import PHOTOGRAPHS, dng_files, sheet_of_photographs, sheet_of_raw
from support.static_server import StaticServer

from simulations.engine.photograph import Codes

pytestmark = [pytest.mark.browser, pytest.mark.deep]

BOX = "document.querySelector('figure:has([data-simulation=photon-transfer]) .intake')"
CHOOSE = f"""(files) => {{
  const box = {BOX};
  box.scrollIntoView({{behavior: 'instant'}});
  const chosen = new DataTransfer();
  for (const [name, base64] of Object.entries(files)) {{
    chosen.items.add(new File([Uint8Array.from(atob(base64), (c) => c.charCodeAt(0))], name));
  }}
  const input = box.querySelector('input[type=file]');
  input.files = chosen.files;
  input.dispatchEvent(new Event('change', {{bubbles: true}}));
}}"""
READS = """(lines) => {
  const rows = [...document.querySelectorAll('.data-sheet tbody tr:not(:first-child)')];
  return rows.length === lines.length && rows.every(({cells}, index) =>
    cells[0].textContent === lines[index][0] && cells[1].textContent.startsWith(lines[index][1]));
}"""
"""Whether these are the lines of the sheet, whose units follow the values."""


@pytest.mark.parametrize("name", ENGINES)
def test_photographs_and_raw_files_are_measured_as_in_this_python(
    name: str, site_server: StaticServer, tmp_path: Path
) -> None:
    opened = ENGINES[name](tmp_path)
    if opened is None:
        pytest.skip(f"{name}: {HOW_TO}")
    with opened as engine:
        engine.open(site_server.url + "measure-your-camera/")
        wait_for(engine, f"() => Boolean({BOX})")
        choose(engine, {f"{index}.png": png(codes) for index, codes in enumerate(PHOTOGRAPHS)})
        wait_for(engine, READS, sheet_of_photographs())
        engine.ask(f"() => {BOX}.querySelector('.intake-clear').click()")
        choose(engine, {f"{index}.dng": data for index, data in enumerate(dng_files())})
        wait_for(engine, READS, sheet_of_raw())
        assert not engine.complaints()


def choose(engine: Engine, files: dict[str, bytes]) -> None:
    """As by the picker of files, which no driver can open."""
    engine.ask(CHOOSE, {name: b64encode(data).decode() for name, data in files.items()})


def png(codes: Codes) -> bytes:
    file = io.BytesIO()
    Image.fromarray(codes).save(file, "PNG")
    return file.getvalue()
