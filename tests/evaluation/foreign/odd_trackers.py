# SPDX-License-Identifier: MIT
"""Trackers as others write them, good and bad; the tests name them as this file and a class."""

import ctypes
import os
import random
import signal
import sys
import time
from pathlib import Path

import cv2
import numpy as np
import odd_helper
from tricue import Box, Status, Track
from tricue.track.base.traits import Channels, Traits

print("printed while it is imported")
ODD = 4  # the update at which most do what they do


class Still:
    """Says the first box, as an array, and prints."""

    def __init__(self, step=0.0):
        self.step = step

    def init(self, image, box):
        self.updates, self.box = 0, np.array(box)
        print("started on", image.shape, flush=True)

    def update(self, image):
        assert image.dtype == np.uint8
        assert image.shape[2] == cv2.cvtColor(image, cv2.COLOR_BGR2HSV).shape[2] == 3
        self.updates += 1
        self.box[0] += self.step
        print("| not | a | table |")
        print("nor here", file=sys.stderr, flush=True)
        return self.odd() if self.updates == ODD else odd_helper.same(self.box)

    def odd(self):
        return self.box


class AsFrame(Still):
    """Takes what a frame has beside its image."""

    def update(self, frame):
        assert frame.color.shape == frame.shape
        assert (frame.depth, frame.right, frame.pose) == (None, None, None)
        assert frame[2:5].timestamp is None
        return self.box


class OnDepth:
    """Takes depth and its camera, as its traits say, and has no Params."""

    traits = Traits(channels=(Channels.of("depth"),), camera=frozenset({"intrinsics"}))

    def __init__(self, intrinsics, step=0.0):
        self.step = step

    def init(self, frame, box):
        return self.update(frame)

    def update(self, frame):
        return (self.step, 2, 3, 4)


class LikeOpenCv(Still):
    """(found, box), the target lost once."""

    def init(self, image, box):
        self.updates, self.box = 0, tuple(map(int, box))
        return True

    def update(self, image):
        self.updates += 1
        return (False, (0, 0, 0, 0)) if self.updates == ODD else (np.True_, self.box)


class Scores(Still):
    """(box, score)."""

    def update(self, image):
        self.updates += 1
        return list(self.box), 1 / self.updates


class Logits(Scores):
    """(box, score), of which none is a probability."""

    def update(self, image):
        box, _ = super().update(image)
        return box, 3.0 - self.updates


class Raises(Still):
    def odd(self):
        raise KeyError("no\nsuch thing")


class Text(Still):
    def odd(self):
        return "here"


class Nan(Still):
    def odd(self):
        return (1, 2, float("nan"), 4)


class InfinitePosition(Still):
    def odd(self):
        return Track(Box(*self.box), 1.0, Status.TRACKED, (float("inf"), 0.0, 1.0))


class Five(Still):
    def odd(self):
        return [1, 2, 3, 4, 5]


class Table(Still):
    def odd(self):
        return np.zeros((2, 4))


class Negative(Still):
    def odd(self):
        return (5, 5, -4, 4)


class NanScore(Still):
    def odd(self):
        return (self.box, float("nan"))


class Hangs(Still):
    def odd(self):
        time.sleep(1000)


class HangsInC(Still):
    """Without letting other threads of its process run."""

    def odd(self):
        ctypes.PyDLL(None).sleep(1000)


class HangsWhileMade(Still):
    def __init__(self):
        time.sleep(1000)


class FailsWhileMade(Still):
    def __init__(self):
        raise ValueError("no weights here")


class Exits(Still):
    def odd(self):
        sys.exit("enough")


class ExitsAtOnce(Still):
    def odd(self):
        print("a last line", file=sys.stderr, flush=True)
        os._exit(3)


class Crashes(Still):
    def odd(self):
        os.kill(os.getpid(), signal.SIGSEGV)


class Reads(Still):
    """Standard input is empty, not the evaluation's."""

    def odd(self):
        return self.box if sys.stdin.read() == "" else None


class Draws(Still):
    """Draws from all usual generators, unseeded."""

    def update(self, image):
        drawn = np.random.normal(size=2)  # noqa: NPY002 (as in others' code)
        self.box[:2] += drawn + random.random() + cv2.randn(np.zeros(1), 0, 1)[0]
        return self.box


class Seeded(Still):
    """Draws from its own seed."""

    def __init__(self, seed):
        super().__init__()
        self.generator = np.random.default_rng(seed)

    def update(self, image):
        self.box[:2] += self.generator.normal(size=2)
        return self.box


class Slow(Still):
    def odd(self):
        time.sleep(0.2)
        return self.box


class Leaves(Still):
    """Tells its process's number, and stays in an update for long."""

    def odd(self):
        Path(os.environ["TRICUE_TEST_PROCESSES"], str(os.getpid())).touch()
        time.sleep(1000)


def make(step=0.0):
    """A function in the place of a class."""
    return Still(step)


def mil():
    """A function that makes one of cv2's."""
    return cv2.TrackerMIL.create()


def make_nothing():
    """One that makes no tracker."""
    return 3
