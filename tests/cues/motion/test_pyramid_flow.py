# SPDX-License-Identifier: MIT
"""Flow from coarse to fine."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference
from tricue.kernels import Kernels

Image = NDArray[np.uint8]
Floats = NDArray[np.float64]
Scene = Callable[[Floats, Floats], Image]

SHAPE = (90, 120)
INNER = np.s_[14:-14, 14:-14]


def grid(shape: tuple[int, int] = SHAPE) -> tuple[Floats, Floats]:
    """x and y of all pixels."""
    y, x = np.mgrid[: shape[0], : shape[1]].astype(float)
    return x, y


def moved(scene: Scene, u: float, v: float) -> tuple[Image, Image]:
    """Two frames between which everything moves by (u, v)."""
    x, y = grid()
    return scene(x, y), scene(x - u, y - v)


@pytest.mark.parametrize("seed", range(12))
def test_native_is_the_twin(scene: Scene, seed: int) -> None:
    """Both give the same for motions and noise, at any shape, number of levels, window and region.

    Levels are halved in whole numbers, so the same; then rounding to 32 bits is all that differs: 1e-3 px
    for flow that the window determines well, as in gradient_flow's test.
    """
    rng = np.random.default_rng(seed)
    shape = int(rng.integers(1, 90)), int(rng.integers(1, 120))
    x, y = grid(shape)
    previous = scene(x, y)
    u, v = rng.uniform(-3, 3, 2)
    current = scene(x - u + 0.02 * y, y - v - 0.01 * x)
    current = (current + rng.normal(0, 2, shape)).clip(0, 255).astype(np.uint8)
    y0, y1 = sorted(rng.integers(0, shape[0] + 1, 2).tolist())
    x0, x1 = sorted(rng.integers(0, shape[1] + 1, 2).tolist())
    region = (x0, y0, x1, y1) if seed % 3 else None
    pool, step = int(rng.integers(1, 5)), float(rng.uniform(0.2, 1))
    sigma, levels = float(rng.uniform(0.7, 2.5)), int(rng.integers(2, 5))
    arguments = (previous, current, sigma, levels, 0.1, 0.1, region, pool, step)
    native, twin = _core.pyramid_flow(*arguments), reference.pyramid_flow(*arguments)
    assert [plane.dtype for plane in native] == [plane.dtype for plane in twin] == [np.float32] * 4
    assert [plane.shape for plane in native] == [plane.shape for plane in twin]
    assert (np.isnan(native[0]) != np.isnan(twin[0])).sum() <= 2 + 0.001 * twin[0].size  # at the very minima
    both = np.isfinite(native[0]) & np.isfinite(twin[0])
    for ours, theirs in zip(native, twin, strict=True):
        assert_allclose(ours[both], theirs[both], rtol=1e-3, atol=1e-3)


@pytest.mark.parametrize("length", [0.5, 1, 2, 3, 4.5, 6])
@pytest.mark.parametrize("angle", [0.0, 2.2])
def test_finds_a_known_motion(kernels: Kernels, scene: Scene, length: float, angle: float) -> None:
    """Nine of ten pixels have flow of motions up to 6 px, half within 0.03 px, and nine of ten within 0.2."""
    u, v = length * np.cos(angle), length * np.sin(angle)
    found = kernels.pyramid_flow(*moved(scene, u, v), 1, 3, 0.05, 0.5)
    errors = np.hypot(found[0] - u, found[1] - v)[INNER]
    assert np.isfinite(errors).mean() > 0.9
    assert np.nanmedian(errors) < 0.03
    assert np.nanpercentile(errors, 90) < 0.2


def test_finds_a_turn_and_zoom(kernels: Kernels, scene: Scene) -> None:
    """Where a frame turns by 2 degrees and grows by 3 % each pixel has its own motion."""
    x, y = grid()
    across, down = x - 60, y - 45
    turn = np.exp(2j * np.pi / 180) * 1.03
    source = (across + 1j * down) / turn
    u, v = across - source.real, down - source.imag
    found = kernels.pyramid_flow(scene(x, y), scene(source.real + 60, source.imag + 45), 1, 3, 0.05, 0.5)
    errors = np.hypot(found[0] - u, found[1] - v)[INNER]
    assert np.isfinite(errors).mean() > 0.9
    assert np.nanmedian(errors) < 0.05


def test_lives_in_the_current_frame(kernels: Kernels, scene: Scene) -> None:
    """What moves is found where it is in `current`, not where it was: a square before a ground at rest."""
    x, y = grid()
    frames = [
        np.where((abs(x - at) < 22) & (abs(y - 45) < 22), scene(x - at + 500, y), scene(x, y))
        for at in (56.0, 60.0)
    ]
    u, v = kernels.pyramid_flow(frames[0], frames[1], 1, 3, 0.05, 0.5)[:2]
    square = np.s_[30:60, 46:75]  # that of `previous` begins at 34, of `current` at 39
    assert np.nanmedian(abs(u[square] - 4)) < 0.05
    assert np.nanmedian(abs(v[square])) < 0.05
    ground = np.s_[30:60, 4:28]
    assert np.nanmedian(np.hypot(u, v)[ground]) < 0.05


def test_region_is_nearly_cut_out(kernels: Kernels, scene: Scene) -> None:
    """Of a region comes what the whole frame gives, but near its edge, beyond which the flow isn't known."""
    frames = moved(scene, 2.3, -1.2)
    whole = kernels.pyramid_flow(*frames, 1, 3, 0.05, 0.5)
    x0, y0, x1, y1 = 21, 17, 90, 76
    part = kernels.pyramid_flow(*frames, 1, 3, 0.05, 0.5, (x0, y0, x1, y1))
    for ours, theirs in zip(part[:2], whole[:2], strict=True):
        assert ours.shape == (y1 - y0, x1 - x0)
        difference = abs(ours - theirs[y0:y1, x0:x1])
        assert np.nanpercentile(difference, 95) < 0.02
    everything = kernels.pyramid_flow(*frames, 1, 3, 0.05, 0.5, (0, 0, SHAPE[1], SHAPE[0]))
    for ours, theirs in zip(everything, whole, strict=True):
        assert_array_equal(ours, theirs)
    assert kernels.pyramid_flow(*frames, 1, 3, 0.05, 0.5, (5, 9, 30, 9))[0].shape == (0, 25)


