"""The modules of a page, joined: the same files that it would have run one by one."""

from collections.abc import Mapping
from pathlib import Path

import pytest

from site_builder.editor.npm import NodeError
from site_builder.output import joined_scripts
from site_builder.output.assets import content_bytes
from site_builder.output.joined_scripts import join_scripts, workers_of
from site_builder.output.scripts import imported_scripts

MODULES = {
    "js/main.js": b'import { shown } from "./page/shown.js";\n'
    b'import "./figure/feature.js";\nshown();\n',
    "js/page/shown.js": b"export const shown = () => console.log('shown');\n",
    "js/figure/feature.js": b'import { start } from "../runtime/runtime.js";\n'
    b'start();\nexport const open = () => import("../editor/load.js");\n'
    b"document.body.onclick = open;\n",
    "js/runtime/runtime.js": b'import { shown } from "../page/shown.js";\n'
    b"export const start = () => {\n  shown();\n"
    b'  return new Worker(new URL("./worker.js", import.meta.url));\n};\n',
    "js/runtime/worker.js": b'import { told } from "./told.js";\ntold();\n',
    "js/runtime/told.js": b"export const told = () => console.log('told');\n",
    "js/editor/load.js": b'export const sheet = new URL("../../css/editor.css", import.meta.url);\n'
    b"export const source = (scene) =>\n"
    b"  new URL(`../../python/${scene}.json`, import.meta.url);\n",
    "js/offline/service_worker.js": b"self.kept = 1;\n",
    "css/editor.css": b"",
}


@pytest.fixture(scope="module")
def joined(tmp_path_factory: pytest.TempPathFactory) -> Mapping[str, bytes]:
    files = join_scripts(MODULES, "js/main.js", tmp_path_factory.mktemp("kept"))
    return {name: content_bytes(content) for name, content in files.items()}


def test_the_entry_holds_what_runs_at_once(joined: Mapping[str, bytes]) -> None:
    assert imported_scripts(joined, "js/main.js") == ()
    assert b"'shown'" in joined["js/main.js"].replace(b'"', b"'")
    assert not {"js/page/shown.js", "js/figure/feature.js", "js/runtime/runtime.js"} & {*joined}


def test_what_is_asked_for_later_stays_a_file_of_its_own(joined: Mapping[str, bytes]) -> None:
    (later,) = (name for name in joined if name.startswith("js/load-"))
    assert f'import("./{later.removeprefix("js/")}")'.encode() in joined["js/main.js"]


def test_a_worker_keeps_its_address_and_holds_what_it_imports(joined: Mapping[str, bytes]) -> None:
    assert workers_of(MODULES) == ["js/runtime/worker.js"]
    assert b'new URL("./runtime/worker.js",import.meta.url)' in joined["js/main.js"]
    assert b"import" not in joined["js/runtime/worker.js"]
    assert b"told" in joined["js/runtime/worker.js"]


def test_addresses_beside_a_module_lead_where_they_led(joined: Mapping[str, bytes]) -> None:
    (later,) = (text for name, text in joined.items() if name.startswith("js/load-"))
    assert b'new URL("./../css/editor.css",import.meta.url)' in later
    assert b"new URL(`./../python/${" in later


def test_what_no_page_imports_is_left_alone(joined: Mapping[str, bytes]) -> None:
    for name in ("js/offline/service_worker.js", "css/editor.css"):
        assert joined[name] == MODULES[name]


def test_what_was_joined_once_is_kept(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    first = join_scripts(MODULES, "js/main.js", tmp_path)
    monkeypatch.delattr(joined_scripts, "run_node")
    assert join_scripts(MODULES, "js/main.js", tmp_path) == first


def test_a_page_with_one_module_needs_nothing_that_joins(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delattr(joined_scripts, "run_node")
    alone = {"js/main.js": b"export {};\n"}
    assert join_scripts(alone, "js/main.js", tmp_path) == alone


def test_a_name_that_a_module_does_not_export_is_told(tmp_path: Path) -> None:
    modules = {**MODULES, "js/page/shown.js": b"export const hidden = 1;\n"}
    with pytest.raises(NodeError, match="shown"):
        join_scripts(modules, "js/main.js", tmp_path)
