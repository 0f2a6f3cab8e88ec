# SPDX-License-Identifier: MIT
import re
import sys

import numpy as np
import pytest
from tricue import scenes
from tricue.doctor.install import install_extra

pytest.importorskip("skimage", reason="scenes need scikit-image: pip install tricue[demo]")

SEEDED = [
    scenes.crossing,
    scenes.face_over_clutter,
    scenes.hand,
    scenes.head,
    scenes.hidden_face,
    scenes.jump,
    scenes.light_change,
    scenes.lit_walker,
    scenes.overtaking,
    scenes.pan_tilt_scene,
    scenes.room_scene,
    scenes.skin_picture,
    scenes.static_head,
    scenes.stress_scene,
    scenes.walker,
]


def centers(scene):
    """The centers of the true boxes, (M, 2)."""
    return np.array([box.center for box in scene.boxes])


def face_pixels(scene, index):
    """The pixels inside the ellipse of the true box, (n, 3)."""
    image = scene.frames[index].color
    x, y, minor, major = scene.boxes[index].ellipse
    rows, columns = np.indices(image.shape[:2]) + 0.5
    return image[((columns - x) / minor) ** 2 + ((rows - y) / major) ** 2 < 0.8]


@pytest.mark.parametrize("make", [scenes.face_over_clutter, scenes.light_change])
def test_seed_decides_everything(make):
    """One seed gives one scene bit for bit; another seed gives another path and other pixels."""
    first, again, other = make(3, frames=40), make(3, frames=40), make(4, frames=40)
    assert first.boxes == again.boxes
    assert first.changes == again.changes
    assert all(np.array_equal(a.color, b.color) for a, b in zip(first.frames, again.frames, strict=True))
    assert first.boxes != other.boxes
    assert not np.array_equal(first.frames[0].color, other.frames[0].color)


@pytest.mark.parametrize("background", scenes.BACKGROUNDS)
def test_face_stays_in_the_picture_at_its_size(background):
    """On every background all 90 boxes are 50x63 and inside the picture, and no step is over 16 px."""
    scene = scenes.face_over_clutter(1, background=background)
    assert len(scene.frames) == len(scene.boxes) == 90
    for frame, box in zip(scene.frames, scene.boxes, strict=True):
        assert frame.color.shape == (240, 320, 3)
        assert (box.width, box.height) == (50, 63)
        assert box.clip(320, 240) == pytest.approx(box)
    assert np.hypot(*np.diff(centers(scene), axis=0).T).max() <= 16


def test_only_the_box_differs_from_the_background():
    """Without noise, the pixels that differ from their median lie in the true box and nearly fill it."""
    scene = scenes.face_over_clutter(2, background="motorcycle", noise=0, brightness=(0.45, 0.46))
    images = np.stack([frame.color for frame in scene.frames]).astype(np.int16)
    static = np.median(images, axis=0)
    for index in (30, 60, 89):
        rows, columns = np.nonzero(np.abs(images[index] - static).max(axis=2) > 3)
        left, top, right, bottom = scene.boxes[index].xyxy
        assert left - 1 < columns.min() < left + 4
        assert right - 4 < columns.max() + 1 < right + 1
        assert top - 1 < rows.min() < top + 4
        assert bottom - 4 < rows.max() + 1 < bottom + 1


def test_brightness_of_the_face_steps_at_the_changes():
    """The face's mean level jumps by 10 % or more at each change, and by less than 1 % elsewhere."""
    scene = scenes.face_over_clutter(5, background="cat", max_speed=3.0)
    level = np.array([face_pixels(scene, index).mean() for index in range(90)])
    ratio = np.abs(np.log(level[1:] / level[:-1]))
    jumps = np.array(scene.changes) - 1
    assert len(jumps) >= 4
    assert ratio[jumps].min() > 0.1
    assert np.delete(ratio, jumps).max() < 0.01


def test_light_changes_the_colors_of_face_and_cabin_at_once():
    """At each change the face's and the cabin's color balance jump in one frame, and at no other frame."""
    scene = scenes.light_change(7)
    face = np.array([face_pixels(scene, index).mean(axis=0) for index in range(90)])
    corner = np.array([frame.color[180:, :80].mean(axis=(0, 1)) for frame in scene.frames])
    jumps = np.array(scene.changes) - 1
    assert len(jumps) == 2
    for color in (face, corner):
        balance = np.log(color[:, 2] / color[:, 0])
        step = np.abs(np.diff(balance))
        assert step[jumps].min() > 0.2
        assert np.delete(step, jumps).max() < 0.05


