# SPDX-License-Identifier: MIT
"""What the color particle tracker makes of input that isn't what it expects: a named error or a sane
track.
"""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from tricue import ColorParticleTracker, Frame, Status, Track

Image = NDArray[np.uint8]
IMAGE: Image = np.random.default_rng(0).integers(0, 256, (24, 32, 3), np.uint8).repeat(4, 0).repeat(4, 1)
SIZE = (128, 96)
BOX = (40, 30, 30, 25)

BAD_FRAMES: dict[str, tuple[Any, type[Exception], str]] = {
    "None": (None, TypeError, r"^frame: expected a BGR image .*NoneType.*cv2.imread"),
    "list": (IMAGE.tolist(), TypeError, r"^frame: expected a BGR image or a tricue.Frame, got list"),
    "string": ("frame.png", TypeError, r"^frame: .*got str"),
    "uint16": (IMAGE.astype(np.uint16), TypeError, r"^frame.color: expected uint8 .*uint16"),
    "float32 0..1": (IMAGE.astype(np.float32) / 255, TypeError, r"^frame.color: expected uint8 .*float32"),
    "bool": (IMAGE > 9, TypeError, r"^frame.color: expected uint8 .*bool"),
    "object": (IMAGE.astype(object), TypeError, r"^frame.color: expected uint8 .*object"),
    "grey": (IMAGE[..., 0], ValueError, r"^frame.color: expected BGR .*grey.*cvtColor"),
    "one channel": (IMAGE[..., :1], ValueError, r"^frame.color: expected BGR .*grey"),
    "two channels": (IMAGE[..., :2], ValueError, r"^frame.color: expected BGR .*\(96, 128, 2\)"),
    "RGBA": (np.dstack([IMAGE, IMAGE[..., 0]]), ValueError, r"^frame.color: expected BGR .*alpha"),
    "batch": (IMAGE[None], ValueError, r"^frame.color: expected BGR .*\(1, 96, 128, 3\)"),
    "scalar": (np.array(7, np.uint8), ValueError, r"^frame.color: expected BGR .*uint8 \(\)"),
    "empty": (IMAGE[:0], ValueError, r"^frame.color: expected an image with pixels"),
    "no columns": (IMAGE[:, :0], ValueError, r"^frame.color: expected an image with pixels"),
    "float depth": (np.ones((96, 128), np.float32), TypeError, r"^frame.color: .*float32.*; depth comes as "),
    "16-bit depth": (np.ones((96, 128), np.uint16), TypeError, r"^frame.color: .*uint16.*; depth comes as "),
    "depth alone": (Frame(depth=np.ones((96, 128), np.float32)), ValueError, r"^frame: .*color.*got depth"),
}

VIEWS: dict[str, Callable[[Image], Image]] = {
    "crop": lambda image: np.pad(image, ((3, 2), (5, 7), (0, 0)))[3:-2, 5:-7],
    "mirrored": lambda image: np.ascontiguousarray(image[:, ::-1])[:, ::-1],
    "upside down": lambda image: np.ascontiguousarray(image[::-1])[::-1],
    "channels reversed": lambda image: np.ascontiguousarray(image[..., ::-1])[..., ::-1],
    "Fortran": np.asfortranarray,
    "transposed": lambda image: np.ascontiguousarray(image.transpose(1, 0, 2)).transpose(1, 0, 2),
    "every other pixel": lambda image: image.repeat(2, 0).repeat(2, 1)[::2, ::2],
    "first three of four channels": lambda image: np.dstack([image, image[..., 0]])[..., :3],
    "same row for all": lambda image: np.broadcast_to(image[:1], image.shape),
}

