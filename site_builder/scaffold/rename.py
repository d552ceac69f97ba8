"""``rename OLD NEW``: a chapter or a section under another id, in its file and its translations,
and wherever the book refers to it. Old addresses go on leading there: of a chapter by
``[redirects]`` in ``book.toml``, of a section by a second id behind its heading.
"""

import re
from collections.abc import Collection
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

from site_builder.build import Options, load
from site_builder.diagnostics.diagnostic import unknown
from site_builder.document.book import OUTLINE, Book
from site_builder.document.places import chapter_id
from site_builder.files.text import HEAD, KEY
from site_builder.languages.words import languages
from site_builder.markdown.numbering import GIVEN, LABEL_FORM, slug
from site_builder.markdown.parser import make_parser
from site_builder.markdown.text.tokens import plain_text
from site_builder.sources.outline import OWN_FOLDERS

NAMING = {
    "chapters", "appendices", "parts", "starts", "stops", "redirects",
    "explained", "taught", "chapter",
}  # fmt: skip
"""Keys of TOML files whose texts name places."""
QUOTED = re.compile(r"""(?<=["'])(\d+-)?([\w#-]+)(?=["'])""")
NAMED = re.compile(r"""^(\s*\[?["']?)([\w#-]+)""")
REFERENCE = re.compile(r"(\{ref\}`(?:[^`<]*<)?)([\w#-]+)(?=>?`)")
NEED = re.compile(r"^(\s*- )([\w-]+)(?=: )", re.MULTILINE)
HERE = re.compile(r"(\]\()(#[\w-]+)(?=\))")
ELSEWHERE = re.compile(r"(\]\(<?|^\[[^\]]+\]: <?)(\d+-)?([\w-]+)\.md(#[\w-]+)?", re.MULTILINE)


@dataclass(frozen=True, slots=True)
class Renaming:
    chapter: str
    section: str
    """Nothing where it is the chapter that is renamed."""
    word: str
    """The new id."""
    alone: bool
    """Whether no other chapter has an id as the section's."""

    def place(self, given: str, here: str = "") -> str:
        """What a place is called from now on, on the page ``here``."""
        chapter, mark, section = given.partition("#")
        if not self.section:
            return f"{self.word}{mark}{section}" if chapter == self.chapter else given
        if given == self.section:
            return self.word if self.alone or here == self.chapter else given
        is_meant = mark and section == self.section and (chapter or here) == self.chapter
        return f"{chapter}#{self.word}" if is_meant else given

    def markdown(self, text: str, here: str) -> str:
        def moved(found: re.Match[str]) -> str:
            return found[1] + self.place(found[2], here)

        def linked(found: re.Match[str]) -> str:
            chapter, mark, section = self.place(found[3] + (found[4] or "")).partition("#")
            return f"{found[1]}{found[2] or ''}{chapter}.md{mark}{section}"

        matter, end, body = text.partition("\n---")
        matter = matter if self.section else NEED.sub(moved, matter)
        for pattern in (REFERENCE, HERE):
            body = pattern.sub(moved, body)
        text = matter + end + ELSEWHERE.sub(linked, body)
        return self._heading(text) if self.section and here == self.chapter else text

    def _heading(self, text: str) -> str:
        """The section's new id before its old ones."""
        lines = text.split("\n")
        for opening, inline in pairwise(make_parser().parse(text)):
            if opening.type != "heading_open" or not opening.map:
                continue
            given = opening.meta.get("given", "")
            first, _, more = given.partition(" ")
            own = first if first.startswith("#") else f"#{slug(plain_text(inline))}"
            if own == f"#{self.section}":
                more = more if first.startswith("#") else given
                words = GIVEN.sub("", lines[opening.map[0]])
                kept = [name for name in more.split() if name != f"#{self.word}"]
                ids = " ".join([f"#{self.word}", own, *kept])
                lines[opening.map[0]] = f"{words} {{{ids}}}"
        return "\n".join(lines)

    def toml(self, text: str, name: str) -> str:
        def moved(found: re.Match[str]) -> str:
            return (found[1] or "") + self.place(found[2])

        lines, table, last = text.split("\n"), set[str](), ""
        for at, line in enumerate(lines):
            head, key = HEAD.fullmatch(line), KEY.match(line)
            if head:
                table, last = {*head[2].split(".")}, ""
            last = key[1].strip() if key else last
            if (head and name == "symbols.toml") or (key and name == "search.toml"):
                lines[at] = NAMED.sub(moved, line)
            elif NAMING & {*table, last}:
                start = key.end() if key else 0
                lines[at] = line[:start] + QUOTED.sub(moved, line[start:])
        return "\n".join(lines)

    def redirected(self, outline: str) -> str:
        """``book.toml`` with the old address of the chapter, and without the new one."""
        head, row = "[redirects]\n", f'{self.chapter} = "{self.word}"\n'
        outline = re.sub(rf'^{self.word} = "{self.word}"\n', "", outline, flags=re.MULTILINE)
        if head in outline:
            return outline.replace(head, head + row)
        return f"{outline.rstrip()}\n\n{head}{row}"


def rename(root: Path, old: str, new: str) -> str:
    """A list of the files that changed. ``old`` is ``chapter`` or ``chapter#section``, ``new`` the
    new id. Raises `ValueError` before anything is written."""
    book = load(Options(root, runtime=False)).book
    chapter, _, section = old.partition("#")
    chapter, (other, _, word) = chapter_id(chapter), new.rpartition("#")
    if other not in ("", chapter):
        raise ValueError(f"{new!r} is in another chapter; legal: '{chapter}#…'")
    having = [each.id for each in book.chapters if section in each.anchors]
    renaming = Renaming(chapter, section, word, alone=len(having) == 1)
    _check(book, renaming, (*OWN_FOLDERS, *languages(root)))
    changed: list[str] = []
    for file in sorted((root / "content").rglob("*.*")):
        text = file.read_text("utf-8") if file.suffix in (".md", ".toml") else ""
        here = chapter_id(file.name)
        now = renaming.markdown(text, here) if file.suffix == ".md" else text
        now = renaming.toml(text, file.name) if file.suffix == ".toml" else now
        is_renamed = not section and file.suffix == ".md" and here == chapter
        if not section and file == root / OUTLINE:
            now = renaming.redirected(now)
        place = file.with_name(f"{file.name.removesuffix(f'{chapter}.md')}{renaming.word}.md")
        if is_renamed:
            file.rename(place)
        if is_renamed or now != text:
            (place if is_renamed else file).write_text(now, "utf-8")
            changed.append((place if is_renamed else file).relative_to(root).as_posix())
    return "\n".join([*changed, "next: python -m site_builder check"])


def _check(book: Book, given: Renaming, folders: Collection[str]) -> None:
    chapters = {each.id: each for each in book.chapters}
    if given.chapter not in chapters:
        raise ValueError(unknown("chapter", given.chapter, chapters))
    chapter = chapters[given.chapter]
    sections = [heading.id for heading in chapter.headings]
    if given.section and given.section not in sections:
        raise ValueError(unknown(f"section of {given.chapter}", given.section, sections))
    if not LABEL_FORM.fullmatch(given.word) or chapter_id(given.word) != given.word:
        raise ValueError(f"{given.word!r}; legal: small letters, digits, hyphens; no number first")
    if given.word in (chapter.anchors if given.section else (*chapters, *folders)):
        raise ValueError(f"{given.word!r} is taken; legal: another name")
