# SPDX-License-Identifier: MIT
"""At which sides of its box an object may go on."""

from typing import Any

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference
from tricue.kernels import Kernels

from tests.kernel_arguments import Place, with_argument

Depth = NDArray[np.float32]
Floats = NDArray[np.float64]
Flags = NDArray[np.bool_]
BORDER, BESIDE, NEARER, SHARE = CUT = 2, 0.08, 0.3, 0.15
LEFT, RIGHT, TOP, BOTTOM = range(4)
PLACES = 12

# Twelfths, the numbers right below and above them, and any others.
TWELFTHS = np.arange(PLACES + 1) / PLACES
shares = st.sampled_from(
    np.clip([np.nextafter(TWELFTHS, -1), TWELFTHS, np.nextafter(TWELFTHS, 2)], 0, 1).ravel()
)
shares |= st.floats(0, 1)


def row(x: float, y: float, width: float, height: float, z: float) -> list[float]:
    """One object of depth_components' table."""
    return [float(each) for each in (x, y, width, height, width * height, z, 1)]


def boxes(shape: tuple[int, ...], count: int, seed: int) -> Floats:
    """(count, 7) boxes of whole pixels in an image, across its border and outside, 1 to 6 m away."""
    rng = np.random.default_rng(seed)
    height, width = shape
    corners = rng.integers([-9, -9], [width + 9, height + 9], (count, 2))
    sizes, z = rng.integers(1, 50, (count, 2)), rng.uniform(1, 6, count)
    return np.array(
        [row(*corner, *size, far) for corner, size, far in zip(corners, sizes, z, strict=True)]
    ).reshape(-1, 7)


@given(
    st.integers(0, 2**32),
    st.integers(0, 8),
    st.integers(-1, 20),
    st.floats(0, 2),
    st.floats(0, 3),
    shares,
)
def test_twin_flags_the_same(
    seed: int, count: int, border: int, beside: float, nearer: float, share: float
) -> None:
    """Native and reference agree for any boxes and limits."""
    rng = np.random.default_rng(seed)
    shape = int(rng.integers(0, 60)), int(rng.integers(0, 80))
    depth = rng.uniform(0.5, 7, shape).astype(np.float32)
    cut = max(border, 0), beside, nearer, share
    arguments = depth, boxes(shape, count, seed), np.array([90.0, 91, 40, 30]), cut
    native, twin = (k.cut_sides(*arguments) for k in (_core, reference))
    assert native.shape == (count, 4)
    assert_array_equal(native, twin, strict=True)


@pytest.mark.parametrize("count", [0, 1, 40])
def test_twin_flags_the_same_in_pictures(picture: Depth, camera: Floats, count: int) -> None:
    """They also agree on pictures of awkward sizes and layouts, on no objects and on many."""
    arguments = picture, boxes(picture.shape, count, 7), camera, CUT
    native = _core.cut_sides(*arguments)
    assert native.shape == (count, 4)
    assert_array_equal(native, reference.cut_sides(*arguments), strict=True)


def shown_nearer(depth: Depth, box: Floats, camera: Floats, beside: float, nearer: float) -> list[float]:
    """How much of each side is nearer: points of the box in space, `beside` meters larger all round, which
    OpenCV projects.
    """
    x, y, width, height, _, z, _ = box
    fx, fy, cx, cy = camera
    low = np.array([(x - 0.5 - cx) * z / fx, (y - 0.5 - cy) * z / fy]) - beside
    high = np.array([(x + width - 0.5 - cx) * z / fx, (y + height - 0.5 - cy) * z / fy]) + beside
    matrix = np.array([[fx, 0, cx], [0, fy, cy], [0, 0, 1]])
    corners = (
        [low, (low[0], high[1])],
        [(high[0], low[1]), high],
        [low, (high[0], low[1])],
        [(low[0], high[1]), high],
    )
    shares = []
    for start, end in corners:
        t = (np.arange(PLACES)[:, None] + 0.5) / PLACES
        points = np.column_stack([np.array(start) * (1 - t) + np.array(end) * t, np.full(PLACES, z)])
        pixels, _ = cv2.projectPoints(points, np.zeros(3), np.zeros(3), matrix, None)
        u, v = np.floor(pixels[:, 0] + 0.5).astype(int).T
        inside = (u >= 0) & (v >= 0) & (u < depth.shape[1]) & (v < depth.shape[0])
        shares.append(np.count_nonzero(depth[v[inside], u[inside]] < z - nearer) / PLACES)
    return shares


@pytest.mark.parametrize("share", [0.0, 0.15, 0.6])
def test_agrees_with_points_in_space(
    kernels: Kernels, noisy_room: Depth, camera: Floats, share: float
) -> None:
    """With no border to end at, a side goes on where OpenCV projects enough of it onto what is nearer."""
    table = boxes(noisy_room.shape, 150, 3)
    table[:, :2] = np.clip(table[:, :2], 0, np.array([176, 144]) - table[:, 2:4])
    cut = kernels.cut_sides(noisy_room, table, camera, (0, BESIDE, NEARER, share))
    truth = np.array([shown_nearer(noisy_room, box, camera, BESIDE, NEARER) for box in table]) > share
    assert_array_equal(cut, truth)
    assert 0.05 < cut.mean() < 0.95


