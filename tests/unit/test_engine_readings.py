"""What a scene reads in the reader's photographs, as the worker asks for it."""

import io
import json
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from PIL import Image

from simulations import browser
from simulations.engine.export import Export
from simulations.engine.frame import Frame, Panel, Readout, readout
from simulations.engine.photograph import Codes, Photograph, Whole
from simulations.engine.reading import Readings, UnfitError
from simulations.engine.scene import Scene
from simulations.engine.settings import slider, toggle
from simulations.engine.stages import Outputs, Stage

FIGURE = "figure-of-readings"


@dataclass(frozen=True, slots=True)
class Settings:
    gain: float = slider("Gain", 1, 1, 4, 1)


def mean_of(photograph: Photograph) -> Mapping[str, Any]:
    mean, facts = float(photograph.codes.mean()), photograph.facts
    if mean > 250:
        raise UnfitError("All white; photograph with less light.")
    return {"mean": mean, "model": facts.get("model"), "width": facts["full_width"]}


def mean_of_all(readings: Readings) -> float:
    return float(np.mean([reading.data["mean"] for reading in readings])) if readings else 100.0


def draw(settings: Settings, outputs: Outputs) -> Frame:
    mean = readout("mean", "Mean", settings.gain * outputs["mean"], digits=0)
    return Frame((Panel("a", "A", 400, 300),), (mean,), "A mean.")


def sheet(_settings: Settings, outputs: Outputs) -> tuple[Readout, ...]:
    return (readout("mean", "Mean", outputs["mean"], "codes"),)


def brighten(photograph: Photograph, settings: Settings, _outputs: Outputs) -> Codes:
    return (photograph.codes * settings.gain).astype(np.uint8)


def as_text(_settings: Settings, outputs: Outputs) -> str:
    return f"mean {outputs['mean']:g}"


STAGES = (Stage("mean", mean_of_all),)
WHOLE: dict[str, Any] = {
    "stages": STAGES,
    "photograph": Whole(),
    "read": mean_of,
    "develop": brighten,
    "exports": (Export("mean", "Text", ".txt", as_text),),
    "sheet": sheet,
}


def scene_of(**changed: Any) -> Scene[Any]:
    return Scene("s", "S", **{"settings": Settings, "draw": draw, **changed})


