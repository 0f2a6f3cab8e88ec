# SPDX-License-Identifier: MIT
"""Segmented objects in meters, standing on the floor."""

from typing import Any

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference
from tricue.kernels import Kernels

from tests.kernel_arguments import grouped

Floats = NDArray[np.float64]
Case = dict[str, Any]
PARTS = {"objects": ("table", "columns", "rows", "cut"), "ground": ("plane", "feet")}
EPS = float(np.finfo(np.float64).eps)
CAMERA = np.array([190.0, 192.0, 87.0, 70.5])
NO_FLOOR = np.zeros(4)
FEET = 0.35
X, Y, Z, WIDTH, HEIGHT, SHIFT_X, SHIFT_Y, AREA = range(8)
BOTTOM = 3


def case(count: int, bins: int = 16, seed: int = 0, **changes: Any) -> Case:
    """All values, those in tuples one by one: boxes of whole pixels, 1 to 6 m away, some cut, on a floor that
    is all but level.
    """
    rng = np.random.default_rng(seed)
    table = np.empty((count, 7))
    table[:, :2] = rng.integers(0, 170, (count, 2))
    table[:, 2:4] = rng.integers(1, 140, (count, 2))
    table[:, 4] = np.ceil(table[:, 2] * table[:, 3] * rng.uniform(0.3, 1, count))
    table[:, 5], table[:, 6] = rng.uniform(1, 6, count), 1
    up = np.array([0.1, -1, 0.1]) + rng.normal(0, 0.05, 3)
    up /= np.linalg.norm(up)
    arguments: Case = {
        "table": table,
        "columns": spread(rng, count, bins),
        "rows": spread(rng, count, bins),
        "cut": rng.random((count, 4)) < 0.2,
        "camera": CAMERA,
        "plane": np.array([*up, rng.uniform(0.5, 2)]),
        "feet": FEET,
    }
    return arguments | changes


def spread(rng: np.random.Generator, count: int, bins: int) -> NDArray[np.float32]:
    """(count, bins) shares of sum 1."""
    shares = rng.dirichlet(np.ones(bins), count) if bins else np.empty((count, 0))
    return shares.astype(np.float32)


def assert_same(arguments: Case) -> None:
    """Lengths here are below 32 m. A centroid is a sum over the bins, a height over the floor one of four, of
    products that are rounded four times, divided by a tenth at least: ten times as wrong; all else is rounded
    less.
    """
    native, twin = (measured(k, **arguments) for k in (_core, reference))
    assert native.shape == twin.shape == (len(arguments["table"]), 8)
    rounding = (arguments["columns"].shape[1] + 10 * (4 + 4)) * EPS
    assert_allclose(native, twin, rtol=rounding, atol=32 * rounding)


@given(
    st.integers(0, 2**32),
    st.integers(0, 12),
    st.integers(0, 70),
    st.floats(0, 3),
)
def test_twin_measures_the_same(seed: int, count: int, bins: int, feet: float) -> None:
    """Native and reference agree for any number of objects and bins, with a floor and without."""
    arguments = case(count, bins, seed, feet=feet)
    assert_same(arguments)
    assert_same(arguments | {"plane": NO_FLOOR})


@pytest.mark.parametrize(
    "plane", [[0, 0, -1, 3.0], [0, 1, 0, 0.2], [0.6, -0.05, 0.8, -2], [0, 0, 0, 0.2]], ids=str
)
def test_twin_measures_the_same_on_odd_planes(plane: list[float]) -> None:
    """They agree on planes that aren't level, that are upside down, and whose normal is none."""
    assert_same(case(200, plane=np.array(plane, float)))


def test_some_stand() -> None:
    """The cases above are no idle ones: some objects stand on the floor, others don't."""
    arguments = case(200)
    stand = (measured(**arguments) != measured(**arguments | {"plane": NO_FLOOR}))[:, HEIGHT]
    assert 0.05 < stand.mean() < 0.95


def measured(kernels: Any = reference, **arguments: Any) -> Floats:
    """(C, 8), by the reference unless told."""
    objects: Floats = kernels.measure_objects(**grouped(arguments, PARTS))
    return objects


