# SPDX-License-Identifier: MIT
"""The part of a frame in which a target can be: one call for stages that have tests of their own."""

from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference
from tricue.kernels import Kernels

Depth = NDArray[np.float32]
Floats = NDArray[np.float64]
GAPS, SPACE, MARGIN = (0.06, 0.01, 0.06, 3), (0.3, 8.0, 0.12), 0.05


def arguments(depth: Depth, camera: Floats, **changes: Any) -> dict[str, Any]:
    """What the trackers pass, with some of it changed."""
    usual: dict[str, Any] = {
        "depth": depth,
        "step": 1,
        "gaps": GAPS,
        "camera": camera,
        "plane": np.zeros(4),
        "floor": (0.04, 2),
        "space": SPACE,
        "margin": MARGIN,
    }
    return usual | changes


def assert_same(values: dict[str, Any]) -> None:
    """Native and reference agree: all is float32 in one order, but for the shares, one quotient each."""
    native, twin = (k.find_foreground(**values) for k in (_core, reference))
    assert_array_equal(native[0], twin[0], strict=True)
    assert_allclose(native[1], twin[1], rtol=1e-15)
    assert native[2] == twin[2]


@pytest.mark.parametrize("step", [1, 2, 3, 2**31 - 1])
@pytest.mark.parametrize("max_gap_share", [0.0, 0.06, 1.0])
def test_twin_finds_the_same_in_pictures(
    picture: Depth, camera: Floats, step: int, max_gap_share: float
) -> None:
    """Native and reference agree on pictures of awkward sizes and layouts, thinned or not, filled or not."""
    assert_same(arguments(picture, camera, step=step, gaps=(0.06, 0.01, max_gap_share, 3)))


@pytest.mark.parametrize("passes", [0, 3])
def test_twin_finds_the_same_in_a_room(noisy_room: Depth, camera: Floats, floor: Floats, passes: int) -> None:
    """They also agree on a room with a tilted floor, which is taken out."""
    values = arguments(noisy_room, camera, plane=floor, gaps=(*GAPS[:3], passes))
    assert_same(values)
    kept, support, _ = _core.find_foreground(**values)
    assert np.isfinite(kept).sum() < np.isfinite(noisy_room).sum()
    assert support[0] > 0.1


@pytest.mark.parametrize("step", [1, 2])
def test_is_what_its_stages_are(noisy_room: Depth, camera: Floats, floor: Floats, step: int) -> None:
    """The native kernel returns what the native stages return, called one by one on the thinned image."""
    values = arguments(noisy_room, camera / step, plane=floor, step=step)
    filled = _core.fill_gaps(np.ascontiguousarray(noisy_room[::step, ::step]), *GAPS)
    kept, support, _ = _core.find_foreground(**values)
    assert_array_equal(kept, _core.above_floor(filled, camera / step, floor, *SPACE))
    assert_array_equal(support, _core.plane_support(filled, camera / step, floor, 0.04, 2))


@pytest.mark.parametrize("side", range(4))
def test_narrow_margins_were_not_measured(kernels: Kernels, camera: Floats, side: int) -> None:
    """Five of a hundred lines without depth at a side are a margin; six are the scene's own."""
    for lines in (0, 5, 6):
        depth = np.full((100, 100), 3.0, np.float32)
        turned = np.rot90(depth, side)
        turned[:lines] = np.nan
        *_, (x0, y0, x1, y1) = kernels.find_foreground(**arguments(depth, camera))
        gaps = sorted([x0, y0, 100 - x1, 100 - y1])
        assert gaps == [0, 0, 0, lines if lines < 6 else 0]


def test_nothing_measured(kernels: Kernels, camera: Floats) -> None:
    """Without any depth nothing is kept, nothing is on the floor, and the image has no margins."""
    depth = np.full((9, 12), np.nan, np.float32)
    kept, support, measured = kernels.find_foreground(**arguments(depth, camera))
    assert np.isnan(kept).all()
    assert (support.tolist(), measured) == ([0, 0], (0, 0, 12, 9))


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"step": 0}, "step: expected at least 1, got 0"),
        ({"margin": 1.5}, r"margin: expected a number in \[0, 1\], got 1.5"),
        ({"gaps": (-1.0, 0.0, 0.0, 0)}, "gap: expected a finite number, not negative, got -1"),
        ({"gaps": (1.0, 0.0, 2.0, 0)}, "max_gap_share: expected a share from 0 to 1, got 2"),
        ({"camera": np.ones(3)}, r"camera: expected shape \(4,\), got \(3,\)"),
        ({"plane": np.ones(3)}, r"plane: expected shape \(4,\), got \(3,\)"),
        ({"floor": (0.0, 1)}, "tolerance: expected a finite number above 0, got 0"),
        ({"space": (1.0, 0.5, 0.0)}, "far: expected a finite number above near, got 0.5"),
    ],
)
def test_refuses(kernels: Kernels, camera: Floats, changes: dict[str, Any], message: str) -> None:
    """Each stage names what it can't work with."""
    with pytest.raises(ValueError, match=message):
        kernels.find_foreground(**arguments(np.ones((9, 12), np.float32), camera) | changes)


def test_native_refuses_other_types(camera: Floats) -> None:
    """Another type is named, not converted."""
    with pytest.raises(TypeError, match=r"depth: expected a float32 depth image \(H, W\), got float64"):
        _core.find_foreground(**arguments(np.ones((9, 12)), camera))
