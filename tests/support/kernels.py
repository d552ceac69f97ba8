"""The kernels that NumPy computes with, and the environment in which it uses the oldest ones.

OpenBLAS and NumPy have code for each generation of processors and use the newest that this one can
run. Errors near rounding depend on it. As a program, this module prints the environment for the
oldest kernels, as assignments for ``export``.
"""

import platform
from collections.abc import Mapping

import numpy as np
from threadpoolctl import threadpool_info

OLDEST = {"x86_64": "Prescott", "aarch64": "ARMV8", "arm64": "ARMV8"}
"""The oldest kernels of OpenBLAS by `platform.machine`."""


def in_use() -> str:
    """The kernels of OpenBLAS, and the instructions of NumPy's own loops."""
    blas = {each["architecture"] for each in threadpool_info() if "architecture" in each}
    return f"OpenBLAS {', '.join(sorted(blas))}; NumPy {', '.join(dispatched()) or 'baseline'}"


def dispatched() -> list[str]:
    """Instruction sets above the baseline that NumPy uses on this processor."""
    found: list[str] = np.show_config(mode="dicts")["SIMD Extensions"].get("found", [])
    return found


def oldest() -> Mapping[str, str]:
    """The environment in which OpenBLAS and NumPy use their oldest kernels."""
    numpy = {"NPY_DISABLE_CPU_FEATURES": ",".join(dispatched())}
    blas = OLDEST.get(platform.machine())
    return {**numpy, "OPENBLAS_CORETYPE": blas} if blas else numpy


if __name__ == "__main__":
    print(" ".join(f"{name}={value}" for name, value in oldest().items()))
