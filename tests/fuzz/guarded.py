# SPDX-License-Identifier: MIT
"""Arrays between pages that must not be touched: who reads or writes beyond one gets a segmentation fault."""

import ctypes
import mmap
import weakref
from typing import Any

import numpy as np
from numpy.typing import NDArray

PAGE = mmap.PAGESIZE
_PROT_NONE, _PROT_READ, _PROT_READ_WRITE = 0, 1, 3
_libc = ctypes.CDLL(None, use_errno=True)
_libc.mmap.restype = ctypes.c_void_p
_libc.mmap.argtypes = [ctypes.c_void_p, ctypes.c_size_t] + [ctypes.c_int] * 3 + [ctypes.c_long]
_libc.mprotect.argtypes = [ctypes.c_void_p, ctypes.c_size_t, ctypes.c_int]
_libc.munmap.argtypes = [ctypes.c_void_p, ctypes.c_size_t]


def guarded(array: NDArray[Any], at_end: bool = True) -> NDArray[Any]:
    """A C-contiguous, read-only copy; beside its last byte, or its first, is a page that can't be touched."""
    array = np.ascontiguousarray(array)
    pages = max(-(-array.nbytes // PAGE), 1) * PAGE
    start = _libc.mmap(None, pages + 2 * PAGE, _PROT_NONE, mmap.MAP_PRIVATE | mmap.MAP_ANONYMOUS, -1, 0)
    if start in (None, ctypes.c_void_p(-1).value):
        raise MemoryError(f"mmap of {pages} bytes")
    _libc.mprotect(start + PAGE, pages, _PROT_READ_WRITE)
    offset = pages - array.nbytes if at_end else 0
    raw = (ctypes.c_uint8 * array.nbytes).from_address(start + PAGE + offset)
    weakref.finalize(raw, _libc.munmap, start, pages + 2 * PAGE)
    copy = np.frombuffer(raw, np.uint8, array.nbytes).view(array.dtype).reshape(array.shape)
    copy[...] = array
    _libc.mprotect(start + PAGE, pages, _PROT_READ)
    copy.flags.writeable = False
    return copy
