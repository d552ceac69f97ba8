"""``import FILE``: a Jupyter notebook or a page of MyST as a chapter. Text, formulae and pictures
are taken, outputs as stills; a call of ipywidgets' ``interact`` becomes the skeleton of a scene
with its sliders. What could not be taken is listed.
"""

import ast
import base64
import json
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import count
from pathlib import Path
from typing import Any

from site_builder.files.folders import is_file
from site_builder.markdown.numbering import slug
from site_builder.markdown.text.dialects import ROLES as REFERRING
from site_builder.scaffold.ipywidgets import Given, control, interacting
from site_builder.scaffold.pieces import Name, ScaffoldError, chapter, filled, packages

BOXES = {
    "admonition": "note", "seealso": "note", "attention": "warning", "caution": "warning",
    "danger": "warning", "error": "warning", "hint": "tip", "important": "key-idea",
    "exercise": "note", "solution": "note", "theorem": "note", "proof": "note", "dropdown": "note",
    "topic": "note", "sidebar": "note", "margin": "note", "definition": "note", "lemma": "note",
    "note": "note", "tip": "tip", "warning": "warning", "figure": "figure", "image": "figure",
    "math": "math",
}  # fmt: skip
"""Directives of MyST, and ours that hold the same."""
CODE = ("code", "code-block", "sourcecode")
DROPPED = (
    "contents", "toctree", "tableofcontents", "index", "bibliography", "raw", "list-table",
    "csv-table", "eval-rst", "include", "literalinclude", "mermaid", "iframe", "glossary",
)  # fmt: skip
"""Directives whose lines are no text."""
UNTITLED = ("note", "tip", "warning", "hint", "important", "caution", "danger", "attention")
CELL = re.compile(r"^(`{3,}|~{3,})\{code-cell\}[^\n]*\n(.*?)^\1[ \t]*$", re.MULTILINE | re.DOTALL)
OPTIONS = re.compile(r"\A(?:---\n.*?\n---\n|(?::[\w-]+:[^\n]*\n)+)", re.DOTALL)
FRONT = re.compile(r"\A---\n.*?\n---\n", re.DOTALL)
FENCE = re.compile(r"^(\s*)(`{3,}|~{3,}|:{3,})\{([\w:-]+)\}[ \t]*(.*)$")
PICTURE = re.compile(r"^!\[([^\]]*)\]\(([^)\s]+)[^)]*\)$")
INLINE_PICTURE = re.compile(r"!\[([^\]]*)\]\([^)]*\)")
ROLE = re.compile(r"\{([\w:-]+)\}`([^`]+)`")
LABELS = re.compile(r"^\(([\w:.-]+)\)=|^:(?:label|name): *(\S+)|\\label\{([^}]+)\}", re.MULTILINE)
TAG = re.compile(r"</?[A-Za-z][^>]*>|<!--.*?-->")
LINK = re.compile(r"(?<!!)\[([^\]]*)\]\((?!https?:)[^)]*\)")
MOST_LINES = 30
"""Lines of printed output that a chapter shows."""


@dataclass(slots=True)
class Page:
    root: Path
    source: Path
    name: Name
    files: dict[str, bytes] = field(default_factory=dict)
    """Pictures and scenes, by path."""
    lost: list[str] = field(default_factory=list)
    functions: dict[str, ast.FunctionDef] = field(default_factory=dict)
    labels: set[str] = field(default_factory=set)

    def lose(self, what: str) -> None:
        if what not in self.lost:
            self.lost.append(what)