@pytest.fixture(autouse=True)
def _figure(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    scene = scene_of(**WHOLE)
    monkeypatch.setattr(browser, "load_scene", lambda _id: scene)
    yield
    browser.forget(FIGURE)


def picture(level: int, file: bytes = b"") -> SimpleNamespace:
    """Two pixels of one level, as JavaScript hands them over."""
    return SimpleNamespace(
        number=1, name="a.jpg", width=2, height=1, full_width=20, full_height=10,
        draw=lambda codes: codes.fill(level),
        head=SimpleNamespace(to_bytes=lambda: file),
    )  # fmt: skip


def read(level: int, file: bytes = b"") -> dict[str, Any]:
    found: dict[str, Any] = json.loads(browser.read("s", picture(level, file)))
    return found


def keep(*means: float) -> None:
    kept = [{"number": at, "name": "", "data": {"mean": mean}} for at, mean in enumerate(means)]
    browser.readings(FIGURE, json.dumps(kept))


def shown() -> str:
    frame = json.loads(browser.render(FIGURE, "s", "{}", "").meta)
    return str(frame["readouts"][0]["text"])


def test_a_photograph_is_read_with_the_facts_of_its_file() -> None:
    exif, file = Image.Exif(), io.BytesIO()
    exif[0x0110] = "Model"
    Image.new("RGB", (2, 1)).save(file, "JPEG", exif=exif)
    assert read(40, file.getvalue()) == {"data": {"mean": 40.0, "model": "Model", "width": 20}}


def test_a_raw_file_brings_its_facts_and_its_cells(monkeypatch: pytest.MonkeyPatch) -> None:
    seen: list[Photograph] = []

    def look(photograph: Photograph) -> dict[str, Any]:
        seen.append(photograph)
        return {}

    scene = scene_of(**WHOLE | {"read": look})
    monkeypatch.setattr(browser, "load_scene", lambda _id: scene)
    raw = picture(40)
    raw.facts = '{"iso": 400}'
    raw.mosaic = SimpleNamespace(
        codes=SimpleNamespace(to_bytes=lambda: bytes(range(8))), width=2, height=2,
        about='{"colours": "RGGB", "black": [1, 2, 3, 4], "white": 9000}',
    )  # fmt: skip
    browser.read("s", raw)
    (photograph,) = seen
    assert photograph.facts == {"iso": 400, "full_width": 20, "full_height": 10}
    assert photograph.mosaic is not None
    assert photograph.mosaic.codes.tolist() == [[0x0100, 0x0302], [0x0504, 0x0706]]
    assert photograph.mosaic.black == (1, 2, 3, 4)


def test_a_photograph_that_cannot_be_used_is_refused_in_a_sentence() -> None:
    assert read(255) == {"unfit": "All white; photograph with less light."}


def test_what_was_read_takes_the_place_of_the_book_s_pictures_until_it_is_taken_away() -> None:
    assert shown() == "100"
    keep(10, 30)
    assert shown() == "20"
    keep()
    assert shown() == "100"


def test_files_sheet_and_development_follow_from_what_was_read() -> None:
    keep(10, 30)
    request = (FIGURE, "s", '{"gain": 2}', "")
    assert browser.export(*request, "mean") == "mean 20"
    told = json.loads(browser.sheet(*request))
    assert (told["lines"][0]["text"], told["measured"]) == ("20.00", None)
    made = browser.develop(*request, picture(40))
    np.testing.assert_array_equal(made, [[[80, 80, 80, 255]] * 2])


def test_an_export_that_the_scene_lacks_is_named_with_the_legal_ones() -> None:
    with pytest.raises(KeyError, match="export 'yaml'; legal: mean"):
        browser.export(FIGURE, "s", "{}", "", "yaml")


@pytest.mark.parametrize(
    ("ask", "message"),
    [
        (lambda: read(40), "reads no photographs"),
        (
            lambda: browser.develop(FIGURE, "s", "{}", "", picture(40)),
            "develops no photographs",
        ),
    ],
)
def test_a_scene_without_the_function_says_so(
    monkeypatch: pytest.MonkeyPatch, ask: Callable[[], object], message: str
) -> None:
    monkeypatch.setattr(browser, "load_scene", lambda _id: scene_of(stages=STAGES))
    with pytest.raises(TypeError, match=message):
        ask()


@dataclass(frozen=True, slots=True)
class Clashing:
    readings: bool = toggle("Readings", default=False)


@pytest.mark.parametrize(
    ("changed", "message"),
    [
        ({"settings": Clashing}, "setting 'readings' has the name of the reader's"),
        ({"read": mean_of, "stages": ()}, "no stage reads what `read` finds"),
        ({"develop": brighten}, "it develops no photograph"),
        ({"exports": WHOLE["exports"] * 2}, "legal: a name for each"),
    ],
)
def test_a_scene_that_contradicts_itself_is_refused(changed: dict[str, Any], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        scene_of(**changed)


@pytest.mark.parametrize(("name", "suffix"), [("a b", ".txt"), ("a", "txt")])
def test_a_file_has_a_plain_name_and_a_suffix(name: str, suffix: str) -> None:
    with pytest.raises(ValueError, match="legal"):
        Export(name, "Text", suffix, as_text)


@pytest.mark.parametrize("most", [0.0, 25.0])
def test_whole_photographs_fit_into_the_memory(most: float) -> None:
    with pytest.raises(ValueError, match="legal: above 0, at most 24"):
        Whole(most)