@pytest.mark.parametrize("side", [LEFT, RIGHT, TOP, BOTTOM])
@given(st.integers(30, 130), st.integers(30, 130), shares)
def test_agrees_with_lengths(side: int, one: int, other: int, share: float) -> None:
    """A box of 88 pixels, larger by 4 all round, is read beside a side at 36.5, 44.5 ... 124.5: where
    something nearer covers more than a share of these the side goes on, and the others don't.
    """
    first, last = sorted((one, other))
    depth = np.full((160, 160), 3, np.float32)
    upright = side in (LEFT, RIGHT)
    strip = slice(28, 34) if side in (LEFT, TOP) else slice(126, 132)
    (depth if upright else depth.T)[first:last, strip] = 2
    table = np.array([row(36, 36.5, 88, 88, 3) if upright else row(36.5, 36, 88, 88, 3)])
    covered = sum(first <= place < last for place in range(36, 128, 8))
    expected = np.zeros((1, 4), np.bool_)
    expected[0, side] = covered / PLACES > share
    lens = np.array([96.0, 96, 0, 0])
    for kernels in (_core, reference):
        assert_array_equal(kernels.cut_sides(depth, table, lens, (0, 4 * 3 / 96, NEARER, share)), expected)


@pytest.mark.parametrize("border", [0, 1, 2, 5])
def test_the_border(kernels: Kernels, border: int) -> None:
    """A side nearer to the image's than the border goes on, one as far from it doesn't; on an image that
    shows nothing else no other side does.
    """
    depth, lens = np.full((50, 60), np.nan, np.float32), np.array([60.0, 60, 30, 25])
    inside = row(border, border, 60 - 2 * border, 50 - 2 * border, 2)
    outside = [
        row(border - 1, 20, 10, 10, 2),
        row(51 - border, 20, 10, 10, 2),
        row(20, border - 1, 10, 10, 2),
        row(20, 41 - border, 10, 10, 2),
    ]
    cut = kernels.cut_sides(depth, np.array([inside, *outside]), lens, (border, *CUT[1:]))
    assert_array_equal(cut, np.concatenate([np.zeros((1, 4), np.bool_), np.eye(4, dtype=np.bool_)]))


def test_example_by_hand(kernels: Kernels) -> None:
    """Somebody 3 m away beside a door post 2 m away goes on behind it; the post doesn't behind him, the same
    post at 2.8 m isn't near enough, and 9 cm aside, not 6, it is too far aside.
    """
    lens = np.array([100.0, 100, 80, 60])
    somebody = row(60, 20, 30, 80, 3)

    def cut(z: float, gap: float, box: list[float] = somebody) -> list[bool]:
        depth = np.full((120, 160), 5, np.float32)
        depth[20:100, 60:90] = 3
        depth[:, round(90 + gap * 100 / 3) :] = z
        flags = kernels.cut_sides(depth, np.array([box]), lens, CUT)
        return list(flags[0])

    assert cut(2.0, 0.06) == [False, True, False, False]
    assert cut(2.8, 0.06) == [False, False, False, False]
    assert cut(2.0, 0.09) == [False, False, False, False]
    assert cut(2.0, 0.0, row(90, 10, 60, 100, 2)) == [False, False, False, False]


@pytest.mark.parametrize("strange", [np.nan, 0, -0.0, -1, -np.inf, np.inf])
def test_what_is_not_measured_is_not_nearer(kernels: Kernels, strange: float) -> None:
    """Neither holes nor what is outside the image cut anything."""
    depth, lens = np.full((40, 40), strange, np.float32), np.array([60.0, 60, 20, 20])
    table = np.array([row(10, 10, 20, 20, 2), row(-500, 10, 20, 20, 2), row(10, 1e300, 20, 20, 1e-3)])
    behind = kernels.cut_sides(depth, table, lens, (0, BESIDE, NEARER, 0.0))
    assert_array_equal(behind[0], np.zeros(4, np.bool_))
    assert_array_equal(behind[1], [True, False, False, False])
    assert_array_equal(behind[2], [False, False, False, True])


@given(st.integers(0, 2**32), st.floats(0, 0.9), st.floats(0, 0.5))
def test_less_goes_on_where_more_is_asked(seed: int, share: float, more: float) -> None:
    """A larger share, or something that has to be nearer still, cuts no side that wasn't cut."""
    rng = np.random.default_rng(seed)
    depth, lens = rng.uniform(0.5, 7, (60, 80)).astype(np.float32), np.array([90.0, 91, 40, 30])
    table = boxes(depth.shape, 12, seed)
    for kernels in (_core, reference):
        cut = kernels.cut_sides(depth, table, lens, (BORDER, BESIDE, NEARER, share))
        for nearer, least in ((NEARER, min(share + more, 1)), (NEARER + more, share)):
            fewer = kernels.cut_sides(depth, table, lens, (BORDER, BESIDE, nearer, least))
            assert not (fewer & ~cut).any()


