# SPDX-License-Identifier: MIT
"""What the fused tracker's experts look at: pictures of depth, windows; and what opinions come to."""

import numpy as np
import pytest
from tricue import Box, Intrinsics
from tricue import kernels as kernel_sets
from tricue.track.fused.depth_sources import DepthImage
from tricue.track.fused.experts import posterior
from tricue.track.fused.sight import RELIEF, Expected, Sight, shades
from tricue.track.fused.view import PIXELS, Target, View, look

CAMERA = Intrinsics.from_fov(250, 200, 60)


def depths(*metres: float) -> np.ndarray:
    """A depth image of one row."""
    return np.array([metres], np.float32)


def test_shades_by_hand():
    """Gray at the target's depth, black from RELIEF nearer on, white from RELIEF farther on and where nothing
    is measured, in between in proportion.
    """
    picture = shades(depths(2.0, 2 - 2 * RELIEF, 2 - RELIEF / 2, 2 + RELIEF, 9.0, np.nan), 2.0)
    assert picture.shape == (1, 6, 3)
    assert picture.dtype == np.uint8
    assert (picture == picture[..., :1]).all()
    assert picture[0, :, 0].tolist() == pytest.approx([128, 0, 64, 255, 255, 255], abs=1)


def test_shades_do_not_depend_on_the_distance():
    """The same relief at another distance is the same picture, to a level."""
    relief = np.random.default_rng(0).uniform(-0.6, 0.6, (20, 30)).astype(np.float32)
    near, far = (shades(relief + np.float32(z), z).astype(int) for z in (1.0, 6.0))
    assert np.abs(near - far).max() <= 1


def test_shades_brighten_with_distance():
    """What is farther is never darker."""
    levels = shades(np.linspace(0.01, 9, 500, dtype=np.float32)[None], 2.0)[0, :, 0]
    assert (np.diff(levels.astype(int)) >= 0).all()


def test_expecting_shades_anew():
    """One who expects another depth sees another picture of depth, but the same one of color."""
    depth = np.full((10, 10), 3.0, np.float32)
    k = kernel_sets.load("native")
    of_depth = Sight(k, shades(depth, 2.0), "depth", CAMERA, DepthImage(depth), Expected(2.0, 0.1), depth)
    of_color = Sight(k, shades(depth, 2.0), "color", CAMERA, DepthImage(depth), Expected(2.0, 0.1))
    other = Expected(3.0, 0.2)
    assert (of_depth.expecting(other).picture == 128).all()
    assert of_color.expecting(other).picture is of_color.picture
    assert of_color.expecting(other).expected == of_depth.expecting(other).expected == other


def test_depths_by_hand(kernels):
    """P(target | depth) is above 1/2 at what is expected, under it beside it, 1/2 where nothing is measured;
    only what is nearer by more than the margin hides.
    """
    image = np.full((30, 50), 2.0, np.float32)
    image[:, 10:20], image[:, 20:30], image[:, 30:40] = 1.0, 3.0, np.nan
    sight = Sight(
        kernels, np.zeros((30, 50, 3), np.uint8), "color", CAMERA, DepthImage(image), Expected(2.0, 0.05)
    )
    belief, nearer = sight.depths(0.0, 0.0, 1.0, 30)
    assert belief[15, 5] > 0.9
    assert max(belief[15, 15], belief[15, 25]) < 0.1
    assert nearer[15, [5, 15, 25]].tolist() == [0, 1, 0]
    assert belief.shape == (30, 30)
    belief, nearer = sight.depths(30.0, 0.0, 1.0, 30)
    assert belief[15, 5] == 0.5
    assert nearer[15, 5] == 0
    assert (belief[:, 20:] == 0.5).all()  # beyond the image


@pytest.mark.parametrize(("ranger", "expected"), [(None, Expected(2.0, 0.1)), ("there", None)])
def test_no_depths_without_both(ranger, expected, kernels):
    """Without something to measure depth by, or something to expect, depth says nothing."""
    image = np.full((8, 8), 2.0, np.float32)
    sight = Sight(
        kernels,
        np.zeros((8, 8, 3), np.uint8),
        "color",
        CAMERA,
        DepthImage(image) if ranger else None,
        expected,
    )
    assert sight.depths(0.0, 0.0, 1.0, 8) is None


@pytest.mark.parametrize(
    ("sigma", "margin"), [(0.01, 0.25), (0.08, 0.25), (0.1, 0.3), (0.15, 0.45), (0.2, 0.5), (0.49, 0.5)]
)
def test_margin_is_three_deviations(sigma, margin):
    """What hides is nearer by three standard deviations, by a quarter of a metre at least and half of one at
    most.
    """
    assert Expected(2.0, sigma).margin == pytest.approx(margin)


@pytest.mark.parametrize("sigma", [0.5, 2.0])
@pytest.mark.parametrize("z", [0.3, 2.0, 50.0])
def test_nothing_hides_what_may_be_anywhere(z, sigma):
    """Of a depth that is vague nothing is nearer: the margin reaches to the camera."""
    assert Expected(z, sigma).margin == z