def test_light_keeps_the_order_of_levels():
    """Without noise, no two pixels of the cabin swap their order in a channel when the light changes."""
    scene = scenes.light_change(7, noise=0)
    change = scene.changes[0]
    before, after = (scene.frames[index].color[180:, :].reshape(-1, 3) for index in (change - 1, change))
    for channel in range(3):
        order = np.argsort(before[:, channel], kind="stable")
        sorted_before, sorted_after = before[order, channel], after[order, channel]
        rising = np.diff(sorted_before) > 0
        upper = np.maximum.accumulate(sorted_after)
        assert np.all(sorted_after[1:][rising] >= upper[:-1][rising])


def test_head_moves_slowly_and_stays_inside():
    """The driver's face moves at most 6 px a frame and stays in the picture."""
    scene = scenes.light_change(1)
    assert np.hypot(*np.diff(centers(scene), axis=0).T).max() <= 6
    assert all(box.clip(320, 240) == pytest.approx(box) for box in scene.boxes)


def test_unknown_background_is_named():
    """A background that isn't there is refused, and those that are there are listed."""
    with pytest.raises(ValueError, match=r"background: expected one of coffee, cat, .* got 'moon'"):
        scenes.face_over_clutter(background="moon")


@pytest.mark.parametrize(
    ("make", "arguments", "words"),
    [
        (scenes.face_over_clutter, {"frames": 0}, "frames: expected a count above 0, got 0"),
        (
            scenes.face_over_clutter,
            {"noise": np.nan},
            "noise: expected a finite number, levels of 255, got nan",
        ),
        (scenes.light_change, {"noise": -1.0}, "noise: expected levels of 255, 0 or more, got -1.0"),
        (scenes.light_change, {"max_speed": 0.0}, "max_speed: expected pixels per frame above 0"),
        (scenes.face_over_clutter, {"max_speed": np.nan}, "max_speed: expected a finite number"),
        (
            scenes.face_over_clutter,
            {"brightness": (1.0, 0.5)},
            "brightness: expected a low and a higher gain",
        ),
        (scenes.face_over_clutter, {"brightness": (1.0,)}, "brightness: expected a low and a higher gain"),
        (scenes.static_head, {"aside": (0.1,)}, "aside: expected two shares of half the view"),
    ],
)
def test_bad_arguments_are_named(make, arguments, words):
    """Arguments that no scene can be made of are refused by name."""
    with pytest.raises(ValueError, match=words):
        make(**arguments)


@pytest.mark.parametrize(
    ("make", "arguments"),
    [
        (scenes.face_over_clutter, {"frames": "3"}),
        (scenes.light_change, {"frames": 1.5}),
        (scenes.light_change, {"max_speed": "fast"}),
        (scenes.face_over_clutter, {"brightness": 1.0}),
        (scenes.static_head, {"aside": 0.1}),
        (scenes.stress_scene, {"size": 320}),
        (scenes.room_scene, {"size": None}),
    ],
)
def test_arguments_of_a_wrong_type_are_named(make, arguments):
    """A number, text or None where something else is expected is refused by the argument's name."""
    with pytest.raises(TypeError, match=f"^{next(iter(arguments))}: expected"):
        make(**arguments)


@pytest.mark.parametrize("seed", [-1, 1.5, None, "1"])
@pytest.mark.parametrize("make", SEEDED, ids=lambda make: make.__name__)
def test_bad_seeds_are_named(make, seed):
    """A seed is a whole number: None, which numpy takes, would give another scene each time."""
    with pytest.raises(ValueError, match=rf"seed: expected a whole number from 0, got {seed!r}"):
        make(seed=seed)


@pytest.mark.parametrize("make", [scenes.face_over_clutter, scenes.light_change])
def test_short_scenes_are_scenes(make):
    """A scene of one frame has one true box, and nothing changes in it."""
    scene = make(frames=1)
    assert len(scene.frames) == len(scene.boxes) == 1
    assert scene.changes == ()


@pytest.mark.parametrize(("frames", "changes"), [(2, (1,)), (3, (1, 2))])
def test_light_changes_of_short_scenes(frames, changes):
    """The light can't change in the first frame."""
    assert scenes.light_change(frames=frames).changes == changes


def test_missing_scikit_image_names_the_extra(monkeypatch):
    """Without scikit-image the error says how to install it."""
    monkeypatch.setitem(sys.modules, "skimage", None)
    with pytest.raises(ImportError, match=re.escape(install_extra("demo"))):
        scenes.light_change()
