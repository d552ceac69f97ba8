"""The reader's photographs: a scene's readings of them, and the results that follow."""

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
from simulations.engine.frame import Frame, Panel, readout
from simulations.engine.instrument import Instrument
from simulations.engine.photograph import Photograph, Whole
from simulations.engine.reading import Readings, UnfitError
from simulations.engine.scene import Scene
from simulations.engine.settings import slider, toggle
from simulations.engine.stages import Outputs, Stage

FIGURE = "figure-of-readings"
REQUEST = (FIGURE, "s", '{"gain": 2}', "")


@dataclass(frozen=True, slots=True)
class Settings:
    gain: float = slider("Gain", 1, 1, 4, 1)


@dataclass(frozen=True, slots=True)
class Clashing:
    readings: bool = toggle("Readings", default=False)


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


def as_text(_settings: Settings, outputs: Outputs) -> str:
    return f"mean {outputs['mean']:g}"


STAGES = (Stage("mean", mean_of_all),)
WHOLE: dict[str, Any] = {
    "photograph": Whole(),
    "read": mean_of,
    "samples": {"grey.png": lambda: np.array([[[7], [9]]], np.uint8)},
    "develop": lambda photograph, s, _outputs: (photograph.codes * s.gain).astype(np.uint8),
    "exports": (Export("mean", "Text", ".txt", as_text),),
    "sheet": lambda _settings, outputs: (readout("mean", "Mean", outputs["mean"], "codes"),),
}


def scene_of(settings: Any = Settings, stages: Any = (), **instrument: Any) -> Scene[Any]:
    return Scene("s", "S", settings, draw, stages, instrument=Instrument(**instrument))


@pytest.fixture(autouse=True)
def use(monkeypatch: pytest.MonkeyPatch) -> Iterator[Callable[..., None]]:
    """Let the worker load a scene with these parts; the complete one at first."""

    def chosen(**parts: Any) -> None:
        monkeypatch.setattr(browser, "load_scene", lambda _id: scene_of(**parts))

    chosen(stages=STAGES, **WHOLE)
    yield chosen
    browser.forget(FIGURE)


def picture(level: int, file: bytes = b"") -> SimpleNamespace:
    """Two pixels of one level, as JavaScript hands them over."""
    return SimpleNamespace(
        number=1, name="a.jpg", width=2, height=1, full_width=20, full_height=10,
        draw=lambda codes: codes.fill(level),
        head=SimpleNamespace(to_bytes=lambda: file),
    )  # fmt: skip


def test_reading_uses_the_facts_of_the_file() -> None:
    exif, file = Image.Exif(), io.BytesIO()
    exif[0x0110] = "Model"
    Image.new("RGB", (2, 1)).save(file, "JPEG", exif=exif)
    found = json.loads(browser.read("s", picture(40, file.getvalue())))
    assert found == {"data": {"mean": 40.0, "model": "Model", "width": 20}}
    unfit = json.loads(browser.read("s", picture(255)))
    assert unfit == {"unfit": "All white; photograph with less light."}


def test_raw_file_is_read_with_its_facts_and_cells(use: Callable[..., None]) -> None:
    seen: list[Photograph] = []

    def look(photograph: Photograph) -> dict[str, Any]:
        seen.append(photograph)
        return {}

    use(stages=STAGES, **WHOLE | {"read": look})
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


def test_sample_file_has_the_codes_of_the_scene() -> None:
    with Image.open(io.BytesIO(browser.sample("s", "grey.png"))) as file:
        np.testing.assert_array_equal(file.convert("RGB"), [[[7] * 3, [9] * 3]])


def test_readings_replace_the_books_pictures_in_all_results() -> None:
    for means, shown in (((), "100"), ((10, 30), "20"), ((), "100"), ((10, 30), "20")):
        kept = [{"number": at, "name": "", "data": {"mean": mean}} for at, mean in enumerate(means)]
        browser.readings(FIGURE, json.dumps(kept))
        frame = json.loads(browser.render(FIGURE, "s", "{}", "").meta)
        assert frame["readouts"][0]["text"] == shown
    assert browser.export(*REQUEST, "mean") == "mean 20"
    sheet = json.loads(browser.sheet(*REQUEST))
    assert (sheet["lines"][0]["text"], sheet["measured"]) == ("20.00", None)
    made = browser.develop(*REQUEST, picture(40))
    np.testing.assert_array_equal(made, [[[80, 80, 80, 255]] * 2])
    with pytest.raises(KeyError, match="export 'yaml'; legal: mean"):
        browser.export(*REQUEST, "yaml")


def test_scene_without_the_function_is_refused(use: Callable[..., None]) -> None:
    use(stages=STAGES)
    with pytest.raises(TypeError, match="reads no photographs"):
        browser.read("s", picture(40))
    with pytest.raises(TypeError, match="develops no photographs"):
        browser.develop(*REQUEST, picture(40))


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: scene_of(settings=Clashing), "setting 'readings' has the name of the reader's"),
        (lambda: scene_of(read=mean_of), "no stage reads what `read` finds"),
        (lambda: scene_of(develop=WHOLE["develop"]), "it develops no photograph"),
        (lambda: scene_of(exports=WHOLE["exports"] * 2), "legal: a name for each"),
        (lambda: Export("a b", "Text", ".txt", as_text), "legal"),
        (lambda: Export("a", "Text", "txt", as_text), "legal"),
        (lambda: Whole(0.0), "legal: above 0, at most 120"),
        (lambda: Whole(121.0), "legal: above 0, at most 120"),
    ],
)
def test_scene_of_photographs_that_contradicts_itself_is_refused(make: Any, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        make()
