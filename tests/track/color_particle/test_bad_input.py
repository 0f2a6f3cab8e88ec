# SPDX-License-Identifier: MIT
"""What the color particle tracker makes of input that isn't what it expects: a named error or a sane
track.
"""

from collections.abc import Callable

import bad_input_cases as cases
import numpy as np
import pytest
from hypothesis import given, settings
from numpy.typing import NDArray
from tricue import ColorParticleTracker, Frame

Image = NDArray[np.uint8]
IMAGE: Image = np.random.default_rng(0).integers(0, 256, (24, 32, 3), np.uint8).repeat(4, 0).repeat(4, 1)
BOX = (40, 30, 30, 25)

BAD_FRAMES: cases.BadFrames = {
    **cases.NO_FRAMES,
    **cases.NO_IMAGES,
    **cases.BARE_DEPTHS,
    "gray": (lambda: IMAGE[..., 0], ValueError, r"^frame.color: expected BGR .*gray.*cvtColor"),
    "one channel": (lambda: IMAGE[..., :1], ValueError, r"^frame.color: expected BGR .*gray"),
    "depth alone": (lambda: Frame(depth=cases.METERS), ValueError, r"^frame: .*color.*got depth"),
}

BAD_BOXES = {**cases.BAD_BOXES, "None": (None, ValueError, "expected")}

GOOD_BOXES = {**cases.same_box(BOX), **cases.ODD_BOXES}

VIEWS: dict[str, Callable[[Image], Image]] = {
    **cases.COLOR_VIEWS,
    "same row for all": lambda image: np.broadcast_to(image[:1], image.shape),
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
        tracker.update(frame())
    with pytest.raises(error, match=message):
        tracker.init(frame(), BOX)
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


@pytest.mark.parametrize("shape", cases.OTHER_SHAPES, ids=str)
def test_another_size_is_named(shape):
    """A frame of another size than the first is an error that says both, and nothing changes by it."""
    tracker = started()
    expected = (
        rf"^frame.color: expected the first frame's shape \(96, 128, 3\), got \({shape[0]}, {shape[1]}, 3\)"
    )
    with pytest.raises(ValueError, match=expected):
        tracker.update(np.resize(IMAGE, (*shape, 3)))
    assert tracker.update(NEXT) == EXPECTED


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
        cases.assert_sane(tracker.update(np.roll(IMAGE, shift, axis=0)))


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
    cases.assert_sane(tracker.init(image, (0, 0, 10, 12)))
    for _ in range(8):
        cases.assert_sane(tracker.update(image))
    if image.shape == IMAGE.shape:
        tracker.init(IMAGE, BOX)
        for _ in range(8):
            cases.assert_sane(tracker.update(image))


@pytest.fixture(params=["native", "reference"])
def kernels_name(request: pytest.FixtureRequest) -> str:
    """Both sets of kernels, by name."""
    return str(request.param)


@settings(max_examples=300)
@given(cases.boxes)
def test_any_four_numbers(box):
    """Whatever four numbers the box is, it is refused by name or gives sane tracks: no crash, no warning,
    no hang.
    """
    cases.sane_from(ColorParticleTracker(seed=1, particles=10), IMAGE, box, [IMAGE, NEXT])
