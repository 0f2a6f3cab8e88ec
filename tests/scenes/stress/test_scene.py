# SPDX-License-Identifier: MIT
import re
import sys
from functools import cache, lru_cache
from itertools import pairwise

import cv2
import numpy as np
import pytest

pytest.importorskip("skimage", reason="scenes need scikit-image: pip install tricue[demo]")

from tricue.doctor.install import install_extra
from tricue.scenes.stress.scene import STRESS_KINDS, stress_scene
from tricue.scenes.stress.stage import StressStage

SIZE = 160, 120  # half of the default: nothing here depends on it


@lru_cache(maxsize=16)
def scene(kind, seed=0, channels="color", noise=0.0):
    """A scene, without noise in its color images."""
    return stress_scene(kind, seed, SIZE, channels, noise=noise)


@cache
def moves(kind, seed):
    """What happens in a scene, without its pictures."""
    return StressStage.build(kind, seed, SIZE).motion


def sizes(made):
    """The geometric mean of each box's sides, (N,)."""
    return np.sqrt(made.boxes[:, 2] * made.boxes[:, 3])


def middles(boxes):
    """The boxes' middles (N, 2)."""
    return boxes[:, :2] + boxes[:, 2:] / 2


def runs(true):
    """The lengths of the runs of True."""
    edges = np.flatnonzero(np.diff(np.concatenate([[0], true.astype(int), [0]])))
    return (edges[1::2] - edges[::2]).tolist()


@pytest.mark.parametrize("kind", STRESS_KINDS)
def test_the_target_begins_whole_and_alone(kind):
    """In the first frame of every kind the whole target is seen, and no look-alike."""
    for seed in (3, 4):
        truth = StressStage.build(kind, seed, (80, 80)).truth_at(0)
        assert truth.visible == 1
        assert np.isnan(truth.boxes[1:]).all()


@pytest.mark.parametrize("kind", ["fast", "scale", "all"])  # "all" has the events of all others
def test_seed_decides_everything(kind):
    """One seed gives one scene bit for bit, another seed another one."""
    first, again, other = (stress_scene(kind, seed, (80, 80)) for seed in (3, 3, 4))
    assert np.array_equal(first.boxes, again.boxes, equal_nan=True)
    assert all(np.array_equal(a.color, b.color) for a, b in zip(first.frames, again.frames, strict=True))
    assert not np.array_equal(first.boxes, other.boxes, equal_nan=True)
    assert not np.array_equal(first.frames[0].color, other.frames[0].color)


@pytest.mark.parametrize("seed", range(3))
def test_boxes_fit_the_pixels(seed):
    """While the target is seen whole, its box is that of its pixels to within one; else it holds them."""
    made = scene("all", seed)
    for box, visible, mask in zip(made.boxes, made.visible, made.masks, strict=True):
        if visible == 0:
            assert not mask.any()
            continue
        rows, columns = np.nonzero(mask)
        found = np.array([columns.min(), rows.min(), columns.max() + 1, rows.max() + 1])
        true = np.concatenate([box[:2], box[:2] + box[2:]])
        if visible == 1:
            assert np.abs(found - true).max() < 1
        assert (found[:2] > true[:2] - 1).all()
        assert (found[2:] < true[2:] + 1).all()


def test_truth_is_absent_or_whole():
    """Boxes and positions are NaN together, and where they are nothing is seen."""
    for kind in ("leaving", "blank", "all"):
        made = scene(kind)
        absent = np.isnan(made.boxes).any(axis=1)
        assert np.array_equal(absent, np.isnan(made.boxes).all(axis=1))
        assert np.array_equal(absent, np.isnan(made.positions).all(axis=1))
        assert (made.visible[absent] == 0).all()
        assert ((made.visible >= 0) & (made.visible <= 1)).all()


def test_everything_happens_in_any_order():
    """Of "all" each seed has every event within 300 frames, one after the other, and orders differ."""
    orders = set()
    for seed in range(4):
        made = scene("all", seed)
        spans = sorted(made.spans.items(), key=lambda item: item[1].start)
        assert len(made.frames) == 300
        assert {name for name, _ in spans} == set(STRESS_KINDS) - {"plain", "fast", "scale", "all"}
        assert all(a[1].stop <= b[1].start for a, b in pairwise(spans))
        orders.add(tuple(name for name, _ in spans))
        assert np.nanmax(made.positions[:, 2]) / np.nanmin(made.positions[:, 2]) > 3.5
        assert (made.visible == 0).sum() == 30 + 20 + 8 + 24
    assert len(orders) == 4


