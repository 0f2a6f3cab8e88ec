# SPDX-License-Identifier: MIT
"""Strategies for values that nobody expects: arrays of any type, shape and stride, numbers from the edges."""

from typing import Any

import numpy as np
from hypothesis import strategies as st
from numpy.typing import NDArray

from tests.fuzz.mutations import FLOATS, INTS, OTHERS

DTYPES = ["u1", "i1", "u2", "i4", "i8", "f2", "f4", "f8", "c8", "?", ">f4", ">u2", "O"]
SIDES = st.sampled_from([0, 1, 2, 3, 7, 16, 33, 96])

numbers = st.sampled_from([*FLOATS, *INTS]) | st.floats() | st.integers()
scalars = numbers | st.sampled_from([*OTHERS, "1", "nan", True, np.float32(2), np.int8(-3), np.array(4.0)])
anything = scalars | st.lists(scalars, max_size=5) | st.lists(numbers, max_size=5).map(tuple)


@st.composite
def edge_arrays(draw: st.DrawFn, dtypes: list[str] | None = None, dimensions: int | None = None) -> Any:
    """An array of any type and up to four dimensions, filled with edges, laid out in any way."""
    dtype = np.dtype(draw(st.sampled_from(dtypes or DTYPES)))
    count = draw(st.integers(0, 4)) if dimensions is None else dimensions
    shape = tuple(draw(st.lists(SIDES, min_size=count, max_size=count)))
    if count >= 3 and draw(st.booleans()):
        shape = (*shape[:2], 3, *shape[3:])
    with np.errstate(all="ignore"):
        array = _filled(draw, shape, dtype)
    return _laid_out(draw, array)


def _filled(draw: st.DrawFn, shape: tuple[int, ...], dtype: np.dtype[Any]) -> NDArray[Any]:
    """Noise, one value everywhere, or some edges in a plane of one value."""
    seed = draw(st.integers(0, 2**32 - 1))
    random = np.random.default_rng(seed)
    if draw(st.booleans()):
        array = random.integers(0, 256, shape).astype(dtype)
    else:
        array = np.full(shape, draw(st.sampled_from([0, 1, 2, 100]))).astype(dtype)
    if array.size and dtype.kind in "fc":
        places = random.integers(0, array.size, draw(st.integers(0, 3)))
        array.reshape(-1)[places] = draw(st.sampled_from(FLOATS))
    return array


def _laid_out(draw: st.DrawFn, array: NDArray[Any]) -> NDArray[Any]:
    layout = draw(st.sampled_from(["C", "F", "step", "back", "frozen", "repeated"]))
    if array.ndim == 0 or layout == "C":
        return array
    if layout == "F":
        return np.asfortranarray(array)
    if layout == "step":
        return np.repeat(array, 2, 0)[::2]
    if layout == "back":
        return array[::-1]
    if layout == "frozen":
        array.flags.writeable = False
        return array
    return np.broadcast_to(array[:1], array.shape) if array.shape[0] else array


def images(channel: str) -> st.SearchStrategy[Any]:
    """Mostly what a channel may have, at times anything."""
    right = {"color": ("u1", 3), "right": ("u1", 3), "depth": ("f4", 2)}[channel]
    plausible = edge_arrays([right[0]], right[1])
    return st.one_of(plausible, plausible, edge_arrays(), scalars)
