# SPDX-License-Identifier: MIT
"""The hand, the hidden face and the jump: their truth, and that the seed decides everything."""

import numpy as np
import pytest
from tricue.scenes import hand, hidden_face, jump, skin_picture
from tricue.scenes.indoors import gestures, picture
from tricue.scenes.indoors import jump as jumping
from tricue.scenes.indoors.picture import Layer, blur, shift

FRAMES = 2


@pytest.mark.parametrize("make", [hand, hidden_face, jump])
def test_seed_decides_everything(make, rendered):
    """One seed gives one scene, bit for bit, and another seed another; boxes are inside the image."""
    first, again, other = rendered(make, 3, FRAMES), make(3, FRAMES), rendered(make, 4, FRAMES)
    assert first.boxes == again.boxes
    assert all(np.array_equal(a.color, b.color) for a, b in zip(first.frames, again.frames, strict=True))
    assert not np.array_equal(first.frames[0].color, other.frames[0].color)
    for frame, box in zip(first.frames, first.boxes, strict=True):
        assert frame.color.shape == (240, 320, 3)
        assert box.clip(320, 240) == box


def test_the_box_is_round_what_the_hand_covers(monkeypatch):
    """Of two images, one without the hand, the pixels above the wrist that differ fill the true box."""
    scene = hand(1, 1, noise=0)
    whole = gestures._layers

    def without_hand(*arguments):
        person, palm, *masks = whole(*arguments)
        nothing = Layer(*(np.zeros_like(each) for each in palm))
        return person, nothing, *masks

    monkeypatch.setattr(gestures, "_layers", without_hand)
    empty = hand(1, 1, noise=0)
    changed = np.abs(scene.frames[0].color.astype(int) - empty.frames[0].color).max(axis=2) > 12
    left, top, right, bottom = map(int, scene.boxes[0].xyxy)
    rows, columns = np.nonzero(changed[:bottom])
    assert abs(rows.min() - top) <= 1
    assert abs(columns.min() - left) <= 1
    assert abs(columns.max() + 1 - right) <= 1
    assert changed[top:bottom, left:right].mean() > 0.35


@pytest.mark.parametrize("seed", range(20))
def test_hands_stay_in_the_image_and_move_as_described(seed):
    """The palm's middle stays 30 px inside, moves at most 12 px a frame; fingers spread and close."""
    moves = gestures._sample_gestures(90, np.random.default_rng(seed))
    pixels = moves.hands[:, :2] / moves.hands[:, 2:] * picture.CAMERA.fx + [
        picture.CAMERA.cx,
        picture.CAMERA.cy,
    ]
    assert pixels.min() > 30
    assert (pixels < [290, 210]).all()
    assert np.hypot(*np.diff(pixels, axis=0).T).max() <= 12
    assert np.ptp(moves.spreads) > 0.4


@pytest.mark.parametrize("seed", range(2))
def test_the_hand_hides_the_face_and_leaves(seed, monkeypatch):
    """Less than 15 % of the head is visible for 8 frames or more, all of it before and at the end."""
    monkeypatch.setattr(gestures, "render_room", lambda *_: np.full((240, 320, 3), 90, np.float32))
    rng, still = gestures._start(seed, 90, 0.0)
    moves = gestures._sample_wiping(90, rng)
    visible = []
    for index in (0, *range(22, 38, 3), 89):
        _, palm, face, _ = gestures._layers(still, moves, index)
        visible.append(float(1 - palm.coverage[face].mean()))
    assert visible[0] == visible[-1] == 1.0
    assert sum(share < 0.15 for share in visible) >= 3  # every third frame


@pytest.mark.parametrize("seed", range(20))
def test_jumps_are_high_and_fast(seed):
    """The head rises by 20 cm or more above where it stands, falls freely, and moves by over 15 px."""
    moves = jumping._sample_jumps(90, np.random.default_rng(seed))
    height = 0.02 - moves.heads[:, 1]
    assert height.max() > 0.2
    assert height.min() < -0.1
    falling = np.diff(height, 2)[height[1:-1] > 0.08] * jumping.FRAME_RATE**2
    assert np.median(falling) == pytest.approx(-9.81, rel=0.05)
    pixels = moves.heads[:, :2] / moves.heads[:, 2:] * picture.CAMERA.fx
    steps = np.hypot(*np.diff(pixels, axis=0).T)
    assert 15 < steps.max() < 40
    assert np.ptp(moves.turns[:, 2]) > 0.2


def test_skin_is_where_the_mask_is():
    """The mask covers the hand and face: its pixels have the skin's hue, which the rest mostly hasn't."""
    image, mask = skin_picture(1)
    blue, green, red = (image[..., i].astype(float) + 1 for i in range(3))
    reddish = (red / green > 1.15) & (green / blue > 1.0)
    assert reddish[mask].mean() > 0.75 > reddish[~mask].mean() + 0.3
    assert 0.05 < mask.mean() < 0.5


def test_shift_and_blur_are_exact():
    """A whole shift moves pixels, half of one averages neighbors, and a blur keeps a constant."""
    noise = np.random.default_rng(0).random((9, 11, 3)).astype(np.float32)
    np.testing.assert_array_equal(shift(noise, 2, -1)[:-1, 2:], noise[1:, :-2])
    np.testing.assert_allclose(shift(noise, 0.5, 0)[:, 1:], (noise[:, 1:] + noise[:, :-1]) / 2, rtol=1e-6)
    np.testing.assert_allclose(blur(np.full((9, 11, 3), 7, np.float32), 1.2), 7, rtol=1e-6)


def test_motion_blur_keeps_the_amount_and_spreads_it():
    """A moving dot has the same total, along the path of its motion."""
    coverage = np.zeros((41, 41), np.float32)
    coverage[20, 20] = 1
    layer = Layer(np.repeat(coverage[..., None], 3, axis=2), coverage, np.full((41, 41), -1), coverage)
    moved = layer.moving(np.array([8.0, 0.0]))
    assert moved.coverage.sum() == pytest.approx(1, abs=1e-5)
    assert moved.coverage[20].sum() == pytest.approx(1, abs=1e-5)
    (columns,) = np.nonzero(moved.coverage[20] > 0.02)
    assert (columns.min(), columns.max()) == (16, 24)
    assert layer.moving(np.zeros(2)) is layer


@pytest.mark.parametrize("make", [hand, hidden_face, jump])
def test_bad_arguments_are_named(make):
    """No frames and negative noise are refused by name."""
    with pytest.raises(ValueError, match=r"^frames: "):
        make(frames=0)
    with pytest.raises(ValueError, match=r"^noise: expected levels of 255"):
        make(noise=-1.0)