@pytest.mark.parametrize("kind", ["plain", "scale", "hidden"])
def test_positions_project_onto_the_boxes(kind):
    """The target's position, projected, is the middle of its box, and its size goes as 1 / Z."""
    made = scene(kind)
    projected = made.intrinsics.project(made.positions) + 0.5
    assert np.abs(projected - middles(made.boxes)).max() < 0.03 * made.boxes[:, 2:].max()
    # Rolls and turns change the box by a sixth or less.
    extent = sizes(made) * made.positions[:, 2]
    assert np.ptp(extent) < 0.25 * extent.mean()


@pytest.mark.parametrize("seed", range(3))
def test_leaving_lasts_30_frames(seed):
    """The target is out of the picture for 30 frames on end and comes back half a picture's height away."""
    made = scene("leaving", seed)
    gone = np.isnan(made.boxes).any(axis=1)
    assert runs(gone) == [30]
    assert np.array_equal(gone, made.visible == 0)
    first, last = np.flatnonzero(gone)[[0, -1]]
    out, back = middles(made.boxes)[[first - 1, last + 1]]
    assert np.hypot(*(out - back)) > SIZE[1] / 2
    for middle in (out, back):  # over an edge
        assert ((middle < 0) | (middle > SIZE)).any()
    steps = np.hypot(*np.diff(middles(made.boxes), axis=0).T)
    assert np.nanmax(steps) < 0.4 * np.nanmax(made.boxes[:, 2:])


@pytest.mark.parametrize("kind", ["leaving", "hidden"])
@pytest.mark.parametrize("away", [2, 45])
def test_it_is_away_for_as_long_as_asked(kind, away):
    """The scene is longer by as many frames; the target is whole before, and again at its end."""
    made, usual = (stress_scene(kind, 1, (80, 80), away=frames) for frames in (away, None))
    gone = made.visible == 0
    assert runs(gone) == [away]
    assert len(made.frames) - away == len(usual.frames) - int((usual.visible == 0).sum())
    assert (made.visible[[0, -1]] == 1).all()


@pytest.mark.parametrize("seed", range(3))
def test_hiding_lasts_20_frames_behind_something_nearer(seed):
    """For 20 frames on end nothing of the target is seen, where the depth is less than the target's."""
    made = scene("hidden", seed, "rgbd")
    hidden = made.visible == 0
    assert runs(hidden) == [20]
    assert not np.isnan(made.boxes).any()
    for index in np.flatnonzero(hidden):
        x, y, width, height = made.boxes[index].round().astype(int)
        before = made.frames[index].depth[max(y, 0) : y + height, max(x, 0) : x + width]
        assert np.nanmax(before) < 0.8 * made.positions[index, 2]
    first, last = np.flatnonzero(hidden)[[0, -1]]
    assert made.visible[first - 1] > 0.02
    assert made.visible[last + 1] > 0.02
    assert (made.visible[-10:] == 1).all()


@pytest.mark.parametrize("seed", range(3))
def test_lookalikes_cross_and_stay_nearby(seed):
    """Both come across the target and are mostly within three of its widths, one nearer, one farther."""
    made = scene("lookalike", seed)
    inside = slice(made.spans["lookalike"].start + 25, made.spans["lookalike"].stop - 20)
    width = made.boxes[:, 2].mean()
    ratios = []
    for boxes in made.lookalikes:
        offset = (middles(boxes) - middles(made.boxes))[inside]
        assert np.nanmin(offset[:, 0]) < 0 < np.nanmax(offset[:, 0])
        assert np.nanmin(np.abs(offset[:, 0])) < 0.3 * width
        assert np.mean(np.hypot(*offset.T) < 3 * width) > 0.6
        ratios.append(np.nanmedian(boxes[:, 3] / made.boxes[:, 3]))
    assert min(ratios) < 0.92
    assert max(ratios) > 1.08
    assert made.visible.min() > 0


def test_lookalikes_share_colors_or_structure():
    """The first has the target's histogram but other pixels, the second its lightness but another hue."""
    made = {name: [] for name in ("colors", "structure", "other structure", "other colors")}
    for seed in range(6):
        target, shuffled, recolored = cards(seed)
        made["colors"].append(likeness(target, shuffled))
        made["other colors"].append(likeness(target, recolored))
        made["other structure"].append(correlation(target, shuffled))
        made["structure"].append(correlation(target, recolored))
    assert min(made["colors"]) > 0.85
    assert max(made["other colors"]) < 0.5
    assert max(made["other structure"]) < 0.6
    assert min(made["structure"]) > 0.9


