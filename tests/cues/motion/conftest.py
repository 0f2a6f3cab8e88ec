# SPDX-License-Identifier: MIT
"""Frames whose motion is known exactly."""

from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray

Image = NDArray[np.uint8]
Floats = NDArray[np.float64]
Scene = Callable[[Floats, Floats], Image]
"""Renders what is at the scene's x, y (H, W), in pixels."""


@pytest.fixture(scope="session")
def scene() -> Scene:
    """Waves of 4 to 40 pixels in all directions, so a texture that can be drawn anywhere between pixels."""
    rng = np.random.default_rng(5)
    length, angle = 4 * 10 ** rng.random(60), 2 * np.pi * rng.random(60)
    phase, weight = 2 * np.pi * rng.random(60), length**0.5
    across, down = 2 * np.pi * np.cos(angle) / length, 2 * np.pi * np.sin(angle) / length

    def render(x: Floats, y: Floats) -> Image:
        total = sum(
            w * np.sin(a * x + d * y + p) for w, a, d, p in zip(weight, across, down, phase, strict=True)
        )
        return np.asarray((128 + 40 * total / np.sqrt((weight**2).sum() / 2)).round().clip(0, 255), np.uint8)

    return render
