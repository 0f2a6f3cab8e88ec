# SPDX-License-Identifier: MIT
"""A gray picture of a depth image, in which a target at one depth looks the same at any distance."""

from typing import Any

import cv2
import numpy as np
import pytest
from numpy.testing import assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference
from tricue.kernels import Kernels

Depth = NDArray[np.float32]


@pytest.mark.parametrize(("z", "reach"), [(2.6, 0.5), (0.01, 3.0), (-1.0, 0.003), (1e-30, 1e6)])
def test_native_is_the_twin(picture: Depth, z: float, reach: float) -> None:
    """Both have the same bits on any picture: they do the same operations in the same order."""
    native, twin = _core.depth_picture(picture, z, reach), reference.depth_picture(picture, z, reach)
    assert native.dtype == twin.dtype == np.uint8
    assert native.shape == picture.shape
    assert_array_equal(native, twin)


def test_is_opencvs_linear_scaling(kernels: Kernels) -> None:
    """It is OpenCV's convertScaleAbs of the clipped depth, to the level that that rounds differently."""
    depth = np.random.default_rng(0).uniform(0.5, 4, (30, 41)).astype(np.float32)
    scaled = cv2.convertScaleAbs(np.clip(depth, 1.5, 2.5), alpha=254, beta=128 - 254 * 2.0)
    found = kernels.depth_picture(depth, 2.0, 0.5).astype(int)
    assert np.abs(found - scaled).max() <= 1


def test_by_hand(kernels: Kernels) -> None:
    """Gray at the target's depth, black from reach nearer on, white from as much farther on and where nothing
    is measured, in between in proportion.
    """
    depth = np.array([[2.0, 1.0, 1.75, 2.5, 9.0, np.nan, np.inf]], np.float32)
    levels = kernels.depth_picture(depth, 2.0, 0.5)
    assert levels[0].tolist() == [128, 1, 64, 255, 255, 255, 255]


def test_does_not_depend_on_the_distance(kernels: Kernels) -> None:
    """The same surface at another distance is the same picture, to a level."""
    surface = np.random.default_rng(0).uniform(-0.6, 0.6, (20, 30)).astype(np.float32)
    near, far = (kernels.depth_picture(surface + np.float32(z), z, 0.5).astype(int) for z in (1.0, 6.0))
    assert np.abs(near - far).max() <= 1


def test_brightens_with_distance(kernels: Kernels) -> None:
    """What is farther is never darker."""
    levels = kernels.depth_picture(np.linspace(0.01, 9, 500, dtype=np.float32)[None], 2.0, 0.5)[0]
    assert (np.diff(levels.astype(int)) >= 0).all()


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"z": np.nan}, "z: expected a finite number, got nan"),
        ({"z": np.inf}, "z: expected a finite number, got inf"),
        ({"reach": 0.0}, "reach: expected a finite number above 0, got 0"),
        ({"reach": np.inf}, "reach: expected a finite number above 0, got inf"),
    ],
)
def test_refuses(kernels: Kernels, changes: dict[str, Any], message: str) -> None:
    """Numbers out of range are named, with what was expected."""
    with pytest.raises(ValueError, match=message):
        kernels.depth_picture(**{"depth": np.ones((4, 5), np.float32), "z": 2.0, "reach": 0.5} | changes)


def test_native_refuses_other_arrays() -> None:
    """Other numbers are named, never converted."""
    with pytest.raises(TypeError, match="depth: expected a float32 depth image"):
        _core.depth_picture(np.ones((4, 5)), 2.0, 0.5)  # type: ignore[arg-type]
