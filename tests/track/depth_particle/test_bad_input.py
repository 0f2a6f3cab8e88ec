# SPDX-License-Identifier: MIT
"""What the depth particle tracker makes of input that isn't what it expects: a named error or a sane
track.
"""

import warnings
from collections.abc import Callable
from typing import Any

import bad_input_cases as cases
import numpy as np
import pytest
from bad_input_cases import CAMERA
from hypothesis import given, settings
from numpy.typing import NDArray
from tricue import DepthParticleTracker, Frame, Intrinsics, Status

Depth = NDArray[np.float32]
BOX = (40, 20, 30, 60)


def hall(shift: int = 0, z: float = 3.0) -> Depth:
    """Somebody of 30x60 pixels before a wall, with a few gaps."""
    depth = np.full((96, 128), 6.0, np.float32)
    depth[20:80, 40 + shift : 70 + shift] = z
    depth[np.random.default_rng(0).random(depth.shape) < 0.03] = np.nan
    return depth


DEPTH = hall()
MILLIMETERS = np.nan_to_num(1000 * DEPTH).astype(np.uint16)
COLOR = np.zeros((96, 128, 3), np.uint8)

BAD_FRAMES: cases.BadFrames = {
    **cases.NO_FRAMES,
    **cases.BARE_DEPTHS,
    **cases.NO_DEPTHS,
    "bare gray image": (lambda: COLOR[..., 0], ValueError, r"^frame: expected the channel depth.*got color"),
    "bare color": (lambda: COLOR, ValueError, r"^frame: expected the channel depth.*got color"),
    "color alone": (lambda: Frame(color=COLOR), ValueError, r"^frame: expected the channel depth.*got color"),
    "stereo pair": (
        lambda: Frame(color=COLOR, right=COLOR),
        ValueError,
        r"^frame: expected the channel depth.*got color and right",
    ),
}

VIEWS: dict[str, Callable[[Depth], Depth]] = {
    **cases.VIEWS,
    "one of two channels": lambda depth: np.dstack([depth, depth + 1])[..., 0],
}

GOOD_BOXES = {**cases.same_box(BOX), **cases.ODD_BOXES}

FRAMES: dict[str, Depth] = {
    "nothing measured": np.full_like(DEPTH, np.nan),
    "all far": np.full_like(DEPTH, 40.0),
    "all near": np.full_like(DEPTH, 0.1),
    "a wall at the target's depth": np.full_like(DEPTH, 3.0),
    "a wall in front": np.full_like(DEPTH, 0.8),
    "a wall at far": np.full_like(DEPTH, 8.0),
    "noise": np.random.default_rng(1).uniform(0.3, 8, DEPTH.shape).astype(np.float32),
    "one pixel": np.where(
        np.arange(DEPTH.size).reshape(DEPTH.shape) == 6453, np.float32(3), np.float32(np.nan)
    ),
    "denormal": np.full_like(DEPTH, 1e-40),
    "largest": np.where(np.indices(DEPTH.shape)[1] < 32, np.float32(3e38), np.float32(2)),
    "a ramp": np.linspace(0.3, 7.9, DEPTH.size, dtype=np.float32).reshape(DEPTH.shape),
}


def odd(name: str) -> Frame:
    """The frame of that name; that some look like another unit is no matter here."""
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", "depth: its median", UserWarning)
        return Frame(depth=FRAMES[name])


def started(**parameters: Any) -> DepthParticleTracker:
    """A tracker that follows BOX in DEPTH."""
    tracker = DepthParticleTracker(**{"intrinsics": CAMERA, "seed": 1, "particles": 30, **parameters})
    tracker.init(Frame(depth=DEPTH), BOX)
    tracker.update(Frame(depth=hall(1)))
    return tracker


NEXT = Frame(depth=hall(2))
EXPECTED = started().update(NEXT)


@pytest.mark.parametrize("name", BAD_FRAMES)
def test_bad_frames_are_named(name):
    """A frame without meters gets an error that says so, at init and update, and nothing changes by it."""
    frame, error, message = BAD_FRAMES[name]
    tracker = started()
    with pytest.raises(error, match=message):
        tracker.update(frame())
    with pytest.raises(error, match=message):
        tracker.init(frame(), BOX)
    assert tracker.update(NEXT) == EXPECTED


@pytest.mark.parametrize("name", cases.BAD_BOXES)
def test_bad_boxes_are_named(name):
    """A box that can't be started on gets an error that names it, and the old target is followed on."""
    box, error, message = cases.BAD_BOXES[name]
    tracker = started()
    with pytest.raises(error, match=f"^box: .*{message}"):
        tracker.init(Frame(depth=DEPTH), box)
    assert tracker.update(NEXT) == EXPECTED


