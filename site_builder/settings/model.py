"""What ``content/book.toml`` may say. Reading, checks, the JSON schema and the author's table all
follow from these classes."""

from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from types import MappingProxyType

from site_builder.languages.words import languages
from site_builder.settings.declared import key
from site_builder.settings.kinds import (
    COLOUR,
    FILE,
    PREFIX,
    SITE,
    SOURCE,
    Entries,
    Names,
    OneOf,
    SomeOf,
    Table,
    Text,
    Whole,
    YesOrNo,
)

FILE_NAME = "content/book.toml"
OWN = "as in this book"
HOSTS = ("apache", "netlify", "nginx")
"""Those of static sites that a configuration can be written for."""


@dataclass(frozen=True, slots=True)
class Licence:
    """Under which terms the book is here."""

    code: str = key(Text(), "the licence of the code, as the foot of every page names it", "MIT")
    text: str = key(Text(), "that of text and figures", "CC BY 4.0")
    text_in_full: str = key(
        Text(),
        "the same, as the page of licences spells it",
        "Creative Commons Attribution 4.0 International",
    )


@dataclass(frozen=True, slots=True)
class Labels:
    """What numbered things are called; nothing where the language's own word holds."""

    chapter: str = key(Text(), "a chapter", "", without="the language's word")
    appendix: str = key(Text(), "an appendix", "", without="the language's word")
    figure: str = key(Text(), "a figure", "", without="the language's word")
    equation: str = key(Text(), "a displayed equation", "", without="the language's word")
    table: str = key(Text(), "a table", "", without="the language's word")
    example: str = key(Text(), "a worked example", "", without="the language's word")
    prediction: str = key(Text(), "a prediction", "", without="the language's word")
    question: str = key(Text(), "a question", "", without="the language's word")


@dataclass(frozen=True, slots=True)
class Palette:
    """The colours of one theme; nothing where the builder's own hold."""

    paper: str = key(COLOUR, "the ground of the page", "", without=OWN)
    raised: str = key(COLOUR, "the ground of what lies on it", "", without=OWN)
    sunken: str = key(COLOUR, "the ground of what is let into it", "", without=OWN)
    ink: str = key(COLOUR, "text", "", without=OWN)
    ink_soft: str = key(COLOUR, "text that steps back", "", without=OWN)
    rule_strong: str = key(COLOUR, "the outline of a control", "", without=OWN)
    rule: str = key(COLOUR, "a hairline", "", without=OWN)
    accent: str = key(COLOUR, "what can be operated: links, controls, focus", "", without=OWN)
    on_accent: str = key(COLOUR, "text on that colour", "", without=OWN)
    world: str = key(COLOUR, "things of the world", "", without=OWN)
    camera: str = key(COLOUR, "the camera", "", without=OWN)
    ray: str = key(COLOUR, "rays", "", without=OWN)
    image: str = key(COLOUR, "the image", "", without=OWN)
    light: str = key(COLOUR, "light", "", without=OWN)
    error: str = key(COLOUR, "errors", "", without=OWN)
    muted: str = key(COLOUR, "what steps back in a figure", "", without=OWN)

    def chosen(self) -> dict[str, str]:
        """Those that the author chose, by their name in the style sheet."""
        colours = {item.name: getattr(self, item.name) for item in fields(self)}
        return {name.replace("_", "-"): colour for name, colour in colours.items() if colour}


@dataclass(frozen=True, slots=True)
class Theme:
    """Colours by role, for each theme."""

    light: Palette = key(Table(Palette), "the colours of the light theme", Palette())
    dark: Palette = key(Table(Palette), "those of the dark one", Palette())


@dataclass(frozen=True, slots=True)
class Serif:
    """The family of the text."""

    name: str = key(Text(), "the family's name")
    licence: str = key(Text(), "the name of its licence")
    licence_file: str = key(FILE, "the text of its licence")
    regular: str = key(FILE, "a font file, TrueType or OpenType")
    italic: str = key(FILE, "the same, italic")
    semibold: str = key(FILE, "the same, semibold or bold")
    semibold_italic: str = key(FILE, "the same, semibold or bold, and italic")


