"""The message of an exception of an author's code, and the line of that code that raised it."""

import re
import sysconfig
import traceback
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path

import simulations
from simulations import engine
from simulations.engine.controls import ControlError

HERE = Path(__file__).resolve().parents[1]
REMEMBERED = "place_and_words"
SETTINGS = "at_settings"
"""Names of what an error carries."""
OURS = ("simulations", "site_builder")
PACKAGES = (
    "legal: Python's library, numpy, and what 'packages' of [runtime] in content/book.toml names "
    "and is installed here"
)
LIBRARIES = (
    *(Path(sysconfig.get_path(name)).resolve() for name in ("stdlib", "purelib")),
    Path(engine.__file__ or "").resolve().parent,
)


class CodeError(LookupError):
    """What cannot be had, perhaps as an author's code raised what is the cause."""


def raised_by_code(error: BaseException | None) -> BaseException | None:
    """What an author's code raised, where that is the reason of an error of ours."""
    while error and not isinstance(error, CodeError):
        error = error.__cause__
    return error and error.__cause__


def remember[E: BaseException](error: E, place: str, words: str) -> E:
    """The error with its place and words, since a traceback does not pass between processes."""
    setattr(error, REMEMBERED, (place, words))
    return error


def words_of(error: BaseException) -> str:
    """What Python prints of it behind its name, with the names that may have been meant."""
    if remembered := getattr(error, REMEMBERED, None):
        return str(remembered[1])
    if isinstance(error, ModuleNotFoundError) and not (error.name or "").startswith(OURS):
        return f"{error}; {PACKAGES}"
    if type(error).__module__ != "builtins":  # by what survives a `__str__` that raises
        return str(traceback.TracebackException(type(error), error, None))
    *_, last = traceback.TracebackException.from_exception(error).format_exception_only()
    return last.strip().partition(": ")[2]


def place_of(error: BaseException) -> str:
    """``simulations/scenes/orbit/scene.py:12``: the innermost line that is neither the builder's,
    nor the engine's, nor a library's; nothing where there is none."""
    if remembered := getattr(error, REMEMBERED, None):
        return str(remembered[0])
    if isinstance(error, SyntaxError) and error.filename:
        file = Path(error.filename)
        return f"{_relative(file) if file.is_absolute() else file}:{error.lineno or 1}"
    return _innermost(traceback.extract_tb(error.__traceback__))


@contextmanager
def in_module(module: str) -> Iterator[None]:
    """What is raised within, but at no line of an author's, or about a control, is of this module:
    see `place_in`."""
    try:
        yield
    except Exception as error:
        of_control = isinstance(error, ControlError) or words_of(error).startswith("setting '")
        if of_control or not place_of(error):
            remember(error, place_in(module, words_of(error)), words_of(error))
        raise


QUOTED = re.compile(r"'([^'\n]+)'")
FORMS = (r"""["']{}["']""", r"""["'](?:.*\s)?{}(?:\s.*)?["']""", r"^(?!from|import).*\b{}\b")
"""How a word may stand in a line: as a text, within one, elsewhere."""
OF_CONTROL = re.compile(r"(?:setting ')?(\w+)'?: ")
DECLARED = r"\b_?{}\b\s*(?::[^=]*)?=\s*[\w.]+\("
"""How a message begins that names a control, and where that is declared."""
SCENE = r"SCENE\b|@figure\b"
TRACED = re.compile(r'File "(.+)", line (\d+)')


def place_in(module: str, message: str) -> str:
    """Place in an author's module that a message is about: the first line with the last word quoted
    before the legal values (texts are searched first), or else the line that defines the scene.
    Empty for other modules."""
    path = module.replace(".", "/").removeprefix("simulations/")
    places = (
        folder / name for folder in _folders() for name in (f"{path}.py", f"{path}/__init__.py")
    )
    file = next((each for each in places if each.is_file() and _is_authors(each)), None)
    if file is None:
        return ""
    lines = file.read_text(encoding="utf-8", errors="replace").split("\n")
    words = reversed(QUOTED.findall(message.partition("; ")[0]))
    forms = [DECLARED.format(name) for name in OF_CONTROL.findall(message)[:1]]
    forms += [form.format(re.escape(word)) for word in words for form in FORMS]
    for form in (*forms, SCENE):
        for number, line in enumerate(lines, start=1):
            if re.search(form, line):
                return f"{_relative(file)}:{number}"
    return f"{_relative(file)}:1"


def place_in_trace(text: str) -> str:
    """The same as `place_of`, of what `faulthandler` wrote, the innermost line first."""
    frames = [traceback.FrameSummary(file, int(line), "") for file, line in TRACED.findall(text)]
    return _innermost(frames[::-1])


def _innermost(frames: Sequence[traceback.FrameSummary]) -> str:
    for frame in reversed(frames):
        file = Path(frame.filename)
        if file.is_file() and _is_authors(file.resolve()):
            return f"{_relative(file)}:{frame.lineno or 1}"
    return ""


@contextmanager
def at_settings(settings: Mapping[str, object]) -> Iterator[None]:
    """Add these settings to the message of whatever is raised within."""
    try:
        yield
    except Exception as error:
        said = ", ".join(f"{name} = {value}" for name, value in settings.items())
        setattr(error, SETTINGS, said)
        raise


def settings_of(error: BaseException) -> str:
    """``k1 = -0.2, size = 3``, or nothing."""
    return str(getattr(error, SETTINGS, ""))


def _is_authors(file: Path) -> bool:
    others = (HERE, *LIBRARIES)
    is_simulation = any(file.is_relative_to(folder) for folder in _folders())
    return is_simulation and not any(map(file.is_relative_to, others))


def _relative(file: Path) -> str:
    """Its path from the folder that holds ``simulations``."""
    file = file.resolve()
    base = next((each for each in _folders() if file.is_relative_to(each)), file.parent / "_")
    return file.relative_to(base.parent).as_posix()


def _folders() -> list[Path]:
    """Folders of ``simulations``: the book's, and the engine's."""
    return [Path(folder).resolve() for folder in simulations.__path__]
