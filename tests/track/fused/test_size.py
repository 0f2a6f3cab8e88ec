# SPDX-License-Identifier: MIT
"""The size of a target by a shift in log-polar coordinates."""

import math

import cv2
import numpy as np
import pytest
from tricue import FusedTracker, Intrinsics
from tricue import kernels as kernel_sets
from tricue.track.fused.experts import size
from tricue.track.fused.experts.size import SizeExpert
from tricue.track.fused.picture_observation import PictureObservation
from tricue.track.fused.target import Target

CAMERA = Intrinsics.from_fov(320, 240, 60)
TARGET = Target(160.0, 120.0, 50.0, 64.0)
P = FusedTracker.Params()


def observation(factor: float, light: float = 1.0, angle: float = 0.0) -> PictureObservation:
    """A textured scene, enlarged and turned (degrees) around the target's center, its levels multiplied."""
    texture = np.random.default_rng(5).integers(0, 256, (24, 32, 3)).astype(np.uint8)
    scene = cv2.resize(texture, (320, 240), interpolation=cv2.INTER_CUBIC)
    seen = cv2.warpAffine(scene, cv2.getRotationMatrix2D((159.5, 119.5), angle, factor), (320, 240))
    picture = np.clip(light * seen, 0, 255).astype(np.uint8)
    return PictureObservation(kernel_sets.load("native"), picture, CAMERA, None, None)


EXPERT = SizeExpert.from_target(observation(1.0), TARGET, P)


@pytest.mark.parametrize("factor", [0.85, 0.9, 0.95, 1.0, 1.05, 1.1, 1.15])
def test_sizes_are_reached(factor):
    """A new size is approached from frame to frame without overshoot, and found to 1 % within ten."""
    sizes = [1.0]
    for _ in range(10):
        sizes.append(sizes[-1] * EXPERT.growth(observation(factor), TARGET.scale(sizes[-1])))
    assert sizes[-1] == pytest.approx(factor, rel=0.01)
    assert min(1.0, factor) - 0.001 <= min(sizes) <= max(sizes) <= max(1.0, factor) + 0.001


@pytest.mark.parametrize("light", [0.5, 0.8])
@pytest.mark.parametrize("angle", [-8.0, 8.0])
def test_light_and_small_turns_change_little(light, angle):
    """In half the light, and turned by three fourths of a cell, a first frame finds most of a growth."""
    assert EXPERT.growth(observation(1.04, light, angle), TARGET) == pytest.approx(1.03, abs=0.01)


def test_growth_is_bounded():
    """However different what is seen, the size changes by two cells and a half at most."""
    most = math.exp(2.5 * size.LOG_PER_CELL)
    for seed in range(10):
        noise = np.random.default_rng(seed).integers(0, 256, (240, 320, 3)).astype(np.uint8)
        seen = PictureObservation(kernel_sets.load("native"), noise, CAMERA, None, None)
        assert 1 / most <= EXPERT.growth(seen, TARGET) <= most


def test_a_flat_picture_keeps_the_size():
    """Where there is nothing to compare, the size stays what it was."""
    flat = np.full((240, 320, 3), 90, np.uint8)
    seen = PictureObservation(kernel_sets.load("native"), flat, CAMERA, None, None)
    assert EXPERT.growth(seen, TARGET) == 1.0


def test_a_high_penalty_keeps_the_size():
    """A cell of another size is never chosen where it costs more than a response can bring."""
    stubborn = SizeExpert.from_target(observation(1.0), TARGET, FusedTracker.Params(size_change_penalty=100))
    most = math.exp(0.5 * size.LOG_PER_CELL)
    assert 1 < stubborn.growth(observation(1.1), TARGET) <= most * (1 + 1e-12)


def test_it_learns_the_new_size():
    """Having learned a larger target as its own it answers 1 to it; the expert before doesn't."""
    learned = EXPERT
    for _ in range(20):
        learned = learned.learn(observation(1.06), TARGET, 0.5)
    assert learned.growth(observation(1.06), TARGET) == pytest.approx(1.0, abs=0.01)
    assert EXPERT.growth(observation(1.06), TARGET) > 1.015