@dataclass(frozen=True, slots=True)
class Sans:
    """The family of controls and labels."""

    name: str = key(Text(), "the family's name")
    licence: str = key(Text(), "the name of its licence")
    licence_file: str = key(FILE, "the text of its licence")
    regular: str = key(FILE, "a font file, TrueType or OpenType")
    italic: str = key(FILE, "the same, italic")
    semibold: str = key(FILE, "the same, semibold or bold")


@dataclass(frozen=True, slots=True)
class Fonts:
    """Families in place of the builder's own."""

    serif: Serif | None = key(Table(Serif), "the family of the text", None, without="Source Serif")
    sans: Sans | None = key(
        Table(Sans), "the family of controls and labels", None, without="Source Sans"
    )


@dataclass(frozen=True, slots=True)
class Publishing:
    """What lies beside the site's files, for the host that serves them."""

    hosts: tuple[str, ...] = key(
        SomeOf(HOSTS), "hosts that a configuration is written for, into the site's folder", ()
    )
    compressed: bool = key(
        YesOrNo(), "whether each file has copies packed by gzip and brotli beside it", False
    )


@dataclass(frozen=True, slots=True)
class Trust:
    """What of the authors' sources goes into the pages unseen."""

    raw_html: bool = key(
        YesOrNo(), "whether Markdown may hold HTML, scripts included", False, without="`false`"
    )


@dataclass(frozen=True, slots=True)
class Settings:
    """The whole file."""

    title: str = key(Text(), "what the book is called")
    subtitle: str = key(Text(), "what it is about, in a sentence")
    prerequisites: str = key(Text(), "what its reader should know")
    chapters: tuple[str, ...] = key(
        Names('["00-slug", …]', least=1), "the files of the chapters, in reading order"
    )
    appendices: tuple[str, ...] = key(Names('["00-slug", …]'), "those of the appendices", ())
    hero: str = key(Text(), "the simulation on the title page", "", without="none")
    hero_caption: str = key(Text(), "a sentence about it", "", without="none")
    search_examples: tuple[str, ...] = key(
        Names('["one", "another"]'), "what one may search for, as the search's card says it", ()
    )
    language: str = key(
        OneOf(languages), "the language of text and interface, `site_builder/languages/`", "en"
    )
    first_number: int = key(Whole(0), "the number of the first chapter", 0)
    storage: str = key(
        PREFIX, "begins the names of what a browser keeps", "", without="made of the title"
    )
    address: str = key(SITE, "where the book is published", "", without="unknown")
    source: str = key(
        SOURCE, "where its sources can be read, `{path}` for a file's path", "", without="unknown"
    )
    licence: Licence = key(Table(Licence), "under which terms the book is here", Licence())
    labels: Labels = key(Table(Labels), "what numbered things are called", Labels())
    theme: Theme = key(Table(Theme), "the colours", Theme())
    fonts: Fonts = key(Table(Fonts), "the faces", Fonts())
    macros: Mapping[str, str] = key(
        Entries("a table of names with TeX, R = '\\mathbb{R}'"),
        "TeX commands of the book's own, `#1` for an argument",
        MappingProxyType({}),
        without="none",
    )
    publishing: Publishing = key(Table(Publishing), "what the site's host is given", Publishing())
    trust: Trust = key(Table(Trust), "what goes into the pages unseen", Trust())


@dataclass(frozen=True, slots=True)
class Face:
    """A font file of the author's."""

    style: str
    """As in the names of the builder's own files: ``semibold-italic``."""
    file: str
    """Below ``content/``."""
    at: tuple[str, ...] = field(default=())
    """The key that names it."""


def font_files(family: Serif | Sans, role: str) -> tuple[Face, ...]:
    """The files of a family, each with the key that names it."""
    styles = [item.name for item in fields(family) if item.metadata["kind"] is FILE]
    return tuple(
        Face(style.replace("_", "-"), getattr(family, style), ("fonts", role, style))
        for style in styles
        if style != "licence_file"
    )