def test_agrees_with_projection(kernels: Kernels) -> None:
    """Boxes in space whose corners OpenCV projects into the image come back, to rounding."""
    rng = np.random.default_rng(1)
    centers = np.column_stack([rng.uniform(-2, 2, (50, 2)), rng.uniform(1, 6, 50)])
    sizes = rng.uniform(0.1, 2, (50, 2))
    fx, fy, cx, cy = CAMERA
    half = np.column_stack([sizes / 2, np.zeros(50)])
    corners, matrix = (
        np.concatenate([centers - half, centers + half]),
        np.array([[fx, 0, cx], [0, fy, cy], [0, 0, 1]]),
    )
    pixels, _ = cv2.projectPoints(corners, np.zeros(3), np.zeros(3), matrix, None)
    first, last = pixels[:50, 0] + 0.5, pixels[50:, 0] + 0.5  # box coordinates: pixel 0 begins at 0
    arguments = case(50, plane=NO_FLOOR)
    arguments["table"] = np.column_stack([first, last - first, np.ones(50), centers[:, 2], np.ones(50)])
    found = measured(kernels, **arguments)
    assert_allclose(found[:, :SHIFT_X], np.column_stack([centers, sizes]), rtol=0, atol=1e-12)


@pytest.mark.parametrize("seed", range(3))
def test_agrees_with_points(kernels: Kernels, seed: int) -> None:
    """Of a shape at one depth, a bin a pixel, centroid and area are those of its pixels, back-projected by
    the inverse of the camera's matrix; shares are float32.
    """
    rng = np.random.default_rng(seed)
    shape = cv2.blur(rng.random((40, 40)), (7, 7)) > 0.5
    rows, columns = np.flatnonzero(shape.any(axis=1)), np.flatnonzero(shape.any(axis=0))
    inside = shape[rows[0] : rows[-1] + 1, columns[0] : columns[-1] + 1]
    count, z = np.count_nonzero(inside), 2.5
    table = np.array([[columns[0], rows[0], inside.shape[1], inside.shape[0], count, z, 1]], float)
    shares = [(inside.sum(axis=axis)[None] / count).astype(np.float32) for axis in (0, 1)]
    arguments = case(1, table=table, columns=shares[0], rows=shares[1], plane=NO_FLOOR)
    (found,) = measured(kernels, **arguments)
    fx, fy, cx, cy = CAMERA
    v, u = np.nonzero(shape)
    points = (
        np.column_stack([u, v, np.ones(count)]) @ np.linalg.inv([[fx, 0, cx], [0, fy, cy], [0, 0, 1]]).T * z
    )
    rounding = 40 * float(np.finfo(np.float32).eps)
    assert_allclose(
        found[[X, Y]] + found[[SHIFT_X, SHIFT_Y]], points[:, :2].mean(axis=0), rtol=0, atol=rounding
    )
    assert_allclose(found[AREA], count * (z / fx) * (z / fy), rtol=4 * EPS)


@pytest.mark.parametrize("seed", range(5))
def test_feet_are_on_the_floor(kernels: Kernels, seed: int) -> None:
    """What stands ends where the camera sees its feet: below the point of its lower edge's ray that is as far
    along the ground as its center, on the plane. Heads, sides and depths stay.
    """
    arguments = case(200, seed=seed)
    before, after = (measured(kernels, **arguments | floor) for floor in ({"plane": NO_FLOOR}, {}))
    strip = after[:, HEIGHT] - before[:, HEIGHT]
    stand = strip > 0
    assert 5 < np.count_nonzero(stand) < 195
    low = after[:, Y] + after[:, HEIGHT] / 2
    up, distance = arguments["plane"][:3], arguments["plane"][3]
    ahead = np.cross(up, np.cross([0.0, 0.0, 1.0], up))  # along the ground
    for i in np.flatnonzero(stand):
        ray = np.array([before[i, X], before[i, Y] + before[i, HEIGHT] / 2, before[i, Z]])
        # The point t ray, and the height h above the floor: t ray - h up is on the plane.
        t = (ahead @ before[i, [X, Y, Z]]) / (ahead @ ray)
        feet = t * ray - (up @ (t * ray) + distance) * up
        assert abs(up @ feet + distance) < 1e-12
        assert up @ (t * ray) + distance < FEET
        assert_allclose(low[i] / after[i, Z], feet[1] / feet[2], atol=1e-12)
    head = before[:, Y] - before[:, HEIGHT] / 2
    assert_allclose(after[:, Y] - after[:, HEIGHT] / 2, head, atol=1e-12)
    assert_array_equal(np.delete(after, [Y, HEIGHT, SHIFT_Y], 1), np.delete(before, [Y, HEIGHT, SHIFT_Y], 1))
    assert not arguments["cut"][stand, BOTTOM].any()