@pytest.mark.parametrize("levels", [2, 3, 4])
@pytest.mark.parametrize("corner", [(0, 0), (171, 138), (375, 300)])
def test_what_is_far_away_changes_nothing(scene: Scene, levels: int, corner: tuple[int, int]) -> None:
    """Beyond where the flow of all levels may lead, nothing is read: the flow is the same, bit for bit."""
    x, y = corner
    region = (x, y, x + 25, y + 20)
    shape = (320, 400)
    columns, rows = grid(shape)
    previous, current = scene(columns, rows), scene(columns - 2.5, rows + 1.25)
    expected = _core.pyramid_flow(previous, current, 0.8, levels, 0.05, 0.5, region, 2)
    assert np.isfinite(expected[0]).mean() > 0.1
    # 2 px a level, filters of radius 3 and windows of 2 at each, and what pyramids are smoothed by.
    reach = 14 * 2 ** (levels - 1)
    far = (abs(rows - y - 10) > reach + 10) | (abs(columns - x - 12) > reach + 13)
    assert far.mean() > 0.3
    noise = np.random.default_rng(0).integers(0, 256, shape, np.uint8)
    replaced = [np.where(far, noise, each) for each in (previous, current)]
    found = _core.pyramid_flow(*replaced, 0.8, levels, 0.05, 0.5, region, 2)
    for ours, theirs in zip(found, expected, strict=True):
        assert_array_equal(ours, theirs)


def test_minima_and_steps_take_pixels_away_only(kernels: Kernels, scene: Scene) -> None:
    """Higher minima and shorter steps leave the flow that is kept as it is, and all of it reaches them."""
    frames = moved(scene, 2.3, -1.2)
    low = kernels.pyramid_flow(*frames, 1, 3, 0, 0, max_step=99)
    high = kernels.pyramid_flow(*frames, 1, 3, 0.7, 100, max_step=99)
    kept = (low[2] >= np.float32(0.7)) & (low[3] >= 100)
    assert 0.05 < kept.mean() < 0.95
    for k in (0, 1):
        assert_array_equal(high[k], np.where(kept, low[k], np.float32(np.nan)))
    short = kernels.pyramid_flow(*frames, 1, 3, 0, 0, max_step=0.05)
    near = np.isfinite(short[0])
    assert 0.05 < near.mean() < 0.98
    assert_array_equal(short[0][near], low[0][near])