@pytest.mark.parametrize("box", [None, BOX], ids=["without a box", "with one"])
@pytest.mark.parametrize("name", ["nothing measured", "all far", "all near", "a wall at far", "denormal"])
def test_a_start_on_nothing_is_named(name, box):
    """Nothing in range at init is an error that names the box, given or not, and the old target is followed
    on.
    """
    tracker = started()
    with pytest.raises(ValueError, match=r"^box: expected"):
        tracker.init(odd(name), box)
    assert tracker.update(NEXT) == EXPECTED


def test_a_box_in_a_gap_is_named():
    """A box with no measurement inside is an error that shows it, though there are some round it."""
    depth = DEPTH.copy()
    depth[10:90, 80:120] = np.nan
    tracker = started()
    with pytest.raises(ValueError, match=r"^box: expected .*measured depth.*got none in \(85.*15"):
        tracker.init(Frame(depth=depth), (85, 15, 30, 70))
    assert tracker.update(NEXT) == EXPECTED


@pytest.mark.parametrize("shape", cases.OTHER_SHAPES, ids=str)
def test_another_size_is_named(shape):
    """A frame of another size than the first is an error that says both, and nothing changes by it."""
    tracker = started()
    expected = rf"^frame.depth: expected the first frame's shape \(96, 128\), got \({shape[0]}, {shape[1]}\)"
    with pytest.raises(ValueError, match=expected):
        tracker.update(Frame(depth=np.full(shape, 3.0)))
    assert tracker.update(NEXT) == EXPECTED


def test_a_camera_of_another_size_is_named():
    """A first frame of another size than the camera's is an error that says both, and nothing changes."""
    tracker = started()
    message = r"^frame.depth: expected the camera's size, 128x96, got 64x48"
    with pytest.raises(ValueError, match=message):
        tracker.init(Frame(depth=DEPTH[::2, ::2]), (20, 10, 15, 30))
    assert tracker.update(NEXT) == EXPECTED


@pytest.mark.parametrize("camera", cases.NO_CAMERAS, ids=lambda each: type(each).__name__)
def test_what_is_no_camera_is_named(camera):
    """Intrinsics of another type are a TypeError that names them."""
    with pytest.raises(TypeError, match=r"^intrinsics: expected tricue.Intrinsics, got "):
        DepthParticleTracker(intrinsics=camera)


GAPS = {"NaN": np.nan, "0": 0, "negative": -2.5, "infinite": np.inf, "minus infinite": -np.inf}


@pytest.mark.parametrize("value", GAPS.values(), ids=GAPS)
def test_a_frame_of_gaps_is_an_occlusion(value):
    """A frame in which nothing is measured is OCCLUDED at score 0, no error; the next is TRACKED again."""
    tracker = started()
    hidden = tracker.update(Frame(depth=np.full_like(DEPTH, value)))
    assert hidden.status is Status.OCCLUDED
    assert hidden.score == 0
    assert tracker.update(NEXT).status is Status.TRACKED


@pytest.mark.parametrize("value", GAPS.values(), ids=GAPS)
def test_nothing_is_no_target(value):
    """Init on a frame in which nothing is measured names the box, with one and without, says what it
    expected, and leaves the state.
    """
    tracker, frame = started(), Frame(depth=np.full_like(DEPTH, value))
    with pytest.raises(ValueError, match=r"^box: expected a target with measured depth .* got none in \(40"):
        tracker.init(frame, BOX)
    with pytest.raises(
        ValueError, match=r"^box: expected .* nobody was found .*, nor anything else above the"
    ):
        tracker.init(frame)
    assert tracker.update(NEXT) == EXPECTED


@pytest.mark.parametrize("meters", [0.2, 9.0])
def test_a_box_on_what_is_out_of_range_is_named(meters):
    """A box on what is nearer or farther than a target can be is an error that says the range."""
    depth = DEPTH.copy()
    depth[20:80, 80:110] = meters
    with pytest.raises(ValueError, match=r"^box: expected .* between near and far, 0.3 and 8 m, got none"):
        started().init(Frame(depth=depth), (80, 20, 30, 60))


@pytest.mark.parametrize("value", GAPS.values(), ids=GAPS)
def test_gaps_of_all_kinds_are_the_same(value):
    """NaN, 0, negative and infinite pixels among measured ones give the same track, bit for bit."""
    frames = [np.nan_to_num(hall(shift), nan=value) for shift in (0, 1, 2)]
    tracker = DepthParticleTracker(intrinsics=CAMERA, seed=1, particles=30)
    tracker.init(Frame(depth=frames[0]), BOX)
    tracker.update(Frame(depth=frames[1]))
    assert tracker.update(Frame(depth=frames[2])) == EXPECTED