BAD_BOXES: dict[str, tuple[Any, type[Exception], str]] = {
    "None": (None, ValueError, "expected"),
    "string": ("1,2,3,4", TypeError, "expected four numbers"),
    "strings": (["1", "2", "3", "4"], TypeError, "expected four numbers"),
    "bools": ([True, True, True, True], TypeError, "expected four numbers"),
    "three numbers": ((1, 2, 3), ValueError, "expected four numbers"),
    "five numbers": ((1, 2, 3, 4, 5), ValueError, "expected four numbers"),
    "two corners": (((1, 2), (3, 4)), TypeError, "expected four numbers"),
    "matrix": (np.ones((1, 4)), TypeError, "expected four numbers"),
    "number": (7, TypeError, "expected four numbers"),
    "complex": ((1, 2, 3j, 4), TypeError, "expected four numbers"),
    "NaN": ((1, np.nan, 3, 4), ValueError, "expected finite numbers"),
    "infinite": ((1, 2, np.inf, 4), ValueError, "expected finite numbers"),
    "zero width": ((1, 2, 0, 4), ValueError, "expected width and height above 0"),
    "zero": ((0, 0, 0, 0), ValueError, "expected width and height above 0"),
    "negative height": ((50, 50, 9, -9), ValueError, "corners swapped"),
    "1 px": ((50, 50, 1, 1), ValueError, "at least 2 pixels"),
    "1 px by 300": ((50, -100, 1, 300), ValueError, "at least 2 pixels"),
    "right of the image": ((128, 10, 20, 20), ValueError, "a part inside the image of 128x96"),
    "above the image": ((10, -20, 20, 20), ValueError, "a part inside the image of 128x96"),
    "far away": ((1e300, 0, 10, 10), ValueError, "expected at most a million pixels"),
    "denormal": ((50, 50, 5e-324, 5e-324), ValueError, "at least 2 pixels"),
}

GOOD_BOXES: dict[str, Any] = {
    "list": [40, 30, 30, 25],
    "array": np.array(BOX, np.float32),
    "NumPy integers": tuple(np.array(BOX)),
    "uint8": tuple(np.array(BOX, np.uint8)),
    "2 px": (60, 40, 2, 2),
    "2 px by 300": (60, -100, 2, 300),
    "half outside": (-15, -12, 30, 25),
    "a corner inside": (127.5, 95.5, 30, 30),
    "the whole image": (0, 0, *SIZE),
    "larger than the image": (-500, -500, 2000, 2000),
    "a million pixels": (-5e5, -5e5, 1e6, 1e6),
}

FRAMES: dict[str, Image] = {
    "black": np.zeros_like(IMAGE),
    "saturated": np.full_like(IMAGE, 255),
    "one color": np.full_like(IMAGE, (30, 200, 90)),
    "noise": np.random.default_rng(1).integers(0, 256, IMAGE.shape, np.uint8),
    "1x1": IMAGE[:1, :1],
    "2x2": IMAGE[:2, :2],
    "one row": IMAGE[:1],
    "one column": IMAGE[:, :1],
    "4000x3000": np.tile(IMAGE, (32, 32, 1))[:3000, :4000],
}


def assert_sane(track: Track) -> None:
    """A finite box with an area, a score in [0, 1], a status."""
    assert np.isfinite(track.box).all()
    assert min(track.box.width, track.box.height) > 0
    assert 0 <= track.score <= 1
    assert isinstance(track.status, Status)


def started() -> ColorParticleTracker:
    """A tracker that follows BOX in IMAGE."""
    tracker = ColorParticleTracker(seed=1, particles=30)
    tracker.init(IMAGE, BOX)
    tracker.update(np.roll(IMAGE, 2, axis=1))
    return tracker


NEXT = np.roll(IMAGE, 4, axis=1)
EXPECTED = started().update(NEXT)


@pytest.mark.parametrize("name", BAD_FRAMES)
def test_bad_frames_are_named(name):
    """A frame that is no BGR image gets an error that says so, at init and update, and nothing changes by
    it.
    """
    frame, error, message = BAD_FRAMES[name]
    tracker = started()
    with pytest.raises(error, match=message):
        tracker.update(frame)
    with pytest.raises(error, match=message):
        tracker.init(frame, BOX)
    assert tracker.update(NEXT) == EXPECTED


@pytest.mark.parametrize("name", BAD_BOXES)
def test_bad_boxes_are_named(name):
    """A box that can't be started on gets an error that names it, and the tracker follows the old target
    on.
    """
    box, error, message = BAD_BOXES[name]
    tracker = started()
    with pytest.raises(error, match=f"^box: .*{message}"):
        tracker.init(IMAGE, box)
    assert tracker.update(NEXT) == EXPECTED