def test_single_pixels_have_the_papers_reliability(kernels: Kernels, scene: Scene) -> None:
    """Without a window contrast is (6) at the last level, and angle at most (5), equal where |G| = |H|."""
    frame, _ = moved(scene, 0, 0)
    single = kernels.gradient_flow(frame, frame, 1, 0, 0)
    found = kernels.pyramid_flow(frame, frame, 1, 2, 0, 0, pool=0)
    assert_allclose(found[3], single[3], rtol=1e-3, atol=1e-4)
    certain = single[3] > 1
    assert (found[2] <= single[2] + 2e-3)[certain].all()
    assert (found[2] > 0.99 * single[2])[certain].mean() > 0.1


def test_nothing_to_see(kernels: Kernels, scene: Scene) -> None:
    """Frames without texture have no flow, equal frames 0, and of a cut to another scene little is kept."""
    flat = np.full((30, 40), 200, np.uint8)
    u, v, _, contrast = kernels.pyramid_flow(flat, flat, 1, 3, 0, 0)
    assert np.isnan(u).all()
    assert np.isnan(v).all()
    assert (contrast < 1e-6).all()
    x, y = grid()
    frame = scene(x, y)
    u, v, _, _ = kernels.pyramid_flow(frame, frame, 1, 3, 0.05, 0.5)
    assert np.isfinite(u).mean() > 0.9
    assert not np.nan_to_num(u).any()
    assert not np.nan_to_num(v).any()
    cut = kernels.pyramid_flow(frame, scene(x + 900, y + 400), 1, 3, 0.05, 0.5)
    assert np.isfinite(cut[0]).mean() < 0.4


BAD: list[tuple[dict[str, Any], str]] = [
    ({"previous": np.zeros((9, 0), np.uint8)}, "previous: expected at least one pixel, got none"),
    (
        {"current": np.zeros((8, 9), np.uint8)},
        r"current: expected the previous frame's shape \(9, 9\), got \(8, 9\)",
    ),
    ({"sigma": 17.0}, "sigma: expected 0.5 to 16 pixels, got 17"),
    ({"levels": 1}, "levels: expected 2 to 8, got 1"),
    ({"levels": 9}, "levels: expected 2 to 8, got 9"),
    ({"pool": -1}, "pool: expected 0 to 16 pixels, got -1"),
    ({"max_step": 0.0}, "max_step: expected a number above 0, got 0"),
    ({"max_step": float("nan")}, "max_step: expected a number above 0, got nan"),
    ({"min_angle": -0.1}, "min_angle: expected 0 to 1, got -0.1"),
    ({"min_contrast": float("nan")}, "min_contrast: expected a finite number, not negative, got nan"),
    (
        {"region": (0, 0, 4, 10)},
        r"region: expected x0, y0, x1, y1 in order, within 9 x 9, got \(0, 0, 4, 10\)",
    ),
]


@pytest.mark.parametrize(("changes", "message"), BAD)
def test_refuses(kernels: Kernels, changes: dict[str, Any], message: str) -> None:
    """Wrong shapes and numbers are named, with what was expected."""
    frame = np.zeros((9, 9), np.uint8)
    good = {
        "previous": frame,
        "current": frame,
        "sigma": 1.0,
        "levels": 2,
        "min_angle": 0.1,
        "min_contrast": 1.0,
    }
    with pytest.raises(ValueError, match=message):
        kernels.pyramid_flow(**good | changes)


def test_native_refuses_other_images() -> None:
    """Color and floats are named, never converted."""
    gray = np.zeros((9, 9), np.uint8)
    with pytest.raises(ValueError, match="previous: expected a uint8 gray image"):
        _core.pyramid_flow(np.zeros((9, 9, 3), np.uint8), gray, 1, 3, 0, 0)
    with pytest.raises(TypeError, match="current: expected a uint8 gray image"):
        _core.pyramid_flow(gray, gray.astype(np.float32), 1, 3, 0, 0)
