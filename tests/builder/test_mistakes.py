"""Every mistake an author can make is named, with its place and with what would be legal.

The Markdown files in ``fixtures/mistakes`` are whole chapters; beside each lies what must be
reported. A mismatch leaves ``NAME-changed.txt`` there to compare, and to rename if it is right.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import pytest

from simulations.engine.frame import Frame
from simulations.engine.scene import Scene
from simulations.engine.settings import slider
from site_builder.build import Options, check_site
from site_builder.diagnostics import BuildError, unknown

FIXTURES = Path(__file__).parents[1] / "fixtures" / "mistakes"
OUTLINE = (
    'title = "T"\nsubtitle = "S"\nprerequisites = "P"\nhero = "demo"\n'
    'hero_caption = "The *demo*."\nchapters = [\n  "00-first",\n  "01-second",\n]\n'
)
OUTLINE_WITHOUT_COVER = OUTLINE.replace('hero = "demo"\n', "")
type Find = Callable[..., list[str]]


@pytest.mark.parametrize("file", sorted(FIXTURES.glob("*.md")), ids=lambda file: file.stem)
def test_mistakes_of_a_chapter_are_reported_as_recorded(file: Path, mistakes: Find) -> None:
    found = mistakes(files={"content/00-first.md": file.read_text(encoding="utf-8")})
    expected = file.with_suffix(".txt")
    changed = file.with_name(f"{file.stem}-changed.txt")
    report = "\n".join(found) + "\n"
    if not expected.is_file() or report != expected.read_text(encoding="utf-8"):
        changed.write_text(report, encoding="utf-8")
        pytest.fail(f"see {changed.name}:\n{report}")
    changed.unlink(missing_ok=True)


def test_a_book_in_order_has_no_mistakes(mistakes: Find) -> None:
    assert mistakes() == []


def test_all_mistakes_of_all_files_are_reported_at_once(mistakes: Find) -> None:
    found = mistakes(
        ":::{nope}\n:::\n",
        {"content/01-second.md": "---\ntitle: S\nsummary: s\n---\n\n[x](#nowhere)\n"},
    )
    assert [line.split(":")[0] for line in found] == ["content/00-first.md", "content/01-second.md"]


def test_a_chapter_in_the_outline_without_a_file_is_reported_at_its_line(mistakes: Find) -> None:
    for chapters, line in (("[\n'00-frist',\n]", 5), ('["00-frist"]', 4)):
        outline = f'title = "T"\nsubtitle = "S"\nprerequisites = "P"\nchapters = {chapters}\n'
        found = mistakes(files={"content/book.toml": outline})
        assert (
            f"content/book.toml:{line}: unknown chapter '00-frist'; did you mean '00-first'?"
            in found
        )


def test_a_chapter_file_outside_the_outline_is_reported(mistakes: Find) -> None:
    found = mistakes(files={"content/02-third.md": "x"})
    assert found == [
        "content/02-third.md:1: not in content/book.toml; "
        "legal: listed in 'chapters' or 'appendices'"
    ]


def test_a_file_name_that_makes_no_address_is_reported(mistakes: Find) -> None:
    outline = OUTLINE.replace('"01-second"', '"01-Second one"')
    text = "---\ntitle: S\nsummary: s\n---\nText.\n"
    files = {
        "content/book.toml": outline,
        "content/01-Second one.md": text,
        "content/01-second.md": None,
    }
    found = mistakes(files=files)
    assert found == ["content/book.toml:8: chapter '01-Second one'; legal: 'NN-slug'"]


def test_a_chapter_listed_twice_is_reported(mistakes: Find) -> None:
    outline = OUTLINE.replace("]\n", ']\nappendices = ["00-first"]\n')
    (found,) = mistakes(files={"content/book.toml": outline})
    assert "chapter '00-first' has the address first/, as chapter '00-first' has" in found


@pytest.mark.parametrize(
    ("name", "holder"),
    [
        ("01-first", "chapter '00-first'"),
        ("01-licences", "a folder of the site's own"),
    ],
)
def test_two_pages_at_one_address_are_reported(mistakes: Find, name: str, holder: str) -> None:
    chapter = "---\ntitle: S\nsummary: s\n---\n\nText.\n"
    outline = OUTLINE.replace("01-second", name)
    found = mistakes(
        files={
            "content/book.toml": outline,
            "content/01-second.md": None,
            f"content/{name}.md": chapter,
        }
    )
    slug = name.removeprefix("01-")
    assert found == [
        f"content/book.toml:8: chapter {name!r} has the address {slug}/, as {holder} has; "
        "legal: one of its own"
    ]


def test_a_file_in_another_encoding_is_reported_at_its_line(
    mistakes: Find, tmp_path: Path, make_book: Callable[..., Options]
) -> None:
    make_book()
    text = "---\ntitle: T\nsummary: s\n---\n\nA café.\n"
    (tmp_path / "content/00-first.md").write_bytes(text.encode("latin-1"))
    found = mistakes(files={"content/00-first.md": None})
    assert found == ["content/00-first.md:6: byte 0xe9 is not UTF-8; legal: UTF-8"]


def test_the_mark_that_some_editors_put_before_a_text_is_no_mistake(mistakes: Find) -> None:
    text = "\ufeff---\r\ntitle: T\r\nsummary: s\r\n---\r\n\r\nText.\r\n"
    assert mistakes(files={"content/00-first.md": text}) == []


def test_an_unknown_cover_is_reported_at_its_own_line(mistakes: Find) -> None:
    caption, cover = 'hero_caption = "The *demo*."\n', 'hero = "demmo"\n'
    outline = OUTLINE.replace('hero = "demo"\n' + caption, caption + cover)
    assert mistakes(files={"content/book.toml": outline}) == [
        "content/book.toml:5: unknown simulation 'demmo'; legal: demo"
    ]


def test_a_link_that_would_lead_out_of_the_cover_is_reported(mistakes: Find) -> None:
    outline = OUTLINE.replace("The *demo*.", "As in [here](00-first.md).")
    found = mistakes(files={"content/book.toml": outline})
    assert found == [
        "content/book.toml:4: link '00-first.md' in the cover's caption; legal: 'https://…'"
    ]


def test_a_picture_of_a_kind_that_is_not_published_is_reported(mistakes: Find) -> None:
    body = ":::{figure} images/plan.PNG\n:alt: A plan\n:::\n"
    found = mistakes(body, {"content/images/plan.PNG": "x"})
    assert found == [
        "content/00-first.md:5: picture file 'images/plan.PNG'; "
        "legal: a name that ends in .svg, .png, .jpg, .jpeg, .webp"
    ]


def test_of_many_legal_names_the_first_are_listed_and_the_rest_counted() -> None:
    names = [f"n{number}" for number in range(30)]
    assert unknown("name", "zzz", names) == (
        f"unknown name 'zzz'; legal: {', '.join(names[:20])} and 10 more"
    )


def test_malformed_toml_is_reported_at_its_line(mistakes: Find) -> None:
    found = mistakes(files={"content/book.toml": 'title = "T"\nsubtitle = \n'})
    assert found[0].startswith("content/book.toml:2: malformed TOML:")


def test_a_missing_key_of_the_outline_is_reported(mistakes: Find) -> None:
    outline = 'title = "T"\nsubtitel = "S"\nprerequisites = "P"\nchapters = ["00-first"]\n'
    found = mistakes(files={"content/book.toml": outline})
    assert "content/book.toml:2: unknown key 'subtitel'; did you mean 'subtitle'?" in found
    assert any("no 'subtitle'" in line for line in found)


def test_a_character_that_yaml_forbids_is_told_at_its_line(mistakes: Find) -> None:
    found = mistakes(files={"content/00-first.md": "---\ntitle: a\x07\nsummary: s\n---\n"})
    assert found == ["content/00-first.md:2: control character U+0007; legal: visible text"]


def test_malformed_yaml_is_reported_at_its_line(mistakes: Find) -> None:
    found = mistakes(files={"content/00-first.md": "---\ntitle: [\nsummary: s\n---\n\nText.\n"})
    assert len(found) == 1
    assert found[0].startswith("content/00-first.md:3: malformed YAML:")


def test_front_matter_that_is_no_mapping_is_reported(mistakes: Find) -> None:
    found = mistakes(files={"content/00-first.md": "---\n- title\n---\n\nText.\n"})
    assert found[0].startswith("content/00-first.md:1: front matter is no mapping; legal:")


def test_a_book_without_an_outline_is_told_what_one_holds(mistakes: Find) -> None:
    assert mistakes(files={"content/book.toml": None}) == [
        "content/book.toml:1: no outline; legal: a file with "
        "title, subtitle, prerequisites, chapters"
    ]


def test_an_outline_without_chapters_is_reported_at_its_line(mistakes: Find) -> None:
    outline = OUTLINE.partition("chapters")[0] + "chapters = []\n"
    found = mistakes(files={"content/book.toml": outline})
    assert found == ["content/book.toml:6: no 'chapters'; legal: chapters = [\"00-slug\", …]"]


def test_a_number_of_a_figure_that_cannot_be_drawn_is_reported_with_its_reason(
    make_book: Callable[..., Options],
) -> None:
    options = make_book("{readout}`demo k1`\n", {"content/book.toml": OUTLINE_WITHOUT_COVER})

    def draw(*_: object) -> Frame:
        raise ZeroDivisionError("division by zero")

    def load(scene_id: str) -> Scene[Any]:
        return replace(options.load_scene(scene_id), draw=draw)

    with pytest.raises(BuildError) as raised:
        check_site(replace(options, load_scene=load))
    assert [str(found) for found in raised.value.diagnostics] == [
        "content/00-first.md:5: simulation 'demo' cannot be drawn: ZeroDivisionError: "
        "division by zero"
    ]


def test_a_number_of_things_between_two_steps_is_reported(
    make_book: Callable[..., Options],
) -> None:
    @dataclass(frozen=True, slots=True)
    class Settings:
        spokes: int = slider("Spokes", 8, 2, 16, 1)

    options = make_book(
        ":::{simulation} demo\n:spokes: 7.5\n:::\n",
        {"content/book.toml": OUTLINE_WITHOUT_COVER},
    )
    wheel = Scene("demo", "D", Settings, lambda _settings, _outputs: Frame((), (), "A wheel."))
    with pytest.raises(BuildError) as raised:
        check_site(replace(options, load_scene=lambda _id: wheel))
    assert [str(found) for found in raised.value.diagnostics] == [
        "content/00-first.md:6: demo: spokes: 7.5 is between two steps; legal: 2 and steps of 1"
    ]


def test_a_chapter_without_front_matter_is_reported(mistakes: Find) -> None:
    found = mistakes(files={"content/00-first.md": "Text.\n"})
    assert found[0].startswith("content/00-first.md:1: no front matter; legal:")


def test_a_scene_that_cannot_be_imported_is_reported_with_its_reason(mistakes: Find) -> None:
    found = mistakes(":::{simulation} broken\n:::\n")
    assert found == [
        "content/00-first.md:5: simulation 'broken' cannot be loaded: ImportError: no module"
    ]


def test_quizzes_of_two_chapters_must_not_share_an_id(mistakes: Find) -> None:
    quiz = ":::{quiz} same\nWhat?\n- [x] this\n  : yes\n- [ ] that\n  : no\n:::\n"
    second = f"---\ntitle: S\nsummary: s\n---\n{quiz}"
    found = mistakes(quiz, {"content/01-second.md": second})
    assert found == [
        "content/01-second.md:5: duplicate quiz id 'same'; first used at content/00-first.md:5"
    ]