def cards(seed):
    """The pictures of the target and its look-alikes, (h, w, 3) in [0, 255]."""
    made = moves("lookalike", seed)
    return [path.card.levels[0] for path in (made.target, *made.lookalikes)]


def likeness(first, second):
    """The intersection of two histograms over what is opaque."""
    counts = []
    for picture in (first, second):
        pixels = picture[picture[..., 3] == 1][:, :3]
        count, _ = np.histogramdd(pixels, bins=8, range=[(0, 256)] * 3)
        counts.append(count / count.sum())
    return np.minimum(*counts).sum()


def correlation(first, second):
    """Of the gray levels, over what is opaque in both."""
    both = (first[..., 3] == 1) & (second[..., 3] == 1)
    weights = np.array([0.114, 0.587, 0.299])
    return np.corrcoef(first[both][:, :3] @ weights, second[both][:, :3] @ weights)[0, 1]


def test_light_changes_the_target_by_the_told_factor():
    """Each channel of the target's pixels is the plain scene's times the gain; gains span 0.4 to 1.3."""
    made, plain = (scene(kind, 5) for kind in ("light", "plain"))
    assert np.array_equal(made.boxes, plain.boxes)
    for index in range(0, 120, 9):
        mask = made.masks[index]
        lit, unlit = (s.frames[index].color[mask].astype(float) for s in (made, plain))
        for channel in range(3):
            kept = (lit[:, channel] < 250) & (unlit[:, channel] < 250) & (unlit[:, channel] > 30)
            ratio = lit[kept, channel].sum() / unlit[kept, channel].sum()
            assert ratio == pytest.approx(made.light[index, channel], rel=0.01)
    gains = np.concatenate([moves("light", seed).light.mean(axis=1) for seed in range(8)])
    assert 0.39 < gains.min() < 0.55
    assert 1.1 < gains.max() < 1.31
    jumps = np.abs(np.diff(np.log(made.light.mean(axis=1)))) > 0.1
    assert 3 <= jumps.sum() <= 12


@pytest.mark.parametrize("seed", range(3))
def test_size_changes_by_four(seed):
    """Between the ends and the middle of the scene the distance changes 1:4, and the size with it."""
    made = scene("scale", seed)
    distance, size = made.positions[:, 2], sizes(made)
    for index in (0, 240):
        ratio = distance[index] / distance[120]
        assert max(ratio, 1 / ratio) == pytest.approx(4)
        # The box round a card that rolls and turns differs by a tenth or so.
        assert size[120] / size[index] == pytest.approx(ratio, rel=0.2)


def test_camera_moves_the_background():
    """The first picture, seen by a camera turned as told, is the later one but for the target; no other kind
    moves the room.
    """
    made, plain = scene("camera", 1), scene("plain", 1)
    for index in (30, 66, 90):
        assert apart(plain, index, plain.frames[0].color) < 0.2
        camera, rotation = made.intrinsics.matrix, moves("camera", 1).rotation(index)
        room = made.frames[0].color * ~near(made.masks[0])[..., None]
        moved = cv2.warpPerspective(room, camera @ rotation @ np.linalg.inv(camera), SIZE)
        assert apart(made, index, moved) < 3
        assert apart(made, index, made.frames[0].color) > 6


def apart(made, index, picture):
    """The median difference between a frame and a picture of the room, where the target never was."""
    free = ~near(made.masks[0]) & ~near(made.masks[index])
    free &= cv2.erode(picture.any(axis=2).astype(np.uint8), np.ones((5, 5))) > 0  # what was seen at first
    return np.median(np.abs(made.frames[index].color.astype(int) - picture)[free].mean(axis=1))


def near(mask):
    """A mask and what lies within 5 pixels."""
    return cv2.dilate(mask.astype(np.uint8), np.ones((11, 11))) > 0


@pytest.mark.parametrize("seed", range(4))
def test_blank_is_black_and_another_scene(seed):
    """Eight frames without light or depth, 24 with another picture beside them, then the old one again."""
    made = scene("blank", seed, "rgbd")
    black = np.array([frame.color.max() == 0 for frame in made.frames])
    assert runs(black) == [8]
    assert all(np.isnan(made.frames[index].depth).all() for index in np.flatnonzero(black))
    in_other_room = np.isnan(made.boxes).any(axis=1)
    assert runs(in_other_room) == [24]
    assert runs(black | in_other_room) == [32]
    assert np.array_equal(made.visible == 0, black | in_other_room)
    inside = int(np.flatnonzero(in_other_room)[0])
    first, other, last = (made.frames[index].color.astype(float) for index in (0, inside, -1))
    assert np.corrcoef(first.ravel(), other.ravel())[0, 1] < 0.6
    assert np.corrcoef(first.ravel(), last.ravel())[0, 1] > 0.8