@pytest.mark.parametrize("kind", [np.uint16, np.int16, np.int32, np.int64, ">u2", np.float32, np.float64])
def test_any_type_of_number_is_followed(kind):
    """Millimeters of every type with their scale are followed as meters are, within what their rounding
    costs.
    """
    tracker = DepthParticleTracker(intrinsics=CAMERA, seed=1, particles=30)
    for shift in (0, 1, 2):
        units = np.nan_to_num(1000 * hall(shift)).astype(kind)
        frame = Frame(depth=units, depth_scale=0.001)
        track = tracker.update(frame) if shift else tracker.init(frame, BOX)
    assert track.status is Status.TRACKED
    assert track.position == pytest.approx(EXPECTED.position, abs=1e-4)


def test_color_of_another_size_does_not_matter():
    """Color images beside the depth, of any size, also of another in the next frame, change nothing: boxes
    and intrinsics are the depth's.
    """
    tracker = DepthParticleTracker(intrinsics=CAMERA, seed=1, particles=30)
    tracker.init(Frame(np.zeros((480, 640, 3), np.uint8), DEPTH), BOX)
    tracker.update(Frame(np.zeros((10, 20), np.uint8), hall(1)))
    assert tracker.update(Frame(np.zeros((720, 1280, 3), np.uint8), hall(2))) == EXPECTED


def test_the_color_cameras_intrinsics_are_named():
    """Intrinsics of the color image, of another size than the depth's, are an error that says whose they
    should be.
    """
    tracker = DepthParticleTracker(intrinsics=Intrinsics.from_fov(640, 480, 60))
    message = (
        r"^frame.depth: expected the camera's size, 640x480, got 128x96; the intrinsics are those of the d"
    )
    with pytest.raises(ValueError, match=message):
        tracker.init(Frame(np.zeros((480, 640, 3), np.uint8), DEPTH), BOX)


@pytest.mark.parametrize("seconds", cases.ODD_TIMES, ids=str)
def test_odd_times_are_sane(seconds):
    """Times that stand still, go back, leap or are missing give sane tracks."""
    tracker = DepthParticleTracker(intrinsics=CAMERA, seed=1, particles=30)
    tracker.init(Frame(depth=DEPTH, timestamp=seconds[0]), BOX)
    for shift in (1, 2):
        cases.assert_sane(tracker.update(Frame(depth=hall(shift), timestamp=seconds[1])))


def test_meters_as_millimeters_are_warned_of():
    """Meters with the scale of millimeters make the Frame warn; the tracker misses its target, and goes
    on.
    """
    with pytest.warns(UserWarning, match=r"^depth: its median is about 0.006 m, .* wrong depth_scale, 0.001"):
        frame = Frame(depth=DEPTH, depth_scale=0.001)
    tracker = started()
    assert tracker.update(frame).status is Status.OCCLUDED
    with pytest.raises(ValueError, match=r"^box: expected .* between near and far, 0.3 and 8 m, got none"):
        tracker.init(frame, BOX)
    assert tracker.update(NEXT).status is Status.TRACKED


def test_millimeters_as_meters_are_warned_of():
    """Millimeters passed as meters make the Frame warn; the tracker misses its target, and goes on."""
    with pytest.warns(UserWarning, match=r"^depth: its median is .*looks like millimeters"):
        frame = Frame(depth=MILLIMETERS.astype(np.float32))
    tracker = started()
    track = tracker.update(frame)
    cases.assert_sane(track)
    assert track.status is Status.OCCLUDED
    with pytest.raises(ValueError, match=r"^box: expected"):
        tracker.init(frame, BOX)
    assert tracker.update(NEXT).status is Status.TRACKED


@pytest.mark.parametrize("name", VIEWS)
def test_views_are_read_as_they_look(name):
    """Crops, mirrored, read-only and byte-swapped arrays give the track of a packed copy, bit for bit."""
    tracks = []
    for layout in (VIEWS[name], lambda depth: np.array(VIEWS[name](depth), np.float32, order="C")):
        tracker = DepthParticleTracker(seed=1, particles=30, intrinsics=CAMERA)
        first = tracker.init(Frame(depth=layout(DEPTH)), BOX)
        tracks.append([first, tracker.update(Frame(depth=layout(hall(2))))])
    assert tracks[0] == tracks[1]


