"""Get the pinned runtime files: from the cache where they are intact, else from a source."""

from collections.abc import Mapping, Sequence
from pathlib import Path

from site_builder.runtime import store as stores
from site_builder.runtime.downloads import SOURCES, Source
from site_builder.runtime.pinned import RUNTIME_FILES, RuntimeFile


class RuntimeFetchError(RuntimeError):
    """No source gave the pinned bytes. The message names each attempt and the ways out."""


def fetch_runtime(
    store: Path | None = None,
    sources: Sequence[tuple[str, Source]] = SOURCES,
    files: Sequence[RuntimeFile] = RUNTIME_FILES,
) -> Mapping[str, Path]:
    """All runtime files by name, each verified against its SHA-256.

    Nothing is requested for files whose cached copy is intact; a damaged copy is fetched again.
    Sources are tried in order, the next one only for what is still missing.

    Raises
    ------
    RuntimeFetchError
        Where some file is neither cached nor to be had.
    """
    folder = store or stores.default_store()
    missing = [file for file in files if not stores.is_intact(folder, file)]
    problems: list[str] = []
    for label, source in sources:
        if not missing:
            break
        problems += _take(source, label, missing, folder)
        missing = [file for file in missing if not stores.is_intact(folder, file)]
    if missing:
        raise RuntimeFetchError(_explain(missing, problems, folder))
    return {file.name: stores.location(folder, file) for file in files}


def _take(source: Source, label: str, missing: Sequence[RuntimeFile], folder: Path) -> list[str]:
    """Store what ``source`` gives correctly; return what went wrong, one line each."""
    problems = []
    try:
        for file, content in source(missing):
            received = stores.sha256(content)
            if received == file.sha256:
                stores.put(folder, file.name, content)
            else:
                problems.append(
                    f"{label}: {file.name} has SHA-256 {received[:12]}… ({len(content)} bytes), "
                    f"expected {file.sha256[:12]}…"
                )
    except Exception as error:  # any library below may fail in its own way; the next source may not
        problems.append(f"{label}: {type(error).__name__}: {error}")
    return problems


def _explain(missing: Sequence[RuntimeFile], problems: Sequence[str], folder: Path) -> str:
    lines = [
        "cannot get the Python runtime for the browser; missing: "
        + ", ".join(file.name for file in missing),
        *(f"  tried {problem}" for problem in problems),
        "Connect to the internet once: the files are cached and never requested again.",
        "Or put each file where it is looked for:",
        *(f"  {stores.location(folder, file)}" for file in missing),
    ]
    return "\n".join(lines)
