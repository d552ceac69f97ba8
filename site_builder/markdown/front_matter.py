"""The lines between ``---`` at the top of a chapter: its title and its summary."""

from collections.abc import Sequence

import yaml
from markdown_it.token import Token

from site_builder.diagnostics import unknown
from site_builder.markdown.reading import Reading

KEYS = ("title", "summary")
"""All of them required."""
LEGAL = "legal: '---', 'title: …', 'summary: …', '---'"


def read_front_matter(tokens: Sequence[Token], reading: Reading) -> dict[str, str]:
    """The text of each of `KEYS`; empty where it is missing, which is reported."""
    nothing = dict.fromkeys(KEYS, "")
    if not tokens or tokens[0].type != "front_matter":
        reading.problem(1, f"no front matter; {LEGAL}")
        return nothing
    try:
        root = yaml.compose(tokens[0].content, Loader=yaml.SafeLoader)
    except yaml.YAMLError as error:
        mark = getattr(error, "problem_mark", None)  # a character that YAML forbids has none
        reason = getattr(error, "problem", None) or str(error).partition("\n")[0]
        reading.problem(mark.line + 2 if mark else 1, f"malformed YAML: {reason}")
        return nothing
    if not isinstance(root, yaml.MappingNode):
        reading.problem(1, f"front matter is no mapping; {LEGAL}")
        return nothing
    return _read_entries(root, reading)


def _read_entries(root: yaml.MappingNode, reading: Reading) -> dict[str, str]:
    texts: dict[str, str] = {}
    lines = dict.fromkeys(KEYS, 1)
    for key, value in root.value:
        line = key.start_mark.line + 2  # below the ``---``, and counted from 1
        if key.value not in KEYS:
            reading.problem(line, unknown("front matter key", str(key.value), KEYS))
            continue
        if key.value in texts:
            reading.problem(line, f"{key.value!r} is given twice; legal: once")
        lines[key.value] = line
        texts[key.value] = value.value.strip() if value.tag == "tag:yaml.org,2002:str" else ""
    for name in KEYS:
        if not texts.get(name):
            reading.problem(
                lines[name], f"front matter without {name!r}; legal: '{name}: some text'"
            )
    return {name: texts.get(name, "") for name in KEYS}
