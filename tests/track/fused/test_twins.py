# SPDX-License-Identifier: MIT
"""What the fused tracker's twins compute, against truths in closed form."""

import numpy as np
import pytest
from tricue.track.fused import twins

RNG = np.random.default_rng(5)
CELLS = 32
ALL = np.ones((CELLS, CELLS), np.float32)


def bell(width: float = 1.0) -> np.ndarray:
    """The spectrum of a Gaussian answer at (0, 0)."""
    offset = np.fft.fftfreq(CELLS, 1 / CELLS)
    line = np.exp(-0.5 * (offset / width) ** 2)
    return np.fft.rfft2(np.outer(line, line)).astype(np.complex64)


def blank(channels: int) -> tuple[np.ndarray, np.ndarray]:
    """A filter that has learnt nothing."""
    half = (CELLS, CELLS // 2 + 1)
    return np.zeros((channels, *half), np.complex64), np.zeros(half, np.float32)


def test_samples_of_a_ramp_are_its_values():
    """A linear image is read exactly, at any fraction of a pixel and with any number of taps, away from the
    edge.
    """
    x = np.arange(200, dtype=np.float64)
    image = np.repeat(np.rint(x)[None, :, None], 50, 0).repeat(3, 2).astype(np.uint8)
    for width in (16.0, 24.0, 57.0, 128.0):
        window = np.array([[20.0, 10.0, width, 16.0]])
        seen = twins.sample_windows(image, window, 8, 16)[0, :, :, 0]
        expected = 20.0 + (np.arange(16) + 0.5) * width / 16 - 0.5
        assert np.abs(seen - expected).max() <= 0.51  # rounding to whole levels


def test_samples_of_whole_blocks_are_their_means():
    """Where a sample covers 2 by 2 or 4 by 4 whole pixels, it is their mean."""
    image = RNG.integers(0, 256, (64, 64, 3), np.uint8)
    for side in (2, 4):
        seen = twins.sample_windows(image, np.array([[0.0, 0.0, 64.0, 64.0]]), 64 // side, 64 // side)[0]
        means = image.reshape(64 // side, side, 64 // side, side, 3).mean(axis=(1, 3))
        assert np.abs(seen - means).max() <= 0.51


def test_outside_of_the_image_is_its_edge():
    """A window beyond a corner shows the corner's pixel alone."""
    image = RNG.integers(0, 256, (20, 30, 3), np.uint8)
    seen = twins.sample_windows(image, np.array([[-90.0, -90.0, 40.0, 40.0]]), 8, 8)
    assert (seen == image[0, 0]).all()


@pytest.mark.parametrize("turn", range(8))
def test_cells_of_a_ramp_have_one_orientation(turn):
    """A ramp towards 45 k degrees falls into bin k alone."""
    angle = np.pi / 4 * turn
    y, x = np.mgrid[:64, :64] - 31.5
    ramp = np.rint(127 + 1.9 * (np.rint(np.cos(angle)) * x + np.rint(np.sin(angle)) * y)).clip(0, 255)
    cells = twins.gradient_color_cells(
        np.repeat(ramp[..., None], 3, 2).astype(np.uint8), np.ones((32, 32), "f4")
    )
    shares = cells[:8, 12:20, 12:20].sum(axis=(1, 2))
    assert shares.argmax() == turn
    assert shares[turn] > 0.85 * shares.sum()


def test_colors_are_without_their_mean():
    """The color channels have mean 0, and a patch of one color has no cells but 0."""
    ones = np.ones((32, 32), np.float32)
    cells = twins.gradient_color_cells(RNG.integers(0, 256, (64, 64, 3), np.uint8), ones)
    assert np.abs(cells[8:].mean(axis=(1, 2))).max() < 1e-6
    flat = twins.gradient_color_cells(np.full((64, 64, 3), 77, np.uint8), ones)
    assert np.abs(flat).max() < 1e-6


def test_a_filter_finds_a_shift():
    """The answer to what was learnt, shifted by any number of cells, has its top there, and is about 1."""
    cells = RNG.normal(size=(5, CELLS, CELLS)).astype(np.float32)
    learnt = twins.correlation_train(cells, ALL, bell(), *blank(5), 1.0, 0.0)
    for down, right in ((0, 0), (3, -5), (-16, 15)):
        answer = twins.correlation_response(np.roll(cells, (down, right), (1, 2)), *learnt, 1e-6)
        assert np.unravel_index(answer.argmax(), answer.shape) == (16 + down, 16 + right)
        assert answer.max() == pytest.approx(1, abs=1e-3)


def test_a_rate_of_zero_learns_nothing():
    """Rate 0 gives the filter itself, rate 1 forgets it."""
    one, other = RNG.normal(size=(2, 3, CELLS, CELLS)).astype(np.float32)
    first = twins.correlation_train(one, ALL, bell(), *blank(3), 1.0, 0.0)
    same = twins.correlation_train(other, ALL, bell(), *first, 0.0, 0.0)
    new = twins.correlation_train(other, ALL, bell(), *first, 1.0, 0.0)
    fresh = twins.correlation_train(other, ALL, bell(), *blank(3), 1.0, 0.0)
    assert all(np.array_equal(a, b) for a, b in zip(same, first, strict=True))
    assert all(np.allclose(a, b, atol=1e-4) for a, b in zip(new, fresh, strict=True))


def test_a_filter_ignores_its_background():
    """With the rest of the window to be answered by 0, a still background with a moved target is answered
    where the target is; without, where the background is.
    """
    noise = RNG.normal(size=(5, CELLS, CELLS)).astype(np.float32)
    target = np.zeros((CELLS, CELLS), np.float32)
    target[12:20, 12:20] = 1
    moved = noise * (1 - np.roll(target, 5, -1)) + np.roll(noise * target, 5, -1)
    focused = twins.correlation_train(noise, target, bell(), *blank(5), 1.0, 1.0)
    whole = twins.correlation_train(noise, ALL, bell(), *blank(5), 1.0, 0.0)
    tops = [
        np.unravel_index(twins.correlation_response(moved, *each, 1e-2).argmax(), (CELLS, CELLS))
        for each in (focused, whole)
    ]
    assert tops == [(16, 21), (16, 16)]


def test_a_scale_filter_finds_a_step():
    """Looks shifted by some steps along the scales are answered there."""
    looks = RNG.normal(size=(11, 40)).astype(np.float32)
    label = np.fft.fft(np.exp(-0.5 * np.fft.fftfreq(11, 1 / 11) ** 2)).astype(np.complex64)
    none = np.zeros((40, 11), np.complex64), np.zeros(11, np.float32)
    learnt = twins.scale_train(looks, label, *none, 1.0)
    for step in (-5, 0, 2):
        assert twins.scale_response(np.roll(looks, step, 0), *learnt, 1e-6).argmax() == 5 + step


def test_box_contrast_counts_what_is_covered():
    """On a map of a rectangle of 1, the box of its size has contrast 1 at its place, and what shifted boxes
    cover elsewhere.
    """
    plane = np.zeros((64, 64), np.float32)
    plane[24:40, 26:46] = 1  # its middle is (36, 32): two cells right of the map's
    contrast = twins.box_contrast(plane, 20.0, 16.0, 1.5, 1.0)
    assert contrast[16, 18] == pytest.approx(1)
    assert twins.box_contrast(plane, 20.0, 16.0, 1.5, 0.0)[16, 16] == pytest.approx(16 / 20)
    assert np.unravel_index(contrast.argmax(), contrast.shape) == (16, 18)


def test_edge_shares_are_means():
    """The mean of a map in boxes round its middle, parts of pixels counted by their area."""
    plane = RNG.random((64, 64)).astype(np.float32)
    shares = twins.edge_shares(plane, np.array([20.0, 1.0, 64.0]), np.array([10.0, 1.0, 64.0]))
    assert shares[0] == pytest.approx(plane[27:37, 22:42].mean(), rel=1e-5)
    assert shares[1] == pytest.approx(plane[31:33, 31:33].mean(), rel=1e-5)
    assert shares[2] == pytest.approx(plane.mean(), rel=1e-5)


BAD = {
    "window of three numbers": (
        "windows",
        lambda: twins.sample_windows(np.zeros((4, 4, 3), np.uint8), np.zeros((1, 3)), 4, 4),
    ),
    "window of NaN": (
        "windows",
        lambda: twins.sample_windows(np.zeros((4, 4, 3), np.uint8), np.full((1, 4), np.nan), 4, 4),
    ),
    "no image": ("image", lambda: twins.sample_windows(np.zeros((0, 4, 3), np.uint8), np.ones((1, 4)), 4, 4)),
    "patch": (
        "patch",
        lambda: twins.gradient_color_cells(np.zeros((60, 64, 3), np.uint8), np.ones((32, 32), np.float32)),
    ),
    "ridge": (
        "ridge",
        lambda: twins.correlation_response(np.zeros((2, 32, 32), np.float32), *blank(2), 0.0),
    ),
    "channels": (
        "numerator",
        lambda: twins.correlation_response(np.zeros((3, 32, 32), np.float32), *blank(2), 0.1),
    ),
    "rate": (
        "rate",
        lambda: twins.correlation_train(np.zeros((2, 32, 32), np.float32), ALL, bell(), *blank(2), 1.5, 0.0),
    ),
    "box": ("box", lambda: twins.box_contrast(np.zeros((64, 64), np.float32), 0.0, 4.0, 1.5, 1.0)),
    "heights": (
        "heights",
        lambda: twins.edge_shares(np.zeros((64, 64), np.float32), np.ones(3), np.ones(2)),
    ),
}


@pytest.mark.parametrize("case", BAD)
def test_refuses(case):
    """Bad input is refused in words that begin with the argument's name."""
    name, call = BAD[case]
    with pytest.raises(ValueError, match=f"^{name}: expected"):
        call()