def import_file(root: Path, file: str) -> str:
    """A list of what was made and of what was lost. Raises `ScaffoldError`."""
    source = Path(file)
    if source.suffix not in (".ipynb", ".md") or not is_file(source):
        raise ScaffoldError(f"{file!r}; legal: a notebook, NAME.ipynb, or a page of MyST, NAME.md")
    stem = re.sub("[^a-z0-9]+", "-", re.sub(r"^\d+[-_ ]*", "", source.stem).lower()).strip("-")
    page = Page(root, source, Name(stem or "imported"))
    try:
        text = source.read_text(encoding="utf-8-sig").replace("\r\n", "\n")
    except UnicodeDecodeError:
        raise ScaffoldError(f"{file!r} is not UTF-8; legal: UTF-8") from None
    cells = [*(_notebook(text) if source.suffix == ".ipynb" else _myst(text))]
    page.labels = {
        next(filter(None, found)) for _, words, _ in cells for found in LABELS.findall(words)
    }
    parts = [
        _text(words, page) if kind == "markdown" else _code(words, outputs, page)
        for kind, words, outputs in cells
    ]
    title, body = _headings("\n\n".join(part.strip("\n") for part in parts if part.strip()), page)
    made, _ = chapter(root, page.name.text)
    path = next(iter(made))
    matter = json.dumps(title, ensure_ascii=False), "In one sentence, what this chapter tells."
    front = f"---\ntitle: {matter[0]}\nsummary: {matter[1]}\n---\n\n"
    (root / path).write_text(f"{front}{body.strip()}\n", encoding="utf-8")
    for place, data in page.files.items():
        (root / place).parent.mkdir(parents=True, exist_ok=True)
        (root / place).write_bytes(data)
    lost = [f"not taken: {what}" for what in page.lost]
    return "\n".join([*made, *page.files, *lost, "next: python -m site_builder check"])


type Cell = tuple[str, str, Sequence[Mapping[str, Any]]]


def _notebook(text: str) -> Iterator[Cell]:
    try:
        cells = json.loads(text)["cells"]
        for cell in cells:
            words = "".join(cell["source"])
            for name, data in cell.get("attachments", {}).items():
                words = words.replace(f"attachment:{name}", _data_address(data))
            yield cell["cell_type"], words, cell.get("outputs", ())
    except (ValueError, LookupError, TypeError, AttributeError):
        raise ScaffoldError("no notebook of format 4; legal: one that Jupyter has saved") from None


def _data_address(data: Mapping[str, str]) -> str:
    kind, content = next(iter(data.items()))
    return f"data:{kind};base64,{''.join(content.split())}"


def _myst(text: str) -> Iterator[Cell]:
    parts, end = FRONT.sub("", text), 0
    for found in CELL.finditer(parts):
        yield "markdown", parts[end : found.start()], ()
        yield "code", OPTIONS.sub("", found[2]), ()
        end = found.end()
    yield "markdown", parts[end:], ()


def _headings(text: str, page: Page) -> tuple[str, str]:
    """The title, and the text with headings from the second level on, none skipped."""
    title, levels, code, lines = "", [1], "", []
    for line in text.split("\n"):
        fence = re.match(r"\s*(`{3,}|~{3,})", line)
        if fence and (not code or line.strip().startswith(code)):
            code = "" if code else fence[1]
        found = None if code else re.fullmatch(r"(#{1,6}) +(.*?)(?: +#+)?", line)
        if found and not title:
            title = re.sub(r"[*`$_]|\{.*\}", "", found[2]).strip()
            continue
        if found:
            level = min(max(len(found[1]), 2), levels[-1] + 1)
            levels.append(level)
            line = f"{'#' * level} {found[2]}"
        lines.append(line)
    if lines and re.fullmatch(r"\([\w:.-]+\)=", lines[0]):
        page.lose(f"label {lines.pop(0)} of the title")
    return title or page.name.title, "\n".join(lines)


def _text(words: str, page: Page) -> str:
    """Markdown in our form."""
    lines, out, place = words.split("\n"), list[str](), 0
    while place < len(lines):
        line, place = lines[place], place + 1
        text, fence = line.strip(), FENCE.match(line)
        mark = re.match(r"`{3,}|~{3,}", text)
        if fence or mark:
            marker = fence[2] if fence else (mark or [""])[0]
            ends = (n for n in range(place, len(lines)) if lines[n].strip() == marker)
            end = next(ends, len(lines))
            inside, place = lines[place:end], end + 1
            if fence:
                out.append(_directive(fence[3], fence[4], inside, page))
            else:
                out += [line, *inside, marker]
        elif picture := PICTURE.fullmatch(text):
            out.append(_picture(picture[2], picture[1], (), page))
        else:
            out.append(_line(line, page))
    return "\n".join(out)


