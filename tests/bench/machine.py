"""What the numbers were measured on, in general terms: no names, no paths."""

import os
import platform

import numpy as np


def describe_machine(browser: str, pyodide: str) -> dict[str, object]:
    return {
        "processor": platform.machine(),
        "cores": os.cpu_count() or 1,
        "system": platform.system(),
        "python": platform.python_version(),
        "numpy": np.__version__,
        "browser": browser,
        "pyodide": pyodide,
    }
