# SPDX-License-Identifier: MIT
import os

import numpy as np
import pytest
from tricue import Frame, Pose
from tricue.camera.shared_frame import SharedFrame
from tricue.track.multi.frame_memory import FrameMemory


@pytest.fixture
def ends():
    """The writing and the reading end of a memory."""
    memory = FrameMemory()
    yield memory, FrameMemory(os.dup(memory.file))
    memory.close()


def image(height: int, width: int, seed: int = 0):
    """Noise, BGR."""
    return np.random.default_rng(seed).integers(0, 256, (height, width, 3), np.uint8)


def same(frame, other) -> None:
    """All that a frame has is the other's."""
    assert (frame.channels, frame.timestamp, frame.pose) == (other.channels, other.timestamp, other.pose)
    for name in frame.channels:
        np.testing.assert_array_equal(getattr(frame, name), getattr(other, name))
        assert getattr(frame, name).dtype == getattr(other, name).dtype


def test_a_frame_is_read_as_it_was_written(ends):
    """Every channel, the time and the pose; of crops too, and in frames that become larger and smaller."""
    writer, reader = ends
    pose = Pose(np.eye(3), (1.0, 2.0, 3.0))
    depth = np.full((50, 70), 2.0, np.float32)
    depth[0] = np.nan
    frames = [
        Frame(image(50, 70), depth, image(50, 70, 1), timestamp=0.5, pose=pose),
        Frame(image(300, 400)[10:-10, 20:-30]),
        Frame(image(300, 400)[..., 0]),
        Frame(depth=depth, timestamp=1.0),
    ]
    for frame in frames:
        same(reader.read(writer.write(SharedFrame.of(frame))), frame)


def test_it_is_read_without_a_copy(ends):
    """The next frame is in its place, and what is read can't be written."""
    writer, reader = ends
    frame = reader.read(writer.write(SharedFrame.of(Frame(image(20, 30)))))
    assert not frame.color.flags.writeable
    writer.write(SharedFrame.of(Frame(image(20, 30, 1))))
    np.testing.assert_array_equal(frame.color, image(20, 30, 1))


def test_a_copy_stays(ends):
    """The next frame isn't in its place, and it may be written."""
    writer, reader = ends
    frame = reader.copy(writer.write(SharedFrame.of(Frame(image(20, 30), timestamp=2.0))))
    writer.write(SharedFrame.of(Frame(image(20, 30, 1))))
    same(frame, Frame(image(20, 30), timestamp=2.0))
    assert frame.color.flags.writeable
