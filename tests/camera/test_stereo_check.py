# SPDX-License-Identifier: MIT
import math
import warnings
from pathlib import Path

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray
from tricue import Frame, scenes
from tricue.camera.stereo_check import MAX_ROW_ERROR, MIN_MATCHES, check_stereo, warn_of_stereo

Image = NDArray[np.uint8]
Pair = tuple[Image, Image]


def images(folder: Path, every: int) -> list[Image]:
    """Every so manieth image of a folder."""
    return [cv2.imread(str(path)) for path in sorted(folder.iterdir())[::every]]


@pytest.fixture(scope="module")
def real(data: Path) -> list[Pair]:
    """The Middlebury pairs, and some of both stereo sequences: all rectified."""
    static = [folder for folder in sorted((data / "disparity").iterdir()) if folder.is_dir()]
    pairs = [(cv2.imread(str(f / "im2.png")), cv2.imread(str(f / "im6.png"))) for f in static]
    belt, cars = data / "stereo/conveyor-box", data / "stereo/kitti-tracking"
    pairs += zip(images(belt / "left", 19), images(belt / "right", 19), strict=True)
    return pairs + list(
        zip(images(cars / "image_02/0005", 4), images(cars / "image_03/0005", 4), strict=True)
    )


@pytest.fixture(scope="module")
def made() -> list[Pair]:
    """The first frames of twelve scenes 160x120 and two 640x480."""
    kinds = [*enumerate(2 * scenes.HEAD_KINDS)]
    found = [scenes.head(seed, 1, kind=kind).frames[0] for seed, kind in kinds]
    found += [scenes.head(seed, 1, "640x480").frames[0] for seed in range(2)]
    return [
        (frame.color, frame.right) for frame in found if frame.color is not None and frame.right is not None
    ]


@pytest.fixture(params=["real", "made"])
def pairs(request: pytest.FixtureRequest) -> list[Pair]:
    """The real pairs, and then those of the scenes."""
    found: list[Pair] = request.getfixturevalue(request.param)
    return found


def warped(image: Image, degrees: float = 0.0, down: float = 0.0, zoom: float = 1.0) -> Image:
    """The image turned round its middle, enlarged, and moved down by pixels."""
    height, width = image.shape[:2]
    move = cv2.getRotationMatrix2D(((width - 1) / 2, (height - 1) / 2), degrees, zoom)
    move[1, 2] += down
    turned = cv2.warpAffine(image, move, (width, height), borderMode=cv2.BORDER_REPLICATE)
    return np.asarray(turned, np.uint8)


def test_rectified_pairs_pass(pairs: list[Pair]) -> None:
    """It proves that no rectified pair is doubted, with a margin: rows agree to 0.5 px, 2 % lie behind."""
    for left, right in pairs:
        check = check_stereo(left, right)
        assert check.matches >= MIN_MATCHES
        assert check.row_error < 0.5
        assert check.negative_share < 0.02
        assert check.problem == ""


def test_swapped_pairs_are_noticed(pairs: list[Pair]) -> None:
    """It proves that every pair with its images swapped is called so: 95 % of the matches lie behind."""
    for left, right in pairs:
        check = check_stereo(right, left)
        assert check.negative_share > 0.95
        assert "swapped" in check.problem


@pytest.mark.parametrize("down", [3.0, -3.0])
def test_shifted_pairs_are_noticed(pairs: list[Pair], down: float) -> None:
    """It proves that 3 px between the rows are found in every pair, to half a pixel."""
    for left, right in pairs:
        check = check_stereo(left, warped(right, down=down))
        assert check.row_error == pytest.approx(3, abs=0.5)
        assert "not to be rectified" in check.problem


@pytest.mark.parametrize("degrees", [3.0, -4.0])
def test_rotated_pairs_are_noticed(pairs: list[Pair], degrees: float) -> None:
    """It proves that a turned camera is found in every pair, and by how much its rows are off.

    A turn by t moves rows by u sin t, nearly; over the width W the root mean square of u is W / 12^1/2.
    """
    for left, right in pairs:
        check = check_stereo(left, warped(right, degrees=degrees))
        expected = math.sin(math.radians(abs(degrees))) * left.shape[1] / math.sqrt(12)
        assert check.row_error == pytest.approx(expected, rel=0.2)
        assert "not to be rectified" in check.problem


def test_negative_disparities_of_unrectified_pairs_are_no_swap(made: list[Pair]) -> None:
    """It proves that rows come first: of cameras that look inward, such disparities prove no swap."""
    for left, right in made:
        check = check_stereo(warped(right, down=3.0), left)
        assert check.negative_share > 0.95
        assert "not to be rectified" in check.problem


def test_cameras_of_two_focal_lengths_are_noticed(made: list[Pair]) -> None:
    """It proves that a difference in scale shows in the rows, too."""
    for left, right in made[:6]:
        rise = check_stereo(left, warped(right, zoom=1.08)).row_error
        assert rise == pytest.approx(0.08 * 120 / math.sqrt(12), abs=0.6)


def test_small_offsets_pass(made: list[Pair]) -> None:
    """It proves that one pixel, as calibrations leave it, is measured and isn't worth a warning."""
    for left, right in made:
        check = check_stereo(left, warped(right, down=1.0))
        assert check.row_error == pytest.approx(1.0, abs=0.3)
        assert check.problem == ""
    assert MAX_ROW_ERROR == 1.5


def test_gray_says_what_color_says(made: list[Pair]) -> None:
    """It proves that gray images are taken, with the same result as the color ones they were made of."""
    left, right = made[0]
    gray = [np.asarray(cv2.cvtColor(image, cv2.COLOR_BGR2GRAY), np.uint8) for image in (left, right)]
    assert check_stereo(gray[0], gray[1]) == check_stereo(left, right)


def blank() -> list[Pair]:
    """Pairs in which nothing can be matched."""
    rng = np.random.default_rng(0)
    shapes = ((1, 1), (2, 3), (9, 9), (120, 160, 3))
    pairs: list[Pair] = [(np.zeros(shape, np.uint8), np.full(shape, 255, np.uint8)) for shape in shapes]
    left, right = rng.integers(0, 256, (2, 120, 160), dtype=np.uint8)
    return [*pairs, (left, right)]


@pytest.mark.parametrize(("left", "right"), blank())
def test_nothing_is_said_of_nothing(left: Image, right: Image) -> None:
    """It proves that images without matches give no verdict and no error, whatever their size."""
    check = check_stereo(left, right)
    assert check.matches < MIN_MATCHES
    assert np.isnan(check.row_error)
    assert np.isnan(check.negative_share)
    assert check.problem == ""


def test_the_warning_points_at_the_caller(made: list[Pair]) -> None:
    """It proves that a swapped pair warns once and names the channel, from where init was called."""
    left, right = made[0]

    def init(frame: Frame) -> None:
        warn_of_stereo(frame)

    with pytest.warns(UserWarning, match="right: left and right seem to be swapped") as caught:
        init(Frame(right, right=left))
    assert len(caught) == 1
    assert caught[0].filename == __file__
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        init(Frame(left, right=right))


def test_a_frame_without_right_is_refused() -> None:
    """It proves that the missing channel is named."""
    with pytest.raises(ValueError, match="expected the channel right"):
        warn_of_stereo(Frame(np.zeros((4, 4), np.uint8)))
