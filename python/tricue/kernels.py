# SPDX-License-Identifier: MIT
"""Native and reference kernels: the only switch between them."""

from types import ModuleType
from typing import TYPE_CHECKING, Literal

from tricue import _core, reference

if TYPE_CHECKING:
    from tricue._core import Kernels
else:
    Kernels = ModuleType

__all__ = ["Kernels", "Name", "load"]

Name = Literal["native", "reference"]
_KERNELS: dict[str, Kernels] = {"native": _core, "reference": reference}


def load(name: Name) -> Kernels:
    """Give the kernels as a module of functions: C++ for "native", their NumPy twins for "reference"."""
    try:
        return _KERNELS[name]
    except (KeyError, TypeError):
        raise ValueError(f"kernels: expected 'native' or 'reference', got {name!r}") from None
