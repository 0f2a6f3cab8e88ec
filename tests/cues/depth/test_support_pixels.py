# SPDX-License-Identifier: MIT
"""The plane around a target, in depths whose planes are known."""

from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference
from tricue.kernels import Kernels

from tests.kernel_arguments import Place, with_argument

Depth = NDArray[np.float32]
Floats = NDArray[np.float64]

SHAPE = (300, 400)
LENS = np.array([340.0, 342.0, 199.5, 149.5])
SIDE, STEP, Z = 64, 3.0, 2.0
GRID = (104.0, 54.0, STEP, SIDE, SIDE)  # around the camera's middle
BOX = (21.0, 21.0)
TARGET = slice(22, 42)
TOLERANCE = 0.03
DRAWS = np.random.default_rng(0).random((64, 3))


def plane(below: float = 0.0, across: float = 0.0, z: float = Z) -> Depth:
    """(300, 400) depths of a plane, z in the middle; below, across: change of 1/z along the grid's side."""
    v, u = np.mgrid[: SHAPE[0], : SHAPE[1]]
    down, right = (v + 0.5 - SHAPE[0] / 2) / (SIDE * STEP), (u + 0.5 - SHAPE[1] / 2) / (SIDE * STEP)
    return (z / (1 + below * down + across * right)).astype(np.float32)


def with_target(depth: Depth, z: float) -> Depth:
    """The same with a square of the grid's TARGET at another depth."""
    rows, columns = (
        slice(int(start + STEP * TARGET.start), int(start + STEP * TARGET.stop)) for start in (54, 104)
    )
    depth = depth.copy()
    depth[rows, columns] = z
    return depth


def case(
    depth: Depth,
    grid: tuple[Any, ...] = GRID,
    target: tuple[float, float, float] = (*BOX, Z),
    camera: Floats = LENS,
    tolerance: float = TOLERANCE,
) -> list[Any]:
    """Arguments for a target in the middle of the picture."""
    return [depth, grid, target, camera, DRAWS, tolerance]


def outside() -> NDArray[np.bool_]:
    """The grid's squares around the target."""
    mask = np.ones((SIDE, SIDE), bool)
    mask[TARGET, TARGET] = False
    return mask


SLANTS = [(0.4, 0.0), (-0.3, 0.2), (0.0, 0.5), (0.0, 0.0)]


@pytest.mark.parametrize("slant", SLANTS, ids=str)
@pytest.mark.parametrize(("rows", "columns"), [(64, 64), (33, 33), (24, 24), (64, 33), (25, 40)])
def test_twin_finds_the_same(slant: tuple[float, float], rows: int, columns: int) -> None:
    """Native and reference agree on noisy planes with holes, but for the squares whose distance from the
    plane is nearer to the tolerance than the planes' last bits tell: none here.
    """
    rng = np.random.default_rng(1)
    depth = with_target(plane(*slant), 0.9 * Z) + rng.normal(0, 0.01, SHAPE).astype(np.float32)
    depth[rng.random(SHAPE) < 0.2] = np.nan
    step = STEP * SIDE / max(rows, columns)
    side = 21 * STEP / step
    grid = 200 - step * columns / 2, 150 - step * rows / 2, step, rows, columns
    arguments = case(depth, grid, (side, side, Z))
    native = _core.support_pixels(*arguments)
    assert native.any()
    assert_array_equal(native, reference.support_pixels(*arguments), strict=True)


@pytest.mark.parametrize("z", [0.3, 2.5, 40.0])
def test_twin_finds_the_same_in_pictures(picture: Depth, z: float) -> None:
    """They also agree on pictures of awkward sizes and layouts, with strange depths, in grids that reach
    beyond them.
    """
    for shape in ((41, 41), (17, 60), (1, 300), (300, 2)):
        arguments = case(picture, (-7.3, -5.1, 1.3, *shape), (*BOX, z), tolerance=0.4)
        assert_array_equal(
            _core.support_pixels(*arguments), reference.support_pixels(*arguments), strict=True
        )


@pytest.mark.parametrize("slant", SLANTS, ids=str)
def test_finds_the_plane(kernels: Kernels, slant: tuple[float, float]) -> None:
    """Every square of a slanted plane with noise of 3 mm, and none of the target 10 cm before it."""
    noise = np.random.default_rng(2).normal(0, 0.003, SHAPE).astype(np.float32)
    found = kernels.support_pixels(*case(with_target(plane(*slant), 0.9 * Z) + noise))
    assert found[outside()].mean() > 0.99
    assert not found[~outside()].any()


def test_is_as_near_as_the_tolerance(kernels: Kernels) -> None:
    """Squares 0.8 tolerances before the plane are on it, those 1.2 tolerances before it aren't."""
    depth = with_target(plane(), 0.9 * Z)
    for row, share in ((5, 0.8), (9, 1.2)):
        depth[int(54 + STEP * (row + 0.5)), int(104 + STEP * 5.5)] = Z - share * TOLERANCE
    found = kernels.support_pixels(*case(depth))
    assert found[5, 5] == 1
    assert found[9, 5] == 0


