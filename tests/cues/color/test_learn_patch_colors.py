# SPDX-License-Identifier: MIT
"""The colors of a target in the middle of a patch, and of its surround."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference
from tricue.kernels import Kernels

from tests.kernel_arguments import Place, with_argument

NONE: NDArray[np.float32] = np.empty((0, 0), np.float32)
lengths = st.floats(0, 80)


@given(
    st.integers(0, 2**32),
    st.integers(1, 40),
    st.integers(1, 40),
    lengths,
    lengths,
    st.floats(1, 3),
    st.booleans(),
)
def test_native_is_the_twin(
    seed: int, rows: int, columns: int, width: float, height: float, outer: float, with_other: bool
) -> None:
    """Both learn the same, to the last bit, for patches and boxes of any size."""
    rng = np.random.default_rng(seed)
    patch = rng.integers(0, 256, (rows, columns, 3), np.uint8)
    other = rng.random((rows, columns), np.float32) if with_other else NONE
    target, surround = rng.random((2, 4, 4, 4), np.float32)
    arguments = patch, other, (width, height, outer, 0.4, 0.1), target, surround, 0.3, 1e-4
    native, twin = _core.learn_patch_colors(*arguments), reference.learn_patch_colors(*arguments)
    for own, expected in zip(native, twin, strict=True):
        assert_array_equal(own, expected, strict=True)


def disc_and_ring() -> NDArray[np.uint8]:
    """(64, 64, 3): red in an ellipse of 30 x 20 pixels, green in the rest of its box, blue around."""
    y, x = np.indices((64, 64)) - 31.5
    patch = np.full((64, 64, 3), (255, 0, 0), np.uint8)
    patch[(abs(x) < 15) & (abs(y) < 10)] = 0, 255, 0
    patch[(x / 15) ** 2 + (y / 10) ** 2 <= 1] = 0, 0, 255
    return patch


PIXELS = 30.0, 20.0, 1.0, 0.4, 0.1  # of the ellipse
EMPTY = np.zeros((2, 2, 2), np.float32)


def test_learns_the_ellipse_and_what_is_outside_of_the_box(kernels: Kernels) -> None:
    """The target is as red as can be, its surround blue; the corners of the box count for neither."""
    found = kernels.learn_patch_colors(disc_and_ring(), NONE, PIXELS, EMPTY, EMPTY, 1.0, 1e-4)
    assert_allclose(found[0][0, 0, 1], 1)
    assert_allclose(found[1][1, 0, 0], 1)
    assert found[0].sum() == found[1].sum() == 1
    assert found[2][0, 0, 1] > 0.999


def test_a_color_that_neither_has_tells_nothing(kernels: Kernels) -> None:
    """Its posterior is 1/2; one that was seen once or twice is sure already."""
    target, surround = EMPTY.copy(), EMPTY.copy()
    target[0, 0, 0], surround[0, 0, 0], target[0, 0, 1], surround[0, 1, 0] = 1 - 1e-2, 1 - 1e-2, 1e-2, 1e-2
    table = kernels.learn_patch_colors(disc_and_ring(), NONE, PIXELS, target, surround, 0.0, 1e-4)[2]
    assert_array_equal(table[1], 0.5)
    assert_allclose(table[0], [[0.5, 0.995], [0.005, 0.5]], atol=1e-3)


def test_another_cue_takes_pixels_away(kernels: Kernels) -> None:
    """What is nearer or farther in the ellipse is the surround's, unless that is most of it."""
    patch = disc_and_ring()
    for share, own, around in ((0.3, 1.0, False), (0.7, 1.0, True)):
        other = np.ones((64, 64), np.float32)
        other[:, : int(17 + 30 * share)] = 0
        found = kernels.learn_patch_colors(patch, other, PIXELS, EMPTY, EMPTY, 1.0, 1e-4)
        assert found[0][0, 0, 1] == own
        assert (found[1][0, 0, 1] == 0) == around


def test_a_box_that_fills_the_patch(kernels: Kernels) -> None:
    """Where nothing is outside of the box, the surround is what is outside of the ellipse."""
    patch = np.zeros((8, 8, 3), np.uint8)
    patch[[0, 0, -1, -1], [0, -1, 0, -1]] = 255
    found = kernels.learn_patch_colors(patch, NONE, (8.0, 8.0, 2.0, 0.4, 0.1), EMPTY, EMPTY, 1.0, 1e-4)
    assert found[0][0, 0, 0] == 1
    assert 0 < found[1][1, 1, 1] < 1


@pytest.mark.parametrize(
    ("place", "value", "message"),
    [
        (1, np.zeros((8, 7), np.float32), "other: expected the patch's rows and columns, got 8, 7"),
        (1, np.zeros((8, 0), np.float32), "other: expected the patch's rows and columns, got 8, 0"),
        ((2, 0), -1.0, "width: expected a finite number, not negative, got -1"),
        ((2, 1), np.inf, "height: expected a finite number, not negative, got inf"),
        ((2, 2), 0.5, "min_surround_size: expected a finite number, at least 1, got 0.5"),
        ((2, 3), 2.0, r"min_target_posterior: expected a number in \[0, 1\], got 2"),
        ((2, 4), np.nan, r"max_surround_posterior: expected a number in \[0, 1\], got nan"),
        (4, np.zeros((4, 4, 4), np.float32), "surround: expected the target's shape"),
        (5, 2.0, r"rate: expected a number in \[0, 1\], got 2"),
        (6, 0.0, "rare: expected a number above 0, got 0"),
    ],
)
def test_refuses(kernels: Kernels, place: Place, value: Any, message: str) -> None:
    """Wrong shapes and values are named."""
    patch = np.zeros((8, 8, 3), np.uint8)
    arguments = patch, NONE, (4.0, 4.0, 1.1, 0.4, 0.1), EMPTY, EMPTY, 0.5, 1e-4
    with pytest.raises(ValueError, match=message):
        kernels.learn_patch_colors(*with_argument(arguments, place, value))
