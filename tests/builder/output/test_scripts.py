"""The scripts of a page, bundled: few files that do what the modules did."""

import re
from collections.abc import Mapping

import pytest

from site_builder.diagnostics.diagnostic import BuildError
from site_builder.output import scripts
from site_builder.output.scripts import Bundle, bundle_scripts
from site_builder.programs.node import NodeError

SOURCES: Mapping[str, bytes] = {
    "js/main.ts": b'import { shown } from "./page/shown.js";\n'
    b'import "./figure/feature.js";\nshown("page");\n',
    "js/page/shown.ts": b"export const shown = (what: string) => console.log(what);\n",
    "js/figure/feature.ts": b'import { start } from "../runtime/runtime.js";\n'
    b'start();\nexport const open = () => import("../editor/load.js");\n'
    b"document.body.onclick = open;\n",
    "js/runtime/runtime.ts": b'import { shown } from "../page/shown.js";\n'
    b'export const start = () => {\n  shown("runtime");\n'
    b'  return new Worker(new URL("./worker.js", import.meta.url));\n};\n',
    "js/runtime/worker.ts": b'import { reply } from "./reply.js";\nreply();\n',
    "js/runtime/reply.ts": b"export const reply = () => console.log('replied');\n",
    "js/editor/load.ts": b'import { shown } from "../page/shown.js";\nshown("editor");\n'
    b'export const sheet = new URL("../../css/editor.css", import.meta.url);\n'
    b"export const source = (scene: string) =>\n"
    b"  new URL(`../../python/${scene}.json`, import.meta.url);\n",
    "js/offline/service_worker.ts": b"self.stored = 1;\n",
    "js/page/unused.ts": b"console.log('unused');\n",
}
SERVICE_WORKER = "js/offline/service_worker.ts"


@pytest.fixture(scope="module")
def bundle() -> Bundle:
    return bundle_scripts(SOURCES, "js/main.ts", SERVICE_WORKER)


def chunk(bundle: Bundle, text: bytes) -> str:
    """The name of the only file that has ``text``."""
    (name,) = (name for name, script in bundle.files.items() if text in script)
    return name


def test_what_runs_at_once_is_in_the_entry_and_the_chunks_that_it_imports(bundle: Bundle) -> None:
    at_once = b"".join(bundle.files[name] for name in ("js/main.js", *bundle.at_once))
    assert b'"page"' in at_once
    assert b'"runtime"' in at_once
    assert b'"editor"' not in at_once
    imported = re.findall(rb'from"\./([\w-]+\.js)"', bundle.files["js/main.js"])
    assert [f"js/{name.decode()}" for name in imported] == list(bundle.at_once)


def test_what_is_imported_later_is_a_file_of_its_own(bundle: Bundle) -> None:
    later = chunk(bundle, b'"editor"').removeprefix("js/")
    assert f'import("./{later}")'.encode() in bundle.files["js/main.js"]


def test_a_worker_keeps_its_address_and_holds_what_it_imports(bundle: Bundle) -> None:
    assert b'new URL("./runtime/worker.js",import.meta.url)' in bundle.files["js/main.js"]
    assert b"import" not in bundle.files["js/runtime/worker.js"]
    assert b"replied" in bundle.files["js/runtime/worker.js"]


def test_addresses_beside_a_module_lead_where_they_led(bundle: Bundle) -> None:
    later = bundle.files[chunk(bundle, b'"editor"')]
    assert b'new URL("./../css/editor.css",import.meta.url)' in later
    assert b"new URL(`./../python/${" in later
    assert {"css/editor.css", "js/runtime/worker.js"} <= bundle.beside


@pytest.mark.parametrize(
    ("module", "message"),
    [
        (b"export const hidden = 1;\n", 'static/js/figure/.*"shown"|static/js/.*shown'),
        (b"export const = 1;\n", r"static/js/page/shown\.ts:1: Expected identifier"),
    ],
    ids=["a name that is not exported", "no TypeScript"],
)
def test_a_mistake_is_reported_with_file_and_line(module: bytes, message: str) -> None:
    with pytest.raises(BuildError, match=message):
        bundle_scripts({**SOURCES, "js/page/shown.ts": module}, "js/main.ts")


def test_without_esbuild_the_build_says_what_is_missing(monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(_folder: object) -> None:
        raise NodeError("no network")

    monkeypatch.setattr(scripts, "installed_packages", refuse)
    with pytest.raises(BuildError, match="cannot bundle the scripts of pages: no network"):
        bundle_scripts(SOURCES, "js/main.ts")
