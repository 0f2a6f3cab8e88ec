# SPDX-License-Identifier: MIT
import warnings
from pathlib import Path

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray
from tricue import Frame
from tricue.camera.depth_check import MIN_EDGE_CELLS, check_depth, warn_of_depth

Image = NDArray[np.uint8]
Plane = NDArray[np.float32]
REGISTERED = ("kitchen-mug", "paper-cup", "walker-purple", "yellow-dragon")
UNREGISTERED = ("queue-first", "queue-second", "walk-away")
SIZE = 320, 240


def recorded(folder: Path, every: int) -> list[tuple[Image, Plane]]:
    """Every so manieth color and depth image of a recording, as its cameras took them."""
    paths = zip(sorted((folder / "color").iterdir()), sorted((folder / "depth").iterdir()), strict=True)
    found = []
    for color, depth in list(paths)[::every]:
        millimeters = cv2.imread(str(depth), cv2.IMREAD_UNCHANGED)
        meters = np.where(millimeters > 0, millimeters / np.float32(1000), np.float32(np.nan))
        found.append((np.asarray(cv2.imread(str(color)), np.uint8), meters.astype(np.float32)))
    return found


def moved(depth: Plane, right: int, down: int, scale: float = 1.0) -> Plane:
    """Depth enlarged around its middle and moved by pixels; NaN where it leaves nothing."""
    height, width = depth.shape
    x, y = (width - 1) / 2, (height - 1) / 2
    move = np.array([[scale, 0, x - scale * x + right], [0, scale, y - scale * y + down]])
    found = cv2.warpAffine(depth, move, (width, height), flags=cv2.INTER_NEAREST, borderValue=float("nan"))
    return np.asarray(found, np.float32)