@given(st.integers(0, 2**32))
def test_mirror(seed: int) -> None:
    """In the mirrored image left is right."""
    rng = np.random.default_rng(seed)
    depth, lens = rng.uniform(0.5, 7, (60, 80)).astype(np.float32), np.array([64.0, 64, 40, 30])
    # With half a pixel beside, middles are at odd 24ths from a pixel's edge: rounding moves none across it.
    sizes = 8 * rng.integers(1, 6, (6, 2))
    corners = rng.integers(-5, 60, (6, 2))
    table = np.array([row(*corner, *size, 2.0) for corner, size in zip(corners, sizes, strict=True)])
    mirrored = table.copy()
    mirrored[:, 0] = 80 - table[:, 0] - table[:, 2]
    limits = BORDER, 0.5 * 2 / 64, NEARER, 0.3
    for kernels in (_core, reference):
        cut = kernels.cut_sides(depth, table, lens, limits)
        other = kernels.cut_sides(np.ascontiguousarray(depth[:, ::-1]), mirrored, lens, limits)
        assert_array_equal(other, cut[:, [1, 0, 2, 3]])


ONE = np.ones((4, 4), np.float32)
TABLE, LENS = np.array([row(1, 1, 2, 2, 2.0)] * 2), np.array([1.0, 1.0, 0.0, 0.0])
BAD_VALUES: list[tuple[Place, Any, str]] = [
    (1, TABLE[:, :6].copy(), r"table: expected shape \(2, 7\), got \(2, 6\)"),
    (1, TABLE * np.nan, "table: expected finite numbers, got nan"),
    (1, TABLE * [1, 1, 1, 1, 1, np.inf, 1], "table: expected finite numbers, got inf"),
    (1, TABLE * [1, 1, 1, 1, 1, 0, 1], "table: expected depths above 0, got 0"),
    (1, TABLE * [1, 1, 1, 1, 1, -1, 1], "table: expected depths above 0, got -2"),
    (1, TABLE * [1, 1, -2, 1, 1, 1, 1], "table: expected sizes above 0, got -4"),
    (1, TABLE * [1, 1, 1, 0, 1, 1, 1], "table: expected sizes above 0, got 0"),
    (2, LENS[:3], r"camera: expected shape \(4,\), got \(3,\)"),
    (2, LENS * np.nan, "camera: expected finite numbers, got nan"),
    (2, LENS * [1, 0, 1, 1], "camera: expected focal lengths above 0, got 0"),
    ((3, 0), -1, "border: expected no negative number, got -1"),
    ((3, 1), -0.5, "beside: expected a finite number, not negative, got -0.5"),
    ((3, 1), np.nan, "beside: expected a finite number, not negative, got nan"),
    ((3, 2), -0.5, "occluder_margin: expected a finite number, not negative, got -0.5"),
    ((3, 2), np.inf, "occluder_margin: expected a finite number, not negative, got inf"),
    ((3, 3), -0.5, r"share: expected a number in \[0, 1\], got -0.5"),
    ((3, 3), 1.5, r"share: expected a number in \[0, 1\], got 1.5"),
    ((3, 3), np.nan, r"share: expected a number in \[0, 1\], got nan"),
]


@pytest.mark.parametrize(("place", "value", "message"), BAD_VALUES)
def test_refuses(kernels: Kernels, place: Place, value: Any, message: str) -> None:
    """Tables, cameras and limits that are none are named."""
    arguments = with_argument([ONE, TABLE, LENS, CUT], place, value)
    with pytest.raises(ValueError, match=message):
        kernels.cut_sides(*arguments)


BAD: list[tuple[int, Any, type[Exception], str]] = [
    (0, ONE.astype(float), TypeError, r"depth: expected a float32 depth image \(H, W\), got float64"),
    (0, ONE[0], ValueError, r"depth: expected a float32 depth image \(H, W\), got float32 \(4,"),
    (0, ONE[:, ::2], ValueError, "depth: expected packed pixels"),
    (1, TABLE.astype(np.float32), TypeError, "table: expected float64"),
    (1, np.repeat(TABLE, 2, axis=1)[:, ::2], ValueError, "table: expected a C-contiguous"),
    (1, TABLE[0], ValueError, r"table: expected float64 \(N, D\), got float64 \(7,"),
    (2, LENS.astype(np.float32), TypeError, "camera: expected float64"),
]


@pytest.mark.parametrize(("place", "value", "error", "message"), BAD)
def test_native_refuses_other_arrays(place: int, value: Any, error: type[Exception], message: str) -> None:
    """Another type, shape or layout is named, not converted."""
    arguments = with_argument([ONE, TABLE, LENS, CUT], place, value)
    with pytest.raises(error, match=message):
        _core.cut_sides(*arguments)
