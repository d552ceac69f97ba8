"""What may be meant, and had better not be: printed with its place, and nothing fails.

The Markdown files in ``fixtures/warnings`` are whole chapters; beside each lies what must be
warned of. A mismatch leaves ``NAME-changed.txt`` there to compare, and to rename if it is right.
"""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest

from site_builder.build import Options, check_site
from site_builder.diagnostics import BuildError, Diagnostic

FIXTURES = Path(__file__).parents[2] / "fixtures" / "warnings"
FRONT_MATTER = "---\ntitle: T\nsummary: s\n---\n"
type Find = Callable[..., list[str]]


@pytest.fixture
def warnings_of(make_book: Callable[..., Options]) -> Find:
    """The warnings of a book, as printed."""

    def find(body: str = "Text.\n", files: dict[str, str | None] | None = None) -> list[str]:
        found: list[Diagnostic] = []
        check_site(replace(make_book(body, files), warn=found.append))
        return [str(warning) for warning in found]

    return find


@pytest.mark.parametrize("file", sorted(FIXTURES.glob("*.md")), ids=lambda file: file.stem)
def test_warnings_of_a_chapter_are_as_recorded(file: Path, warnings_of: Find) -> None:
    found = warnings_of(files={"content/00-first.md": file.read_text(encoding="utf-8")})
    expected = file.with_suffix(".txt")
    changed = file.with_name(f"{file.stem}-changed.txt")
    report = "".join(f"{line}\n" for line in found)
    if not expected.is_file() or report != expected.read_text(encoding="utf-8"):
        changed.write_text(report, encoding="utf-8")
        pytest.fail(f"see {changed.name}:\n{report}")
    changed.unlink(missing_ok=True)


def test_warnings_are_told_even_where_mistakes_fail_the_check(
    make_book: Callable[..., Options],
) -> None:
    text = (FIXTURES / "lengths.md").read_text(encoding="utf-8")
    found: list[Diagnostic] = []
    options = make_book(files={"content/00-first.md": f"{text}\n[x](#nowhere)\n"})
    with pytest.raises(BuildError) as raised:
        check_site(replace(options, warn=found.append))
    assert len(raised.value.diagnostics) == 1
    assert raised.value.diagnostics[0].fails
    assert found
    assert not any(warning.fails for warning in found)


GLOSSARY = '[pose]\nsays = "Where it is."\nexplained = "first#poses"\n'


@pytest.mark.parametrize(
    ("text", "warned"),
    [
        ("A pose.\n\n## Poses\n\nThe **pose**.\n", True),
        ("## Poses\n\nThe **pose**.\n\n## Later\n\nA pose.\n", False),
        ("A {term}`pose`.\n\n## Poses\n\nThe **pose**.\n", False),
    ],
)
def test_a_term_used_before_its_explanation_is_warned_of_unless_it_is_marked(
    text: str, warned: bool, warnings_of: Find
) -> None:
    found = warnings_of(text, {"content/glossary.toml": GLOSSARY})
    assert [line for line in found if "'pose' is used before" in line] == found
    assert bool(found) == warned