@pytest.mark.parametrize("tilt", [-0.2, 0.0, 0.3, 0.5])
@pytest.mark.parametrize("lost", [0, 6])
def test_centroid_of_an_upright_board(kernels: Kernels, tilt: float, lost: int) -> None:
    """In front of a tilted camera it is the mean of its pixels' points, also of those that were removed with
    the floor: to rounding if none were, else to the rows that the floor cuts.
    """
    sin, cos = np.sin(tilt), np.cos(tilt)
    up, ahead = np.array([0.0, -cos, -sin]), np.array([0.0, -sin, cos])
    fx, fy, cx, cy = CAMERA
    first, last, columns = 30, 120, np.arange(60, 81)
    u, v = np.meshgrid(columns, np.arange(first, last))
    rays = np.stack([(u - cx) / fx, (v - cy) / fy, np.ones(u.shape)], axis=-1)
    points = rays * (2.5 / (rays @ ahead))[..., None]
    height = -points[-1, 0] @ up + (points[-2, 0] - points[-1, 0]) @ up / 2
    kept = points[: len(points) - lost]
    rows = np.full((1, len(kept)), 1 / len(kept), np.float32)
    table = np.array([[60.0, first, 21, len(kept), kept[..., 0].size, kept[..., 2].mean(), 1]])
    arguments = case(1, table=table, rows=rows, columns=np.ones((1, 1), np.float32))
    arguments |= {"plane": np.array([*up, height]), "cut": np.array([[False, False, False, lost == 0]])}
    (found,) = measured(kernels, **arguments)
    atol = 1e-6 if lost == 0 else 5e-3
    assert_allclose(found[Y] + found[SHIFT_Y], points[..., 1].mean(), rtol=0, atol=atol)


def test_example_by_hand(kernels: Kernels) -> None:
    """Two meters away a pixel of 1/64 m: a box of 32 x 64 pixels is 0.5 x 1 m, and ends at y = 0.75. With the
    floor at 1 m it grows by 0.25 m, and evenly filled it has its centroid in the middle.
    """
    camera = np.array([128.0, 128.0, 15.5, 15.5])
    table = np.array([[0.0, 0.0, 32, 64, 1024, 2, 1]])
    columns, rows = np.float32([[0.25, 0.75]]), np.float32([[0.5, 0.5]])
    plane, cut = np.array([0, -1.0, 0, 1]), np.zeros((1, 4), np.bool_)
    objects = table, columns, rows, cut
    bare = kernels.measure_objects(objects, camera, (NO_FLOOR, 0.35))
    assert_array_equal(bare, [[0, 0.25, 2, 0.5, 1, 0.0625, 0, 0.25]])
    stands = kernels.measure_objects(objects, camera, (plane, 0.35))
    assert_allclose(stands, [[0, 0.375, 2, 0.5, 1.25, 0.0625, 0, 0.25]], rtol=4 * EPS, atol=EPS)
    for hovers in (
        kernels.measure_objects(objects, camera, (plane, 0.25)),
        kernels.measure_objects((table, columns, rows, ~cut), camera, (plane, 0.35)),
    ):
        assert_array_equal(hovers, bare)


def test_below_the_floor(kernels: Kernels) -> None:
    """What ends on the floor or below it stays as it is."""
    arguments = case(40, plane=np.array([0, -1.0, 0, -5]))
    above, without = (measured(kernels, **arguments | floor) for floor in ({}, {"plane": NO_FLOOR}))
    assert_allclose(above, without, rtol=0, atol=1e-6)  # shares in float32 don't have a sum of 1


@given(st.integers(0, 2**32))
def test_twice_as_far(seed: int) -> None:
    """Twice as far away everything is twice as large, the area four times, floor and feet included; doubling
    rounds nothing.
    """
    arguments = case(20, seed=seed)
    twice = arguments | {"table": arguments["table"] * [1, 1, 1, 1, 1, 2, 1], "feet": 2 * FEET}
    twice["plane"] = arguments["plane"] * [1, 1, 1, 2]
    for kernels in (_core, reference):
        near, far = measured(kernels, **arguments), measured(kernels, **twice)
        assert_array_equal(far, near * [2, 2, 2, 2, 2, 2, 2, 4])


