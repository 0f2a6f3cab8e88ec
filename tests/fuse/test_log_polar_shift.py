# SPDX-License-Identifier: MIT
"""A shift of a patch in other coordinates."""

from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from tricue import _core, reference
from tricue.kernels import Kernels
from tricue.reference.fuse.log_polar_shift import gaussian_peak_offset

from tests.kernel_arguments import Place, with_argument

TAPER = np.ones((32, 32), np.float32)
PLACES = np.arange(64 * 64).reshape(64, 64)  # each pixel its own: a shift is one in the patch
RANGE = 2, 1, 0.05


def noise(seed: int) -> NDArray[np.uint8]:
    """A patch that is like no shifted one."""
    return np.random.default_rng(seed).integers(0, 256, (64, 64, 3), np.uint8)


def filter_for(patch: NDArray[np.uint8], width: float = 1.0) -> NDArray[np.complex64]:
    """A filter that answers to the patch with a Gaussian."""
    offset = np.fft.fftfreq(32, 1 / 32)
    profile = np.exp(-0.5 * (offset / width) ** 2)
    cells = np.fft.rfft2(reference.hog_color_cells(patch, TAPER).astype(float))
    energy = (abs(cells) ** 2).sum(axis=0)
    wanted = np.fft.rfft2(np.outer(profile, profile))
    return np.ascontiguousarray(wanted * cells.conj() / energy, np.complex64)[None]


@pytest.mark.parametrize("seed", range(10))
def test_native_is_the_twin(seed: int) -> None:
    """Both find the same column, the same place between columns, and the same response there, to the
    roundings of the responses.
    """
    rng = np.random.default_rng(seed)
    places = rng.permutation(64 * 64).reshape(64, 64)
    spectra = np.ascontiguousarray(np.fft.rfft2(rng.uniform(-1, 1, (1, 19, 32, 32))), np.complex64)
    for near in ((2, 1, 0.05), (15, 15, 0.0), (0, 0, 1.0), (3, 0, -0.2)):
        arguments = noise(seed), places, TAPER, spectra, near
        assert _core.log_polar_shift(*arguments) == pytest.approx(
            reference.log_polar_shift(*arguments), abs=1e-3
        )


@pytest.mark.parametrize("shift", [-1, 0, 1])
def test_finds_a_shift(kernels: Kernels, shift: int) -> None:
    """A patch moved by whole cells is found moved by as many, as the filter answers with a Gaussian."""
    patch = noise(3)
    moved = np.roll(patch, 2 * shift, axis=1)
    found, response = kernels.log_polar_shift(moved, PLACES, TAPER, filter_for(patch), (2, 1, 0.0))
    # Orientations at the left and right border, where gradients aren't those of a rolled patch, add a little.
    assert found == pytest.approx(shift, abs=0.05)
    assert response == pytest.approx(1.0, abs=0.1)


@pytest.mark.parametrize("offset", [-0.45, -0.3, 0.0, 0.2, 0.45])
def test_peaks_between_samples(offset: float) -> None:
    """A Gaussian's mean is found exactly."""
    x = np.arange(5) - 2 - offset
    assert gaussian_peak_offset(np.exp(-(x**2) / 2), 2) == pytest.approx(offset, abs=1e-12)


def test_what_is_no_peak_has_no_offset() -> None:
    """At an end, on a plateau, and where nothing is positive there is nothing to find."""
    assert gaussian_peak_offset(np.array([3.0, 2.0, 1.0]), 0) == 0
    assert gaussian_peak_offset(np.array([1.0, 1.0, 1.0]), 1) == 0
    assert gaussian_peak_offset(np.array([-3.0, -1.0, -2.0]), 1) == 0


def test_range_and_penalty(kernels: Kernels) -> None:
    """A shift beyond the range isn't found, nor one whose penalty is above its response."""
    patch = noise(4)
    moved, own = np.roll(patch, 4, axis=1), filter_for(patch)
    assert kernels.log_polar_shift(moved, PLACES, TAPER, own, (2, 1, 0.0))[0] == 2  # at the end: no neighbor
    assert abs(kernels.log_polar_shift(moved, PLACES, TAPER, own, (1, 1, 0.0))[0]) <= 1
    assert abs(kernels.log_polar_shift(moved, PLACES, TAPER, own, (2, 1, 10.0))[0]) <= 0.5


def test_a_penalty_that_is_infinite_in_float32_keeps_the_middle(kernels: Kernels) -> None:
    """It excludes all columns but the middle one, whose penalty is 0."""
    patch = noise(4)
    moved, own = np.roll(patch, 2, axis=1), filter_for(patch)
    found = kernels.log_polar_shift(moved, PLACES, TAPER, own, (2, 1, 1e39))
    assert found == kernels.log_polar_shift(moved, PLACES, TAPER, own, (2, 1, 1e30))


@pytest.mark.parametrize(
    ("place", "value", "message"),
    [
        (3, np.zeros((2, 19, 32, 17), np.complex64), "filter: expected one filter, got 2"),
        ((4, 0), 16, "max_right: expected 0 to 15, got 16"),
        ((4, 1), -1, "max_down: expected 0 to 15, got -1"),
        ((4, 2), np.inf, "penalty: expected a finite number, got inf"),
        (1, np.full((64, 64), 4096), "places: expected 0 to 4095"),
    ],
)
def test_refuses(kernels: Kernels, place: Place, value: Any, message: str) -> None:
    """Wrong shapes and values are named."""
    usual = [noise(0), PLACES, TAPER, np.zeros((1, 19, 32, 17), np.complex64), RANGE]
    arguments = with_argument(usual, place, value)
    with pytest.raises(ValueError, match=message):
        kernels.log_polar_shift(*arguments)