@pytest.mark.parametrize("shape", [(48, 64), (192, 256), (96, 127), (128, 96)], ids=str)
def test_another_size_is_named(shape):
    """A frame of another size than the first is an error that says both, and nothing changes by it."""
    tracker = started()
    expected = (
        rf"^frame.color: expected the first frame's shape \(96, 128, 3\), got \({shape[0]}, {shape[1]}, 3\)"
    )
    with pytest.raises(ValueError, match=expected):
        tracker.update(np.resize(IMAGE, (*shape, 3)))
    assert tracker.update(NEXT) == EXPECTED


def test_update_before_init_is_named():
    """Update before init, and after an init that failed, is a RuntimeError that says what to do."""
    tracker = ColorParticleTracker()
    with pytest.raises(RuntimeError, match=r"^update: expected init first"):
        tracker.update(IMAGE)
    with pytest.raises(ValueError, match=r"^box: "):
        tracker.init(IMAGE, (0, 0, 0, 0))
    with pytest.raises(RuntimeError, match=r"^update: expected init first"):
        tracker.update(IMAGE)


@pytest.mark.parametrize("name", VIEWS)
def test_views_are_read_as_they_look(name):
    """Crops, mirrored and reordered views, also read-only ones, give the track of a packed copy, bit for
    bit.
    """
    tracks = []
    for layout in (VIEWS[name], lambda image: VIEWS[name](image).copy(order="C")):
        tracker = ColorParticleTracker(seed=1, particles=30)
        view = layout(NEXT)
        view.flags.writeable = False
        tracks.append([tracker.init(layout(IMAGE), BOX), tracker.update(view)])
    assert tracks[0] == tracks[1]


@pytest.mark.parametrize("name", GOOD_BOXES)
def test_odd_boxes_are_followed(name):
    """Boxes of other number types, very small, reaching over the edge or larger than the image give sane
    tracks.
    """
    tracker = ColorParticleTracker(seed=1, particles=30)
    first = tracker.init(IMAGE, GOOD_BOXES[name])
    assert first.box == pytest.approx(tuple(map(float, GOOD_BOXES[name])))
    for shift in range(8):
        assert_sane(tracker.update(np.roll(IMAGE, shift, axis=0)))


@pytest.mark.parametrize(
    "observation", ["region", "gaussian", "lookup", "histogram", "rank-sections", "rank-spatial"]
)
@pytest.mark.parametrize("name", FRAMES)
def test_odd_frames_are_sane(name, observation, kernels_name):
    """Black, saturated, uniform, tiny and huge images give sane tracks, at init, at update and until long
    lost.
    """
    image = FRAMES[name]
    if kernels_name == "reference" and image.size > IMAGE.size:
        pytest.skip("the twins are too slow for a huge image")
    tracker = ColorParticleTracker(seed=1, particles=20, observation=observation, kernels=kernels_name)
    assert_sane(tracker.init(image, (0, 0, 10, 12)))
    for _ in range(8):
        assert_sane(tracker.update(image))
    if image.shape == IMAGE.shape:
        tracker.init(IMAGE, BOX)
        for _ in range(8):
            assert_sane(tracker.update(image))


@pytest.fixture(params=["native", "reference"])
def kernels_name(request: pytest.FixtureRequest) -> str:
    """Both sets of kernels, by name."""
    return str(request.param)


anything = st.floats() | st.floats(-300, 300) | st.integers(-(10**9), 10**9)


@settings(max_examples=300)
@given(st.tuples(*4 * [anything]))
def test_any_four_numbers(box):
    """Whatever four numbers the box is, it is refused by name or gives sane tracks: no crash, no warning,
    no hang.
    """
    tracker = ColorParticleTracker(seed=1, particles=10)
    try:
        tracks = [tracker.init(IMAGE, box)]
    except ValueError as error:
        assert str(error).startswith("box: expected")  # noqa: PT017
        return
    tracks += [tracker.update(IMAGE), tracker.update(NEXT)]
    for track in tracks:
        assert_sane(track)
