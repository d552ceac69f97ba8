"""Numpy and other packages out of their wheels, sifted as Pyodide's own packages are."""

from pathlib import Path
from zipfile import ZipFile


class WheelError(RuntimeError):
    """The wheel holds what a browser cannot run."""


def unpack_for_browser(wheel: Path, folder: Path, *, with_tests: bool = True) -> Path:
    """Unpack ``wheel`` in ``folder``, put its tests aside, and return where its modules lie.

    Pyodide's release has put aside those of most packages, and knows what only has such a name:
    then the wheel is not ``with_tests``.

    Raises
    ------
    WheelError
        Where an extension module is not WebAssembly: the wheel is for another machine.
    """
    # Needed once on each machine.
    from pyodide_build.common import check_wasm_magic_number
    from pyodide_build.recipe.unvendor import unvendor_tests

    modules = folder / "modules"
    with ZipFile(wheel) as archive:
        archive.extractall(modules)
    if with_tests:
        unvendor_tests(modules, folder / "tests", retain_test_patterns=[])
    for extension in sorted(modules.rglob("*.so")):
        if not check_wasm_magic_number(extension):
            raise WheelError(f"{wheel.name}: {extension.name} is not WebAssembly")
    return modules
