# SPDX-License-Identifier: MIT
"""Native and reference kernels: the only switch between them."""

from types import ModuleType
from typing import Literal

from tricue import _core, reference

Name = Literal["native", "reference"]
_MODULES: dict[str, ModuleType] = {"native": _core, "reference": reference}


def load(name: Name) -> ModuleType:
    """The module whose functions are the kernels: C++ for "native", their NumPy twins for "reference"."""
    try:
        return _MODULES[name]
    except KeyError:
        raise ValueError(f"kernels: expected 'native' or 'reference', got {name!r}") from None
