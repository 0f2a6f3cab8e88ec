# SPDX-License-Identifier: MIT
"""Two frames of a texture whose motion is known exactly at every pixel."""

import numpy as np
from numpy.typing import NDArray

Image = NDArray[np.uint8]
Floats = NDArray[np.float32]

WAVE_COUNT = 60
WAVES_SHAPE = (120, 160)


def moving_waves(
    degrees: float,
    growth: float,
    shift: float,
    rng: np.random.Generator,
    noise: float,
    shape: tuple[int, int] = WAVES_SHAPE,
) -> tuple[Image, Image, Floats]:
    """Previous and current frame (H, W), uint8, and the true flow (H, W, 2), pixels, at the previous one.

    The texture has wavelengths of 4 to 40 pixels, with amplitudes like those of real surfaces. Its contrast
    varies between one sixth and full over the frame. Between the frames, it rotates about the center by
    ``degrees``, is scaled by ``growth``, and shifts by ``shift`` pixels in a random direction. noise:
    standard deviation in gray levels, independent in both frames.
    """
    height, width = shape
    y, x = np.mgrid[:height, :width].astype(float)
    position = x - width / 2 + 1j * (y - height / 2)
    turn = growth * np.exp(1j * np.deg2rad(degrees))
    away = shift * np.exp(2j * np.pi * rng.random())
    flow = position * turn + away - position

    length = 4 * 10 ** rng.random(WAVE_COUNT)
    wave, phase = (
        2 * np.pi / length * np.exp(2j * np.pi * rng.random(WAVE_COUNT)),
        2 * np.pi * rng.random(WAVE_COUNT),
    )
    weight = length**0.5 / np.sqrt(length.sum() / 2)

    def render(at: NDArray[np.complex128]) -> Image:
        waves = sum(
            a * np.sin((k.conjugate() * at).real + p) for a, k, p in zip(weight, wave, phase, strict=True)
        )
        fade = 7 / 12 + 5 / 12 * np.sin(at.real / 17 + 1) * np.sin(at.imag / 13)
        levels = 128 + 40 * fade * waves + rng.normal(0, noise, shape)
        return np.asarray(levels.round().clip(0, 255), np.uint8)

    truth = np.dstack([flow.real, flow.imag]).astype(np.float32)
    return render(position), render((position - away) / turn), truth