@pytest.mark.parametrize("name", GOOD_BOXES)
def test_odd_boxes_are_followed(name):
    """Boxes of other number types, very small, reaching over the edge or larger than the image give sane
    tracks.
    """
    tracker = DepthParticleTracker(seed=1, particles=30, intrinsics=CAMERA)
    first = tracker.init(Frame(depth=DEPTH), GOOD_BOXES[name])
    assert first.box == pytest.approx(tuple(map(float, GOOD_BOXES[name])))
    for shift in range(8):
        cases.assert_sane(tracker.update(Frame(depth=hall(shift))))


FORMS = pytest.mark.parametrize(
    "form", [{}, {"histogram": "absolute", "likelihood": "linear"}], ids=["usual", "printed"]
)


@pytest.mark.parametrize("name", FRAMES)
@FORMS
def test_odd_frames_are_sane(name, form):
    """Empty, uniform, noisy and extreme frames give sane tracks until long lost, as the next good one."""
    frame = odd(name)
    tracker = started(particles=20, lost_after=0.2, **form)
    for _ in range(6):
        cases.assert_sane(tracker.update(frame))
    cases.assert_sane(tracker.update(NEXT))


@pytest.mark.parametrize("name", FRAMES)
@FORMS
def test_odd_frames_are_sane_to_the_twins(name, form):
    """The same of the reference kernels, on a quarter of the pixels."""
    width, height = CAMERA.width // 2, CAMERA.height // 2
    tracker = DepthParticleTracker(
        intrinsics=Intrinsics(CAMERA.fx / 2, CAMERA.fy / 2, CAMERA.cx / 2, CAMERA.cy / 2, width, height),
        kernels="reference",
        seed=1,
        particles=20,
        lost_after=0.2,
        **form,
    )
    frame = odd(name).depth[::2, ::2]
    tracker.init(Frame(depth=DEPTH[::2, ::2]), tuple(side / 2 for side in BOX))
    for depth in 6 * [frame]:
        with warnings.catch_warnings():
            warnings.filterwarnings("ignore", "depth: its median", UserWarning)
            cases.assert_sane(tracker.update(Frame(depth=depth)))
    cases.assert_sane(tracker.update(Frame(depth=hall(2)[::2, ::2])))


@pytest.mark.parametrize("name", FRAMES)
def test_starts_on_odd_frames_are_sane(name):
    """A box on an odd frame is refused by name or gives sane tracks, there and on good frames."""
    frame = odd(name)
    tracker = DepthParticleTracker(seed=1, particles=20, intrinsics=CAMERA)
    cases.sane_from(tracker, frame, BOX, [frame, NEXT, NEXT, NEXT, frame, NEXT])


@pytest.mark.parametrize("shape", cases.ANY_SHAPES, ids=str)
def test_images_of_any_size(shape):
    """Tiny, thin and huge images give sane tracks from a box over them, or name the box."""
    height, width = shape
    depth = np.full(shape, 5.0, np.float32)
    depth[height // 4 : height // 4 + height // 2 + 1, width // 3 : width // 3 + width // 3 + 1] = 2.5
    tracker = DepthParticleTracker(seed=1, particles=20, intrinsics=Intrinsics.from_fov(width, height, 60))
    box = (width / 3 - 1, height / 4 - 1, width / 3 + 2, height / 2 + 2)
    cases.assert_sane(tracker.init(Frame(depth=depth), box))
    for _ in range(3):
        cases.assert_sane(tracker.update(Frame(depth=depth)))


@pytest.mark.parametrize("shape", [(1, 1), (3, 3), (1, 300)], ids=str)
def test_nobody_is_in_a_tiny_image(shape):
    """Without a box an image of a few pixels has nobody in it, and says so."""
    with pytest.raises(ValueError, match=r"^box: expected .*nobody was found"):
        DepthParticleTracker().init(Frame(depth=np.full(shape, 2.5)))


@pytest.mark.parametrize("kernel", ["find_foreground", "segment_depth", "filter_rectangles"])
def test_an_error_inside_leaves_the_state(kernel, monkeypatch: pytest.MonkeyPatch):
    """An error in the middle of an update, of whatever kind, leaves the tracker as it was, random numbers
    included.
    """
    cases.assert_errors_leave_the_state(started(kernels="reference"), kernel, NEXT, monkeypatch)


@settings(max_examples=200)
@given(cases.boxes)
def test_any_four_numbers(box):
    """Whatever four numbers the box is, it is refused by name or gives sane tracks: no crash, no warning."""
    tracker = DepthParticleTracker(seed=1, particles=10, intrinsics=CAMERA)
    cases.sane_from(tracker, Frame(depth=DEPTH), box, [Frame(depth=DEPTH), NEXT])