def test_the_other_scene_comes_before_or_after_the_black():
    """Both orders are met, so that each break can be measured by itself."""
    orders = {
        int(np.argmax(m.black)) < int(np.argmax(m.in_other_room))
        for m in (moves("blank", s) for s in range(8))
    }
    assert orders == {True, False}


def test_fast_and_plain_keep_their_speed():
    """No step is over half of the target's width in "fast", or over a tenth in "plain"; "fast" nears it."""
    steps = {"fast": [], "plain": []}
    for kind, longest in steps.items():
        for seed in range(8):
            camera, path = moves(kind, seed).camera, moves(kind, seed).target
            width = path.card.size[0] * camera.fx / path.depth
            longest.append((np.hypot(*np.diff(path.pixels, axis=0).T) / width[1:]).max())
    assert max(steps["plain"]) < 0.1
    assert 0.4 < max(steps["fast"]) < 0.6


def test_channels_share_color_and_truth():
    """Whatever is asked for, the color images, the depths and the truth of a seed are the same."""
    color, rgbd, stereo, depth = (
        stress_scene("hidden", 4, (80, 80), c) for c in ("color", "rgbd", "stereo", "depth")
    )
    for made, channels in ((rgbd, ("color", "depth")), (stereo, ("color", "right")), (depth, ("depth",))):
        assert {frame.channels for frame in made.frames} == {channels}
        assert np.array_equal(made.boxes, color.boxes)
        assert np.array_equal(made.positions, color.positions)
        if "color" in channels:
            pairs = zip(made.frames, color.frames, strict=True)
            assert all(np.array_equal(a.color, b.color) for a, b in pairs)
    pairs = zip(rgbd.frames, depth.frames, strict=True)
    assert all(np.array_equal(a.depth, b.depth, equal_nan=True) for a, b in pairs)
    assert (color.rig, rgbd.rig) == (None, None)
    assert stereo.rig.intrinsics == color.intrinsics


def test_a_shutter_blurs_what_moves_and_nothing_else():
    """With an open shutter the target's edges are softer, the static room stays, and the truth too."""
    sharp, blurred = (stress_scene("fast", 1, SIZE, noise=0, shutter=shutter) for shutter in (0.0, 1.0))
    assert np.array_equal(sharp.boxes, blurred.boxes)
    index = int(np.argmax(np.hypot(*np.diff(middles(sharp.boxes), axis=0).T)))
    away = cv2.dilate(sharp.masks[index].astype(np.uint8), np.ones((61, 61))) == 0
    detail = []
    for made in (sharp, blurred):
        gray = cv2.cvtColor(made.frames[index].color, cv2.COLOR_BGR2GRAY).astype(float)
        detail.append(np.abs(np.gradient(gray, axis=1))[made.masks[index]].mean())
    assert detail[1] < 0.8 * detail[0]
    assert np.array_equal(sharp.frames[index].color[away], blurred.frames[index].color[away])


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"kind": "rain"}, "kind: expected one of plain, fast, .* got 'rain'"),
        ({"channels": "rgb"}, "channels: expected one of color, rgbd, stereo, depth, got 'rgb'"),
        ({"seed": -1}, "seed: expected a whole number from 0, got -1"),
        ({"size": (320, 40)}, "size: expected width and height of 80 pixels or more"),
        ({"noise": -1.0}, "noise: expected levels of 255, 0 or more, got -1.0"),
        ({"away": 30}, "away: expected none for the kind all, got 30"),
        ({"kind": "hidden", "away": 1}, "away: expected 2 frames or more, got 1"),
        ({"kind": "hidden", "away": 0}, "away: expected .* got 0"),
        ({"shutter": 1.5}, "shutter: expected a share from 0 to 1, got 1.5"),
    ],
)
def test_bad_arguments_are_named(arguments, words):
    """Arguments that no scene can be made of are refused by name."""
    with pytest.raises(ValueError, match=words):
        stress_scene(**arguments)


def test_missing_scikit_image_names_the_extra(monkeypatch):
    """Without scikit-image the error says how to install it."""
    monkeypatch.setitem(sys.modules, "skimage", None)
    with pytest.raises(ImportError, match=re.escape(install_extra("demo"))):
        stress_scene("plain")
