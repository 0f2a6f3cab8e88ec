# SPDX-License-Identifier: MIT
"""Flow of one level: equations (1) to (6)."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal
from numpy.typing import NDArray
from scipy.ndimage import gaussian_filter
from tricue import _core, reference
from tricue.kernels import Kernels

Image = NDArray[np.uint8]
Scene = Callable[[NDArray[np.float64], NDArray[np.float64]], Image]


def moved(scene: Scene, u: float, v: float, shape: tuple[int, int] = (70, 90)) -> tuple[Image, Image]:
    """Two frames between which everything moves by (u, v)."""
    y, x = np.mgrid[: shape[0], : shape[1]].astype(float)
    return scene(x, y), scene(x - u, y - v)


@pytest.mark.parametrize("seed", range(12))
def test_native_is_the_twin(seed: int) -> None:
    """Both give the same for noise and texture of any shape, at any sigma, in any region and memory layout.

    32-bit sums of gray levels leave at most 3e-4 in a constraint; in the solution that is
    multiplied by 1 + |flow| and divided by the smaller singular value of (4), about angle sqrt(contrast) / 2.
    """
    rng = np.random.default_rng(seed)
    shape = int(rng.integers(1, 80)), int(rng.integers(1, 120))
    frames = rng.integers(0, 256, (2, *shape)).astype(np.uint8)
    if seed % 2:
        frames[1] = np.roll(frames[0], 1, int(rng.integers(2)))
    wide = np.zeros((shape[0] + 1, shape[1] + 3), np.uint8)
    wide[:-1, 1:-2] = frames[1]
    y0, y1 = sorted(rng.integers(0, shape[0] + 1, 2).tolist())
    x0, x1 = sorted(rng.integers(0, shape[1] + 1, 2).tolist())
    region = (x0, y0, x1, y1) if seed % 3 else None
    arguments = (frames[0], wide[:-1, 1:-2], float(rng.uniform(0.5, 9)), 0.05, 0.01, region)
    native, twin = _core.gradient_flow(*arguments), reference.gradient_flow(*arguments)
    assert [plane.dtype for plane in native] == [plane.dtype for plane in twin] == [np.float32] * 4
    assert [plane.shape for plane in native] == [plane.shape for plane in twin]
    angle, contrast = twin[2:]
    edge = (abs(angle - 0.05) < 1e-3) | (abs(contrast / 0.01 - 1) < 1e-2)
    lengths = np.fmax(np.hypot(*native[:2]), np.hypot(*twin[:2]))
    edge |= lengths > 0.97 * np.pi / np.sqrt(2) * arguments[2]
    assert_array_equal(np.isnan(native[0])[~edge], np.isnan(twin[0])[~edge])
    both = np.isfinite(native[0]) & np.isfinite(twin[0])
    scale = 3e-4 * 2 * (1 + np.hypot(*twin[:2])) / (angle * np.sqrt(contrast))
    for ours, theirs in zip(native[:2], twin[:2], strict=True):
        assert (abs(ours - theirs)[both] <= scale[both]).all()
    assert_allclose(native[3], contrast, rtol=1e-3, atol=1e-6)
    certain = contrast > 0.01
    assert_allclose(native[2][certain], angle[certain], atol=6e-3)


@pytest.mark.parametrize("sigma", [1.5, 2, 3])
@pytest.mark.parametrize(("across", "down"), [(0.3, 0.0), (-0.2, 0.4), (0.4, -0.4)])
def test_finds_a_known_motion(
    kernels: Kernels, scene: Scene, sigma: float, across: float, down: float
) -> None:
    """Where the reliabilities are good, half of the pixels are within 0.1 px of a motion of half a sigma."""
    u, v = sigma * across, sigma * down
    previous, current = moved(scene, u, v)
    found = kernels.gradient_flow(previous, current, sigma, 0.4, 0.5)
    inner = np.s_[10:-10, 10:-10]
    errors = np.hypot(found[0] - u, found[1] - v)[inner]
    assert np.isfinite(errors).mean() > 0.3
    assert np.nanmedian(errors) < 0.1


@pytest.mark.parametrize(("length", "u"), [(12, 1.0), (16, 2.5), (24, -3.0)])
def test_waves_in_closed_form(kernels: Kernels, length: float, u: float) -> None:
    """Of waves along x and y the method finds 2 tan(w u / 2) / w, w the wave number: derived from (3) by
    hand, but for the 2 % that cutting the filters off costs.
    """
    y, x = np.mgrid[:80, :100].astype(float)
    w = 2 * np.pi / length
    previous, current = (
        np.rint(128 + 60 * np.sin(w * (x - d)) + 60 * np.sin(w * (y - d / 2))).astype(np.uint8)
        for d in (0.0, u)
    )
    found = kernels.gradient_flow(previous, current, 2, 0.3, 1)
    for plane, shift in ((found[0], u), (found[1], u / 2)):
        inner = plane[12:-12, 12:-12]
        assert np.nanmedian(inner) == pytest.approx(2 * np.tan(w * shift / 2) / w, rel=0.02)


@pytest.mark.parametrize("sigma", [1.5, 3])
def test_contrast_is_scipys(kernels: Kernels, scene: Scene, sigma: float) -> None:
    """(6) is the sum of SciPy's squared second derivatives of a Gaussian, but for a factor: SciPy's cut off
    taps sum up as the sampled Gaussian does, ours are exact on a ramp and a parabola, so that the squares of
    ours are up to 6 % larger.
    """
    frame, _ = moved(scene, 0, 0)
    contrast = kernels.gradient_flow(frame, frame, sigma, 0, 0)[3]
    orders = ((0, 2), (1, 1), (1, 1), (2, 0))
    theirs = sum(
        gaussian_filter(frame.astype(float), sigma, order, mode="nearest", truncate=5) ** 2
        for order in orders
    )
    assert_allclose(contrast.mean(), np.mean(theirs), rtol=0.06)
    assert np.corrcoef(contrast.ravel(), np.ravel(theirs))[0, 1] > 0.999


def test_backwards_is_the_negative(kernels: Kernels, scene: Scene) -> None:
    """With the frames exchanged the flow is the other way round, exactly, and as reliable."""
    previous, current = moved(scene, 0.7, -0.3)
    there = kernels.gradient_flow(previous, current, 2, 0.2, 0.1)
    back = kernels.gradient_flow(current, previous, 2, 0.2, 0.1)
    for k, sign in enumerate((-1, -1, 1, 1)):
        assert_array_equal(there[k], sign * back[k])


def test_region_is_cut_out(kernels: Kernels, scene: Scene) -> None:
    """A region gives just what the whole frame gives there, and an empty one nothing."""
    previous, current = moved(scene, 0.7, -0.3)
    whole = kernels.gradient_flow(previous, current, 2, 0.2, 0.1)
    for x0, y0, x1, y1 in ((0, 0, 90, 70), (3, 5, 61, 70), (89, 0, 90, 1), (40, 7, 40, 9)):
        part = kernels.gradient_flow(previous, current, 2, 0.2, 0.1, (x0, y0, x1, y1))
        for ours, theirs in zip(part, whole, strict=True):
            assert_array_equal(ours, theirs[y0:y1, x0:x1])


def test_minima_take_pixels_away_only(kernels: Kernels, scene: Scene) -> None:
    """Higher minima leave the reliabilities and the flow that is kept as they are."""
    previous, current = moved(scene, 0.7, -0.3)
    low = kernels.gradient_flow(previous, current, 2, 0, 0)
    high = kernels.gradient_flow(previous, current, 2, 0.6, 2)
    kept = (low[2] >= np.float32(0.6)) & (low[3] >= 2) & np.isfinite(low[0])
    assert np.nanmax(np.hypot(low[0], low[1])) <= 1e-5 + 2 * np.pi / np.sqrt(2)
    assert 0.05 < kept.mean() < 0.95
    for k in (0, 1):
        assert_array_equal(high[k], np.where(kept, low[k], np.float32(np.nan)))
    for k in (2, 3):
        assert_array_equal(high[k], low[k])


def test_light_changes_nothing(kernels: Kernels, scene: Scene) -> None:
    """A lamp that adds 20 levels and halves all differences changes contrast alone, to a quarter."""
    previous, current = ((frame // 4 * 4).clip(60, 220) for frame in moved(scene, 0.7, -0.3))
    plain = kernels.gradient_flow(previous, current, 2, 0.3, 4)
    lit = kernels.gradient_flow(previous // 2 + 20, current // 2 + 20, 2, 0.3, 1)
    assert_allclose(lit[3], plain[3] / 4, rtol=1e-3, atol=1e-5)
    both = np.isfinite(plain[0]) & np.isfinite(lit[0])
    assert both.mean() > 0.2
    assert_allclose(lit[0][both], plain[0][both], atol=1e-2)


def test_nothing_to_see(kernels: Kernels, scene: Scene) -> None:
    """Frames without texture have no flow, nor have stripes, whose angle is 0; equal frames have 0."""
    for level in (0, 77, 255):
        flat = np.full((30, 40), level, np.uint8)
        u, v, _, contrast = kernels.gradient_flow(flat, flat, 2, 0, 0)
        assert np.isnan(u).all()
        assert np.isnan(v).all()
        assert (contrast < 1e-6).all()
    stripes = np.tile(np.arange(40, dtype=np.uint8) % 8 * 20, (30, 1))
    u, _, angle, _ = kernels.gradient_flow(stripes, np.roll(stripes, 1, 1), 2, 0.05, 0)
    assert np.isnan(u).all()
    assert (angle < 0.05).all()
    frame, _ = moved(scene, 0, 0)
    u, v, _, _ = kernels.gradient_flow(frame, frame, 2, 0.1, 0.1)
    assert np.isfinite(u).any()
    assert not np.nan_to_num(u).any()
    assert not np.nan_to_num(v).any()


BAD: list[tuple[dict[str, Any], str]] = [
    ({"previous": np.zeros((0, 9), np.uint8)}, "previous: expected at least one pixel, got none"),
    (
        {"current": np.zeros((9, 8), np.uint8)},
        r"current: expected the previous frame's shape \(9, 9\), got \(9, 8\)",
    ),
    ({"sigma": 0.4}, "sigma: expected 0.5 to 16 pixels, got 0.4"),
    ({"sigma": float("nan")}, "sigma: expected 0.5 to 16 pixels, got nan"),
    ({"min_angle": 1.5}, "min_angle: expected 0 to 1, got 1.5"),
    ({"min_contrast": -1.0}, "min_contrast: expected a finite number, not negative, got -1"),
    ({"min_contrast": float("inf")}, "min_contrast: expected a finite number, not negative, got inf"),
    (
        {"region": (0, 0, 10, 4)},
        r"region: expected x0, y0, x1, y1 in order, within 9 x 9, got \(0, 0, 10, 4\)",
    ),
    (
        {"region": (-1, 0, 4, 4)},
        r"region: expected x0, y0, x1, y1 in order, within 9 x 9, got \(-1, 0, 4, 4\)",
    ),
    ({"region": (0, 5, 4, 4)}, r"region: expected x0, y0, x1, y1 in order, within 9 x 9, got \(0, 5, 4, 4\)"),
]


@pytest.mark.parametrize(("changes", "message"), BAD)
def test_refuses(kernels: Kernels, changes: dict[str, Any], message: str) -> None:
    """Wrong shapes and numbers are named, with what was expected."""
    frame = np.zeros((9, 9), np.uint8)
    good = {"previous": frame, "current": frame, "sigma": 1.0, "min_angle": 0.1, "min_contrast": 1.0}
    with pytest.raises(ValueError, match=message):
        kernels.gradient_flow(**good | changes)


def test_native_refuses_other_images() -> None:
    """Color, floats and pixels that aren't packed are named, never converted."""
    gray = np.zeros((9, 9), np.uint8)
    with pytest.raises(ValueError, match="previous: expected a uint8 gray image"):
        _core.gradient_flow(np.zeros((9, 9, 3), np.uint8), gray, 1, 0, 0)
    with pytest.raises(TypeError, match="current: expected a uint8 gray image"):
        _core.gradient_flow(gray, gray.astype(np.float32), 1, 0, 0)
    with pytest.raises(ValueError, match="current: expected packed pixels"):
        _core.gradient_flow(gray, np.zeros((9, 18), np.uint8)[:, ::2], 1, 0, 0)