def _directive(name: str, argument: str, inside: list[str], page: Page) -> str:
    kind = BOXES.get(re.sub(r".*:|-start$", "", name), "")
    given = OPTIONS.match("\n".join([*inside, ""]))
    options = dict(re.findall(r"^:?([\w-]+): *(.*)$", given[0], re.MULTILINE)) if given else {}
    body = "\n".join([*inside, ""])[given.end() if given else 0 :].strip("\n")
    label = slug(str(options.get("label") or options.get("name") or ""))
    if kind == "math":
        if "&" in body and "\\begin" not in body:
            body = f"\\begin{{aligned}}\n{body}\n\\end{{aligned}}"
        found = f" ({label})" if options.get("label") or options.get("name") else ""
        return f"$$\n{'\n'.join((argument, body)).strip()}\n$${found}"
    if kind == "figure":
        own = [f":label: {label}"] if options.get("name") or options.get("label") else []
        width = options.get("width", "")
        own += [f":width: {width}"] if re.fullmatch(r"[1-9]\d?%|[1-9]\d{1,3}px", width) else []
        return _picture(argument, options.get("alt", ""), own, page, _text(body, page))
    if name in CODE:
        return f"```{argument or 'text'}\n{body}\n```"
    if not kind:
        dropped = name in DROPPED or not body
        page.lose(f"directive '{name}'{'' if dropped else ', its text is taken'}")
        return "" if dropped else _text(body, page)
    is_titled = name not in UNTITLED and argument
    words = "" if is_titled else argument
    title = _line(argument, page) if is_titled else name.capitalize() * (name not in BOXES.values())
    text = _text("\n".join(filter(None, (words, body))), page)
    marker = ":" * (
        3 + max((len(m) - 2 for m in re.findall("^:{3,}", text, re.MULTILINE)), default=0)
    )
    return f"{marker}{{{kind}}} {title}".rstrip() + f"\n{text}\n{marker}"


def _line(line: str, page: Page) -> str:
    if re.match(r"\+\+\+|%(?!\S*%)", line):
        return ""
    line = re.sub(r"\\\\\((.+?)\\\\\)", r"$\1$", line)

    def role(found: re.Match[str]) -> str:
        name, text = found.groups()
        words, _, target = text.removesuffix(">").rpartition("<")
        if name == "math" or (REFERRING.get(name) == "ref" and target in page.labels):
            return found[0]
        page.lose(f"role '{name}' of {text!r}, now words")
        return words.strip() or text

    def link(found: re.Match[str]) -> str:
        if found[0].endswith("(#)") or found[0].rpartition("#")[2].rstrip(")") in page.labels:
            return found[0]
        page.lose(f"link {found[0]!r}, now words")
        return found[1]

    def tag(found: re.Match[str]) -> str:
        if re.match(r"<https?:", found[0]):
            return found[0]
        page.lose(f"HTML {found[0][:60]!r}")
        return ""

    line = re.sub(
        r"\{\{ *(\w+) *\}\}|(?<=[\])}`])\{[.#][^}]*\}", lambda found: found[1] or "", line
    )
    line = "" if re.fullmatch(r"\{[.#][^}]*\}", line.strip()) else line
    pieces = re.split(r"(`+[^`]+`+|\$[^$]+\$)", ROLE.sub(role, line))
    for at in range(0, len(pieces), 2):
        piece = INLINE_PICTURE.sub(lambda found: _lost_picture(found, page), pieces[at])
        pieces[at] = TAG.sub(tag, LINK.sub(link, piece))
    return "".join(pieces)


def _lost_picture(found: re.Match[str], page: Page) -> str:
    page.lose(f"picture within a line, {found[0][:60]!r}")
    return found[1]


def _picture(address: str, alt: str, options: Sequence[str], page: Page, caption: str = "") -> str:
    """A figure with a copy of the picture."""
    data, ending = b"", Path(address).suffix.lower()
    if found := re.match(r"data:image/(\w+)[^,]*;base64,(.*)", address):
        data, ending = base64.b64decode(found[2]), f".{found[1]}"
    elif is_file(page.source.parent / address):
        data = (page.source.parent / address).read_bytes()
    if not data or ending not in (".png", ".jpg", ".jpeg", ".svg", ".webp", ".gif"):
        page.lose(f"picture {address[:60]!r}")
        return caption or alt
    place = _store(data, ending, page)
    said = re.sub(r"\s+", " ", alt) or "What the picture shows."
    return _figure(place, said, options, caption or said)


