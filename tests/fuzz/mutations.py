# SPDX-License-Identifier: MIT
"""Changes of valid arguments: other types, shapes and strides, and values from the edges of their types."""

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tests.fuzz.guarded import guarded

Array = NDArray[Any]
Random = np.random.Generator

DTYPES = [np.uint8, np.int8, np.uint16, np.int32, np.int64, np.float32, np.float64, np.complex64, bool]
FLOATS = [0.0, -0.0, 1e-45, 2.3e-308, 1e-30, 0.5, 1.0, -1.0, 1e6, 2.0**31, 3.4e38, 3.5e38, 1e39, 1.7e308]
FLOATS += [-1e39, -1.7e308, np.inf, -np.inf, np.nan]
INTS = [-(2**63), -(2**31) - 1, -(2**31), -2, -1, 0, 1, 2, 3, 7, 255, 256, 65535, 65536]
INTS += [2**31 - 1, 2**31, 2**32, 2**63 - 1, 2**63, 10**400]
OTHERS = [None, "x", b"x", [], (), {}, 1j, object()]


def mutate(value: Any, random: Random) -> Any:
    """A value like this one, or not at all."""
    if isinstance(value, np.ndarray):
        return _mutate_array(value, random)
    if random.random() < 0.1:
        return pick(OTHERS, random)
    if isinstance(value, tuple) and value:
        at = int(random.integers(len(value)))
        return (*value[:at], mutate(value[at], random), *value[at + 1 :])
    if isinstance(value, bool | np.bool_):
        return not value
    if isinstance(value, int | np.integer):
        near = int(value) + int(random.integers(-3, 4))
        return near if random.random() < 0.4 else pick(INTS, random)
    if isinstance(value, float | np.floating):
        near = float(value) * float(random.normal(1, 1))
        return near if random.random() < 0.3 else pick(FLOATS, random)
    return pick(OTHERS, random)


def guard(value: Any, random: Random) -> Any:
    """The value; an array that is contiguous lies beside a page that can't be touched."""
    if isinstance(value, tuple):
        return tuple(guard(each, random) for each in value)
    if isinstance(value, np.ndarray) and value.flags.c_contiguous and not value.dtype.hasobject:
        return guarded(value, at_end=random.random() < 0.7)
    return value


def pick(values: list[Any], random: Random) -> Any:
    """One of the values."""
    return values[int(random.integers(len(values)))]


def _mutate_array(array: Array, random: Random) -> Any:
    if random.random() < 0.05:
        return pick(OTHERS, random)
    change = pick([*_CHANGES, _edge_values, _edge_values], random)
    return change(array, random)


def _edge_values(array: Array, random: Random) -> Array:
    """Some entries, or all, at the edge of the type."""
    changed = array.copy()
    if changed.size == 0:
        return changed
    count = pick([1, 1, 2, 5, changed.size], random)
    places = random.integers(0, changed.size, count)
    flat = changed.reshape(-1)
    kind = changed.dtype.kind
    with np.errstate(all="ignore"):
        if kind in "fc":
            flat[places] = [pick(FLOATS, random)] * count
        elif kind in "iu":
            info = np.iinfo(changed.dtype)
            flat[places] = pick([info.min, info.max, 0, 1, info.max // 2 + 1], random)
        else:
            flat[places] = pick([False, True], random)
    return changed


def _dtype(array: Array, random: Random) -> Array:
    with np.errstate(all="ignore"):
        return np.asarray(array.real if array.dtype.kind == "c" else array).astype(pick(DTYPES, random))


def _shape(array: Array, random: Random) -> Array:
    """One axis longer, shorter, empty, missing or more."""
    if array.ndim == 0:
        return array.reshape(1)
    axis = int(random.integers(array.ndim))
    size = array.shape[axis]
    kind = int(random.integers(6))
    if kind == 0:
        return np.take(array, range(max(size - 1, 0)), axis)
    if kind == 1:
        return np.take(array, [*range(size), *([size - 1] * (size > 0))], axis)
    if kind == 2:
        return np.take(array, range(int(random.integers(0, min(size, 3) + 1))), axis)
    if kind == 3:
        return np.expand_dims(array, axis)
    if kind == 4 and size > 0:
        return np.take(array, 0, axis)
    return array.reshape(-1)


def _strides(array: Array, random: Random) -> Array:
    """The same values, laid out in another way: every other one, backward, transposed, by columns."""
    kind = int(random.integers(5))
    if array.ndim == 0 or kind == 0:
        return np.asfortranarray(array)
    axis = int(random.integers(array.ndim))
    if kind == 1:
        return np.repeat(array, 2, axis)[(slice(None),) * axis + (slice(None, None, 2),)]
    if kind == 2:
        return np.flip(array, axis)
    if kind == 3:
        return array.T
    return np.broadcast_to(np.take(array, [0] * min(array.shape[axis], 1), axis), array.shape)


def _unaligned(array: Array, random: Random) -> Array:
    """The same values one byte off from where the type wants them."""
    raw = np.empty(array.nbytes + 1, np.uint8)
    view = raw[1:].view(array.dtype).reshape(array.shape)
    view[...] = array
    return view


def _swapped(array: Array, random: Random) -> Array:
    """In the other byte order."""
    return array.astype(array.dtype.newbyteorder())


_CHANGES: list[Callable[[Array, Random], Array]] = [_dtype, _shape, _shape, _strides, _unaligned, _swapped]
