# SPDX-License-Identifier: MIT
"""What the fused tracker's twins compute, against truths in closed form."""

import numpy as np
import pytest
from tricue.track.fused import twins

RNG = np.random.default_rng(5)


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
