# SPDX-License-Identifier: MIT
"""What the fused tracker makes of input that isn't what it expects: a named error or a sane track."""

from typing import Any

import numpy as np
import pytest
from tricue import Frame, Status
from tricue.track.fused.params import FusedParams
from tricue.track.fused.tracker import FusedTracker

IMAGE = np.random.default_rng(0).integers(0, 256, (24, 32, 3), np.uint8).repeat(4, 0).repeat(4, 1)
BOX = (40, 30, 30, 25)

BAD_FRAMES: dict[str, tuple[Any, type[Exception], str]] = {
    "None": (None, TypeError, r"^frame: expected a BGR image .*NoneType"),
    "list": (IMAGE.tolist(), TypeError, r"^frame: expected a BGR image or a tricue.Frame, got list"),
    "uint16": (IMAGE.astype(np.uint16), TypeError, r"^frame.color: expected uint8 .*uint16"),
    "grey": (IMAGE[..., 0], ValueError, r"^frame.color: expected BGR .*grey.*cvtColor"),
    "RGBA": (np.dstack([IMAGE, IMAGE[..., 0]]), ValueError, r"^frame.color: expected BGR .*alpha"),
    "empty": (IMAGE[:0], ValueError, r"^frame.color: expected an image with pixels"),
    "depth alone": (Frame(depth=np.ones((96, 128), np.float32)), ValueError, r"^frame: .*color.*got depth"),
}
BAD_BOXES: dict[str, tuple[Any, type[Exception], str]] = {
    "None": (None, ValueError, "^box: expected"),
    "string": ("1,2,3,4", TypeError, "expected four numbers"),
    "three numbers": ((1, 2, 3), ValueError, "expected four numbers"),
    "NaN": ((1, np.nan, 3, 4), ValueError, "expected finite numbers"),
    "zero width": ((1, 2, 0, 4), ValueError, "expected width and height above 0"),
    "1 px": ((50, 50, 1, 1), ValueError, "at least 2 pixels"),
    "right of the image": ((128, 10, 20, 20), ValueError, "a part inside the image of 128x96"),
    "far away": ((1e300, 0, 10, 10), ValueError, "expected at most a million pixels"),
}
GOOD_BOXES: dict[str, Any] = {
    "list": [40, 30, 30, 25],
    "uint8": tuple(np.array(BOX, np.uint8)),
    "2 px": (60, 40, 2, 2),
    "2 px by 300": (60, -100, 2, 300),
    "half outside": (-15, -12, 30, 25),
    "a corner inside": (127.5, 95.5, 30, 30),
    "the whole image": (0, 0, 128, 96),
    "a million pixels": (-5e5, -5e5, 1e6, 1e6),
}
FRAMES = {
    "black": np.zeros_like(IMAGE),
    "saturated": np.full_like(IMAGE, 255),
    "1x1": IMAGE[:1, :1],
    "2x2": IMAGE[:2, :2],
    "one row": IMAGE[:1],
    "one column": IMAGE[:, :1],
    "4000x3000": np.tile(IMAGE, (32, 32, 1))[:3000, :4000],
}


def assert_sane(track: Any) -> None:
    """A finite box with an area, a score in [0, 1], a status."""
    assert np.isfinite(track.box).all()
    assert min(track.box.width, track.box.height) > 0
    assert 0 <= track.score <= 1
    assert isinstance(track.status, Status)


@pytest.mark.parametrize("case", BAD_FRAMES)
def test_bad_frames_are_named(case):
    """init and update refuse a bad frame, and update goes on as if it had not come."""
    frame, error, words = BAD_FRAMES[case]
    tracker, other = FusedTracker(), FusedTracker()
    with pytest.raises(error, match=words):
        tracker.init(frame, BOX)
    tracker.init(IMAGE, BOX)
    other.init(IMAGE, BOX)
    with pytest.raises(error, match=words):
        tracker.update(frame)
    assert tracker.update(IMAGE) == other.update(IMAGE)


@pytest.mark.parametrize("case", BAD_BOXES)
def test_bad_boxes_are_named(case):
    """init refuses a bad box."""
    box, error, words = BAD_BOXES[case]
    with pytest.raises(error, match=words):
        FusedTracker().init(IMAGE, box)


@pytest.mark.parametrize("case", GOOD_BOXES)
def test_unusual_boxes_are_followed(case):
    """Any box with a part in the image starts a sane track."""
    tracker = FusedTracker()
    assert_sane(tracker.init(IMAGE, GOOD_BOXES[case]))
    for frame in (np.roll(IMAGE, 2, axis=1), np.zeros_like(IMAGE), IMAGE, IMAGE):
        assert_sane(tracker.update(frame))


@pytest.mark.parametrize("case", FRAMES)
def test_unusual_frames_are_followed(case):
    """Frames of any size and of one color give sane tracks, without a warning."""
    image = FRAMES[case]
    height, width = image.shape[:2]
    tracker = FusedTracker()
    assert_sane(tracker.init(image, (-2, -2, max(0.4 * width, 4), max(0.5 * height, 4))))
    for frame in (image, 255 - image, image):
        assert_sane(tracker.update(frame))


def test_update_before_init():
    """update says that init comes first."""
    with pytest.raises(RuntimeError, match=r"^update: expected init first"):
        FusedTracker().update(IMAGE)


def test_another_size_is_refused():
    """A frame of another size than the first one's is refused."""
    tracker = FusedTracker()
    tracker.init(IMAGE, BOX)
    with pytest.raises(ValueError, match="expected the first frame's shape"):
        tracker.update(IMAGE[:-1])


@pytest.mark.parametrize(
    ("values", "error", "words"),
    [
        ({"ridge": 0.0}, ValueError, "^ridge: expected above 0"),
        ({"cues": ("filter", "smell")}, ValueError, "^cues: expected one of"),
        ({"cues": ("ranks",)}, ValueError, "^cues: expected filter or color"),
        ({"scales": 4}, ValueError, "^scales: expected an odd number"),
        ({"size_range": (2.0, 1.0)}, ValueError, "^size_range: expected the lower number first"),
        ({"rigde": 1.0}, TypeError, "^rigde: unknown parameter .*ridge"),
    ],
)
def test_bad_parameters_are_named(values, error, words):
    """Parameters out of range, of wrong type or unknown are refused."""
    with pytest.raises(error, match=words):
        FusedTracker(**values)


def test_defaults_tell_unit_and_source():
    """Every parameter has a unit and a source."""
    lines = FusedParams.describe().splitlines()
    assert len(lines) > 20
    assert all(len(line.split()) >= 4 for line in lines[1:])