def test_a_target_as_flat_as_the_plane_is_kept(kernels: Kernels) -> None:
    """Nothing where the target is of the plane: a poster. But all of it where it stands before it."""
    assert not kernels.support_pixels(*case(plane(0.4))).any()
    assert kernels.support_pixels(*case(with_target(plane(0.4), 0.8 * Z))).any()


def test_no_plane(kernels: Kernels) -> None:
    """Nothing among scattered depths, at twice the target's depth, and with fewer than 60 votes."""
    scattered = np.random.default_rng(3).uniform(1, 3, SHAPE).astype(np.float32)
    assert not kernels.support_pixels(*case(scattered)).any()
    for times, any_support in ((1.9, True), (2.1, False)):
        wall = with_target(plane(z=times * Z), Z)
        assert kernels.support_pixels(*case(wall)).any() == any_support
    for rows, any_support in ((3, True), (2, False)):  # the first and the third vote, 32 squares each
        few = np.full(SHAPE, np.nan, np.float32)
        few[54 : 54 + int(STEP) * rows] = Z
        assert kernels.support_pixels(*case(few)).any() == any_support


def test_what_is_not_measured_is_not_on_it(kernels: Kernels) -> None:
    """Holes, infinite depths and what is beyond the image aren't the plane's."""
    depth, rng = with_target(plane(0.3), 0.9 * Z), np.random.default_rng(4)
    holes, cut = rng.random(SHAPE) < 0.2, 140
    depth[holes] = np.where(rng.random(holes.sum()) < 0.5, np.nan, np.inf)
    grid, camera = (104.0 - cut, *GRID[1:]), LENS - [0, 0, cut, 0]
    found = kernels.support_pixels(*case(depth[:, cut:], grid, camera=camera))
    rows, columns = ((start + STEP * (np.arange(SIDE) + 0.5)).astype(int) for start in (54, 104))
    measured = ~holes[np.ix_(rows, columns)] & (columns >= cut)
    assert not found[~measured].any()
    assert found[measured & outside()].mean() > 0.99


@pytest.mark.parametrize("box", [(0.1, 60.0), (60.0, 0.1)], ids=str)
def test_boxes_of_any_shape(kernels: Kernels, box: tuple[float, float]) -> None:
    """Two rows or columns at least are the target's, however thin it is: they don't vote."""
    depth = plane(0.4)
    rows, columns = (slice(32 - round(n / 2) - 1, 33 + round(n / 2)) for n in box[::-1])
    depth[54 + 3 * rows.start : 54 + 3 * rows.stop, 104 + 3 * columns.start : 104 + 3 * columns.stop] = 1.6
    found = kernels.support_pixels(*case(depth, target=(*box, Z)))
    assert found.any()
    assert not found[rows, columns].any()


BAD: list[tuple[Place, Any, str]] = [
    ((1, 0), np.nan, "x0: expected a finite number, got nan"),
    ((1, 1), np.inf, "y0: expected a finite number, got inf"),
    ((1, 2), 0.0, "step: expected a finite number above 0, got 0"),
    ((1, 3), 0, "rows: expected 1 to 4096, got 0"),
    ((1, 4), 4097, "columns: expected 1 to 4096, got 4097"),
    ((2, 0), 0.0, "width: expected a finite number above 0, got 0"),
    ((2, 1), np.inf, "height: expected a finite number above 0, got inf"),
    ((2, 2), -1.0, "z: expected a finite number above 0, got -1"),
    (3, np.ones(3), "camera: expected "),
    (3, np.array([0.0, 1, 1, 1]), "camera: expected focal lengths above 0, got 0"),
    (4, np.zeros((4, 2)), r"draws: expected shape \(4, 3\), got \(4, 2\)"),
    (4, np.ones((1, 3)), r"draws: expected numbers in \[0, 1\), got 1"),
    (4, np.full((1, 3), np.nan), r"draws: expected numbers in \[0, 1\), got nan"),
    (5, 0.0, "tolerance: expected a finite number above 0, got 0"),
]


@pytest.mark.parametrize(("place", "value", "message"), BAD)
def test_refuses(kernels: Kernels, place: Place, value: Any, message: str) -> None:
    """Numbers out of range are named, with what was expected."""
    with pytest.raises(ValueError, match=message):
        kernels.support_pixels(*with_argument(case(plane()), place, value))


def test_native_refuses_other_arrays() -> None:
    """Other numbers are named, never converted."""
    with pytest.raises(TypeError, match="depth: expected a float32 depth image"):
        _core.support_pixels(*case(plane().astype(np.float64)))