def _figure(place: str, alt: str, options: Sequence[str], caption: str) -> str:
    return "\n".join([f":::{{figure}} {place}", f":alt: {alt}", *options, caption, ":::"])


def _store(data: bytes, ending: str, page: Page) -> str:
    number = 1 + sum(path.startswith("content/images/") for path in page.files)
    place = f"images/{page.name.text}-{number}{ending}"
    page.files[f"content/{place}"] = data
    return place


def _code(code: str, outputs: Sequence[Mapping[str, Any]], page: Page) -> str:
    """Code, what it printed and drew; a figure in place of a call of ``interact``."""
    lines = code.strip("\n").split("\n")
    commands = [line for line in lines if re.match(r"\s*[%!?]|.*\?$", line)]
    for line in commands:
        page.lose(f"command {line.strip()!r}")
    code = "\n".join(line for line in lines if line not in commands).strip("\n")
    try:
        tree = ast.parse(code)
    except SyntaxError:
        tree = ast.parse("")
    page.functions |= {each.name: each for each in tree.body if isinstance(each, ast.FunctionDef)}
    called = interacting(tree, page.functions)
    scenes = [*filter(None, (_scene(function, controls, page) for function, controls in called))]
    if scenes and any("text" in output for output in outputs):
        page.lose("what a figure's cell printed")
    shown = [f"```python\n{code}\n```"] if code and not scenes else []
    return "\n\n".join([*shown, *scenes, *(() if scenes else _outputs(outputs, page))])


def _outputs(outputs: Sequence[Mapping[str, Any]], page: Page) -> Iterator[str]:
    for output in outputs:
        data = output.get("data", {"text/plain": output.get("text", "")})
        pictures = [kind for kind in ("image/png", "image/jpeg") if kind in data]
        plain = "".join(data.get("text/plain", "")).strip("\n")
        if output.get("output_type") == "error":
            page.lose(f"error {output.get('ename')}")
        elif pictures:
            ending = pictures[0].replace("image/", ".").replace("jpeg", "jpg")
            place = _store(base64.b64decode("".join(data[pictures[0]])), ending, page)
            yield _figure(place, "What the code above draws.", (), "As the code draws it.")
        elif any("widget" in kind or "javascript" in kind for kind in data) or not plain:
            page.lose(f"output of the kind {', '.join(data)}")
        else:
            shown = plain.split("\n")
            if len(shown) > MOST_LINES:
                page.lose(f"{len(shown) - MOST_LINES} lines of an output")
            yield "```text\n" + "\n".join(shown[:MOST_LINES]) + "\n```"


def _scene(function: str, controls: Mapping[str, Given], page: Page) -> str:
    """The skeleton of a scene, and the figure that shows it."""
    number = next(n for n in count(1) if _scene_path(page, n) not in page.files)
    name = Name(f"{page.name.text}-{number}")
    declared = dict[str, str]()
    for argument, (value, default) in controls.items():
        if found := control(argument, value, default):
            declared[argument] = found
        else:
            page.lose(f"argument {argument!r} of {function}, {ast.unparse(value)[:60]!r}")
    if not declared:
        page.lose(f"a figure of {function}, which has no sliders")
        return ""
    code = ast.unparse(page.functions[function]) if function in page.functions else ""
    page.files |= {
        path: text.encode() for path, text in packages(page.root, "simulations/scenes/x.py").items()
    }
    page.files[_scene_path(page, number)] = filled(
        "skeletons/scene/imported.py.jinja",
        module=name.module,
        title=function.replace("_", " ").strip().capitalize(),
        controls=declared,
        names="".join(f"{each.strip('_')}, " for each in declared),
        code=code.split("\n") if code else [],
    ).encode()
    page.lose(f"drawing of {function}; simulations/scenes/{name.module}.py has its sliders")
    return f":::{{simulation}} {name.text}\nWhat {function} shows.\n:::"


def _scene_path(page: Page, number: int) -> str:
    return f"simulations/scenes/{page.name.module}_{number}.py"
