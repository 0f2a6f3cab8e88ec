# SPDX-License-Identifier: MIT
"""Fixtures of the benchmarks: a frame and samples of typical size, made before any clock starts.

OpenCV runs on one thread, and the machine's limits are stored with the times.
"""

from collections.abc import Iterator
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray
from tricue import _core

from benchmarks.limits import machine


def pytest_configure(config: pytest.Config) -> None:
    """Register the marker with which a kernel's benchmark declares its work."""
    config.addinivalue_line("markers", "work(why=None, **amounts): what a kernel does, by limits/machine.py")


def pytest_benchmark_update_json(output_json: dict[str, Any]) -> None:
    """Measure the machine's limits in the same run as the kernels' times."""
    output_json["limits"] = machine.measure()


@pytest.fixture(autouse=True)
def declared_work(request: pytest.FixtureRequest) -> None:
    """Store a benchmark's work with its times; a native kernel's work must be declared."""
    if "benchmark" not in request.fixturenames:
        return
    benchmark, work = request.getfixturevalue("benchmark"), request.node.get_closest_marker("work")
    if work:
        benchmark.extra_info["work"] = work.kwargs
    elif (benchmark.group or "").partition(",")[0] in dir(_core) and str(benchmark.param).endswith("native"):
        pytest.fail("the benchmark of a kernel declares its work: @pytest.mark.work, limits/machine.py")


@pytest.fixture(autouse=True)
def one_thread() -> Iterator[None]:
    """Give OpenCV one thread during a benchmark."""
    threads = cv2.getNumThreads()
    cv2.setNumThreads(1)
    yield
    cv2.setNumThreads(threads)


@pytest.fixture(scope="session")
def frame() -> NDArray[np.uint8]:
    """320x240 of smooth colored noise; at a threshold of 0.4 a quarter of it is skin, in 33 blobs."""
    noise = np.random.default_rng(0).normal(128, 900, (240, 320, 3))
    return cv2.GaussianBlur(noise, (0, 0), 8).clip(0, 255).astype(np.uint8)


@pytest.fixture(scope="session")
def new_frames() -> list[NDArray[np.uint8]]:
    """64 frames of 640x480, 59 MB: used in turns, each has left the cache before it is used again."""
    rng = np.random.default_rng(0)
    return [rng.integers(0, 256, (480, 640, 3), np.uint8) for _ in range(64)]


@pytest.fixture(scope="session")
def color() -> NDArray[np.uint8]:
    """A reference color of skin."""
    return np.array([90, 120, 200], np.uint8)


@pytest.fixture(scope="session")
def samples() -> NDArray[np.uint8]:
    """251 samples of each of 100 ellipses."""
    return np.random.default_rng(1).normal(120, 40, (100, 3, 251)).clip(0, 255).astype(np.uint8)