def test_target_and_box():
    """A target made of a box gives the box back; moved and scaled it keeps its size and its middle."""
    box = Box(10.0, 20.0, 30.0, 40.0)
    target = Target.of(box)
    assert target.box == pytest.approx(box)
    assert target.side == pytest.approx(np.sqrt(1200))
    assert target.moved(3.0, -2.0).box == pytest.approx((13, 18, 30, 40))
    assert target.scaled(2.0).box.center == box.center
    assert target.scaled(2.0).side == pytest.approx(2 * target.side)


def seen(target: Target, context: float = 3.0) -> View:
    """A window of an image whose pixels tell their place: blue the column, green the row."""
    rows, columns = np.indices((200, 250)).astype(np.uint8)
    picture = np.dstack([columns, rows, np.zeros_like(rows)])
    return look(Sight(kernel_sets.load("native"), picture, "color", CAMERA, None, None), [target], context)[0]


def test_a_window_is_where_it_should_be():
    """A window of 64 pixels a side has its target in the middle, and the image's pixels there."""
    view = seen(Target(120.0, 90.0, 32.0, 32.0), 2.0)  # 64 pixels of the image: one each
    assert view.patch.shape == (PIXELS, PIXELS, 3)
    assert view.unit == 1.0
    assert view.size == (32.0, 32.0)
    assert view.patch[0, 0].tolist() == [88, 58, 0]
    assert view.patch[63, 63].tolist() == [151, 121, 0]


@pytest.mark.parametrize("share", [1.0, 0.8, 0.3])
@pytest.mark.parametrize("offset", [(0.0, 0.0), (6.0, -4.0), (-10.0, 10.0)])
def test_inner_is_the_targets_part(share, offset):
    """Rows and columns of a target so far off the middle are those whose pixels lie in its box, to one."""
    target, (right, down) = Target(120.0, 90.0, 40.0, 24.0), offset
    view = seen(target, 2.0)
    rows, columns = view.inner(right, down, share)
    own = view.patch[rows, columns, :2].reshape(-1, 2).astype(float)
    middle = np.array([120 + view.unit * right, 90 + view.unit * down])
    half = share * np.array([40.0, 24.0]) / 2
    assert own.min(axis=0) + 0.5 == pytest.approx(middle - half, abs=1.5)
    assert own.max(axis=0) + 0.5 == pytest.approx(middle + half, abs=1.5)


@pytest.mark.parametrize("offset", [0.0, 31.0, 40.0, -40.0, 1e6, -1e6])
@pytest.mark.parametrize("size", [(0.01, 0.01), (20.0, 30.0), (1e5, 1e5)])
def test_inner_is_never_empty(offset, size):
    """However far off or small the target is, there is a pixel of it, within the patch."""
    view = View(seen(Target(9, 9, 9, 9)).sight, Target(50, 50, *size), np.zeros((64, 64, 3), np.uint8), 1.0)
    for span in view.inner(offset, -offset, 0.8):
        assert 0 <= span.start < span.stop <= PIXELS


def plane(value: float) -> np.ndarray:
    """(64, 64) of one opinion."""
    return np.full((64, 64), value, np.float32)


def test_posterior_is_bayes_rule():
    """0.8 and 0.6 are odds of 4 and 1.5, together 6, which is 6/7; a third of 0.25 makes it 2/3."""
    np.testing.assert_allclose(posterior([plane(0.8), plane(0.6)]), 6 / 7, rtol=1e-5)
    np.testing.assert_allclose(posterior([plane(0.8), plane(0.6), plane(0.25)]), 2 / 3, rtol=1e-5)


def test_posterior_hears_who_speaks():
    """Of nobody it is None, of one his opinion, and None in between changes nothing."""
    assert posterior([]) is None
    assert posterior([None, None]) is None
    np.testing.assert_array_equal(posterior([None, plane(0.3)]), plane(0.3))
    np.testing.assert_array_equal(
        posterior([plane(0.8), None, plane(0.6)]), posterior([plane(0.8), plane(0.6)])
    )


def test_one_half_is_neutral():
    """An opinion of 1/2 changes no other, whatever the order."""
    some = np.random.default_rng(0).uniform(0.001, 0.999, (64, 64)).astype(np.float32)
    np.testing.assert_allclose(posterior([some, plane(0.5)]), some, rtol=1e-4)
    np.testing.assert_allclose(posterior([plane(0.5), some]), some, rtol=1e-4)


def test_posterior_of_the_sure():
    """Certainties stay certain, contradictions stay finite."""
    assert posterior([plane(1.0), plane(0.3)]).max() == 1
    assert posterior([plane(0.0), plane(0.7)]).max() == 0
    assert np.isfinite(posterior([plane(1.0), plane(0.0)])).all()