@pytest.fixture(scope="module")
def room() -> tuple[Image, Plane]:
    """Boxes, discs and a textured wall, whose depth is registered."""
    rng = np.random.default_rng(0)
    width, height = SIZE
    color = np.asarray(cv2.resize(rng.integers(90, 130, (24, 32, 3), dtype=np.uint8), SIZE), np.uint8)
    depth = np.full((height, width), 4, np.float32)
    for _ in range(12):
        x, y = (int(rng.integers(20, side - 60)) for side in SIZE)
        wide, high = (int(side) for side in rng.integers(20, 60, 2))
        level, z = rng.integers(0, 256, 3).tolist(), float(rng.uniform(1, 3))
        if rng.random() < 0.5:
            cv2.rectangle(color, (x, y), (x + wide, y + high), level, -1)
            cv2.rectangle(depth, (x, y), (x + wide, y + high), z, -1)
        else:
            cv2.circle(color, (x, y), wide // 2, level, -1)
            cv2.circle(depth, (x, y), wide // 2, z, -1)
    noise = rng.normal(0, 3, color.shape)
    return np.clip(color + noise, 0, 255).astype(np.uint8), depth


@pytest.mark.parametrize("name", REGISTERED)
def test_registered_recordings_pass(data: Path, name: str) -> None:
    """It proves that no tenth frame of a registered recording is doubted, nor the first."""
    for color, depth in recorded(data / "rgbd" / name, 10):
        assert check_depth(color, depth).problem == ""


@pytest.mark.parametrize("name", UNREGISTERED)
def test_raw_recordings_are_noticed(data: Path, name: str) -> None:
    """It proves that each sixth frame of depth and color as the cameras took them is noticed, and the first.

    The focal lengths are 568 and 534 pixels: depth fits after a scale of 0.94.
    """
    for color, depth in recorded(data / "rgbd" / name, 6):
        check = check_depth(color, depth)
        assert "not to be registered" in check.problem
        assert check.fits[1].scale in (0.925, 0.95)
        assert 12 < check.fits[1].error < 19


@pytest.mark.parametrize("shift", [(16, 0), (-16, 0), (0, 16), (0, -16)], ids=str)
def test_shifted_recordings_are_noticed(data: Path, shift: tuple[int, int]) -> None:
    """It proves that each fourth frame of a recording with many edges, shifted, is noticed, and where to."""
    for color, depth in recorded(data / "rgbd/walker-purple", 4):
        check = check_depth(color, moved(depth, *shift))
        assert "not to be registered" in check.problem
        assert (-check.fits[0].right, -check.fits[0].down) == pytest.approx(shift, abs=4)


def test_a_drawn_room_passes(room: tuple[Image, Plane]) -> None:
    """It proves that registered depth fits best where it is, and gray says what color says."""
    color, depth = room
    check = check_depth(color, depth)
    assert check.edges >= MIN_EDGE_CELLS
    assert [(fit.right, fit.down, fit.scale, fit.error) for fit in check.fits] == 2 * [(0, 0, 1.0, 0.0)]
    assert check.problem == ""
    gray = np.asarray(cv2.cvtColor(color, cv2.COLOR_BGR2GRAY), np.uint8)
    assert check_depth(gray, depth).fits[0][:4] == check.fits[0][:4]


@pytest.mark.parametrize(("right", "down"), [(2, 0), (-2, 2), (0, -2), (4, 0), (-4, 0), (0, 4)])
def test_small_errors_pass(room: tuple[Image, Plane], right: int, down: int) -> None:
    """It proves that one cell, as registrations leave it, isn't worth a warning, and two aren't yet."""
    color, depth = room
    assert check_depth(color, moved(depth, right, down)).problem == ""


@pytest.mark.parametrize(("right", "down"), [(6, 0), (0, -6), (-12, 0), (0, 10), (-6, -6), (20, 0)])
def test_shifts_are_measured(room: tuple[Image, Plane], right: int, down: int) -> None:
    """It proves that a shift is found to a cell, is said, and so is what to do."""
    color, depth = room
    check = check_depth(color, moved(depth, right, down))
    assert (-check.fits[0].right, -check.fits[0].down) == (right, down)
    assert check.fits[0].error == pytest.approx(np.hypot(right, down))
    assert f"about {np.hypot(right, down):.0f} px beside" in check.problem
    assert "(tricue.camera.registration.Registration)" in check.problem


@pytest.mark.parametrize(
    ("height", "width", "is_checked"),
    [(60, 320, True), (58, 320, False), (240, 120, True), (240, 119, False)],
)
def test_small_images_are_not_checked(
    room: tuple[Image, Plane], height: int, width: int, is_checked: bool
) -> None:
    """It proves that an image is checked from 120 cells of width and three times the largest shift in height
    on; 160 cells are 320 pixels, and a narrow image has a cell a pixel.
    """
    color, depth = (each[:height, :width] for each in (room[0], moved(room[1], 12, 0)))
    check = check_depth(color, depth)
    assert (check.edges > 0) == (len(check.fits) > 0) == bool(check.problem) == is_checked


@pytest.mark.parametrize(("side", "is_checked"), [(36, False), (44, True)])
def test_a_few_edges_are_not_compared(side: int, is_checked: bool) -> None:
    """It proves that the outline of one box, 36 pixels wide, is too little to compare, and a larger one's is
    enough.
    """
    color = np.random.default_rng(0).integers(0, 256, (240, 320, 3), dtype=np.uint8)
    depth = np.full((240, 320), 4, np.float32)
    depth[100 : 100 + side, 100 : 100 + side] = 2
    check = check_depth(color, depth)
    assert (check.edges >= MIN_EDGE_CELLS) == (len(check.fits) > 0) == is_checked


@pytest.mark.parametrize("scale", [0.925, 0.95, 0.975, 1.025, 1.05, 1.075])
def test_a_scale_is_measured(room: tuple[Image, Plane], scale: float) -> None:
    """It proves that another focal length is found: depth enlarged by 1 / 0.925 fits after 0.925.

    Over an image of diagonal D a scale of 1 + e moves pixels by e D / 12^1/2, root mean square; a scale of
    5 % is measured, and isn't worth a warning yet.
    """
    color, depth = room
    check = check_depth(color, moved(depth, 0, 0, 1 / scale))
    fit = check.fits[1]
    by_scale = abs(1 - scale) * np.hypot(*SIZE) / np.sqrt(12)
    assert fit.scale == scale
    assert abs(fit.right) + abs(fit.down) <= 2  # a cell
    assert fit.error == pytest.approx(np.linalg.norm([by_scale, fit.right, fit.down]), rel=0.02)
    assert bool(check.problem) == (by_scale > 7)


def blank() -> list[tuple[Image, Plane]]:
    """Frames that have no edges of depth, or none of color."""
    rng = np.random.default_rng(0)
    found = [
        (np.zeros(shape, np.uint8), np.full(shape[:2], 2, np.float32))
        for shape in ((1, 1), (2, 3), (9, 900), (900, 9), (120, 160, 3))
    ]
    noise = rng.integers(0, 256, (240, 320, 3), dtype=np.uint8)
    steps = np.where(np.indices((240, 320)).sum(axis=0) // 20 % 2, 1, 2).astype(np.float32)
    unknown = np.full((240, 320), np.nan, np.float32)
    return [*found, (noise, unknown), (noise, steps), (np.zeros_like(noise), steps)]


@pytest.mark.parametrize(("color", "depth"), blank())
def test_nothing_is_said_of_nothing(color: Image, depth: Plane) -> None:
    """It proves that frames without edges give no verdict and no error, whatever their size."""
    assert check_depth(color, depth).problem == ""


def test_the_warning_points_at_the_caller(room: tuple[Image, Plane]) -> None:
    """It proves that depth off by 12 px warns once and names the channel, from where init was called."""
    color, depth = room

    def init(frame: Frame) -> None:
        warn_of_depth(frame)

    with pytest.warns(UserWarning, match="depth: seems not to be registered to color") as caught:
        init(Frame(color, moved(depth, 12, 0)))
    assert len(caught) == 1
    assert caught[0].filename == __file__
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        init(Frame(color, depth))


def test_a_frame_without_depth_is_refused() -> None:
    """It proves that the missing channel is named."""
    with pytest.raises(ValueError, match="expected the channel depth"):
        warn_of_depth(Frame(np.zeros((4, 4), np.uint8)))