@given(st.integers(0, 2**32))
def test_each_by_itself(seed: int) -> None:
    """An object is measured alike alone, and in any order; inputs stay as they are."""
    arguments = case(6, seed=seed)
    order = np.random.default_rng(seed).permutation(6)
    of_each = ("table", "columns", "rows", "cut")
    before = {name: arguments[name].copy() for name in of_each}
    for kernels in (_core, reference):
        together = measured(kernels, **arguments)
        alone = [
            measured(kernels, **arguments | {name: arguments[name][[i]] for name in of_each})[0]
            for i in order
        ]
        # The twin's products, by BLAS, may be added in another order.
        assert_allclose(alone, together[order], rtol=20 * EPS, atol=0 if kernels is _core else 1e-13)
    for name in of_each:
        assert_array_equal(arguments[name], before[name])


TWO = case(2)
BAD_VALUES: list[tuple[str, Any, str]] = [
    ("table", TWO["table"][:, :6].copy(), r"table: expected shape \(2, 7\), got \(2, 6\)"),
    ("table", TWO["table"] * np.nan, "table: expected finite numbers, got nan"),
    ("table", TWO["table"] * [1, 1, 1, 1, 1, 0, 1], "table: expected depths above 0, got 0"),
    ("table", TWO["table"] * [1, 1, 0, 1, 1, 1, 1], "table: expected sizes above 0, got 0"),
    ("columns", TWO["columns"][:1], "columns: expected 2 rows, got 1"),
    ("rows", TWO["rows"][:0], "rows: expected 2 rows, got 0"),
    ("cut", np.zeros((3, 4), np.bool_), "cut: expected 2 rows, got 3"),
    ("columns", TWO["columns"] * np.float32(np.nan), "columns: expected finite numbers, got nan"),
    ("rows", TWO["rows"] - np.float32(np.inf), "rows: expected finite numbers, got -inf"),
    ("camera", CAMERA[:3], r"camera: expected shape \(4,\), got \(3,\)"),
    ("camera", CAMERA * np.inf, "camera: expected finite numbers, got inf"),
    ("camera", CAMERA * [1, 0, 1, 1], "camera: expected focal lengths above 0, got 0"),
    ("plane", NO_FLOOR[:3], r"plane: expected shape \(4,\), got \(3,\)"),
    ("plane", NO_FLOOR * np.nan, "plane: expected finite numbers, got nan"),
    ("feet", -0.1, "feet: expected a finite number, not negative, got -0.1"),
    ("feet", np.inf, "feet: expected a finite number, not negative, got inf"),
]


@pytest.mark.parametrize(("name", "value", "message"), BAD_VALUES)
def test_refuses(kernels: Kernels, name: str, value: Any, message: str) -> None:
    """Tables, shares, cameras, planes and limits that are none, or don't belong together, are named."""
    with pytest.raises(ValueError, match=message):
        measured(kernels, **case(2, **{name: value}))


BAD: list[tuple[str, Any, type[Exception], str]] = [
    ("table", TWO["table"].astype(np.float32), TypeError, r"table: expected float64 \(N, D\), got float32"),
    (
        "columns",
        TWO["columns"].astype(float),
        TypeError,
        r"columns: expected float32 \(C, bins\), got float64",
    ),
    ("rows", TWO["rows"][0], ValueError, r"rows: expected float32 \(C, bins\), got float32 \(16,"),
    ("rows", TWO["rows"][:, ::2], ValueError, "rows: expected a C-contiguous"),
    ("cut", TWO["cut"].view(np.uint8), TypeError, r"cut: expected bool \(C, 4\), got uint8"),
    ("cut", TWO["cut"][:, :3], ValueError, r"cut: expected bool \(C, 4\), got bool \(2, 3"),
    ("cut", np.zeros((2, 8), np.bool_)[:, ::2], ValueError, "cut: expected a C-contiguous"),
    ("plane", None, TypeError, "plane: expected a NumPy array"),
]


@pytest.mark.parametrize(("name", "value", "error", "message"), BAD)
def test_native_refuses_other_arrays(name: str, value: Any, error: type[Exception], message: str) -> None:
    """Another type, shape or layout is named, not converted."""
    with pytest.raises(error, match=message):
        measured(_core, **case(2, **{name: value}))
