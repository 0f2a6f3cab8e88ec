# SPDX-License-Identifier: MIT
import sys
import time
from datetime import timedelta
from types import ModuleType, SimpleNamespace
from typing import Any

import numpy as np
import pytest
import tricue
from numpy.typing import NDArray


class FakeImage:
    """An image of depthai."""

    def __init__(self, image: NDArray[Any]) -> None:
        self.image = image

    def getFrame(self) -> NDArray[Any]:  # noqa: N802 (as depthai names it)
        return self.image

    getCvFrame = getFrame  # noqa: N815


def fake_depthai(frames: int) -> tuple[ModuleType, list[str]]:
    """A module with what is used of depthai, and the links that were made."""
    module, links = ModuleType("depthai"), []

    class Port:
        def __init__(self, name: str) -> None:
            self.name = name

        def link(self, other: "Port") -> None:
            links.append(f"{self.name} -> {other.name}")

        def createOutputQueue(self, **_: object) -> Any:  # noqa: N802
            return Queue()

    class Queue:
        left = frames

        def get(self, _timeout: timedelta) -> dict[str, FakeImage]:
            time.sleep(0.005)
            self.left -= 1
            if self.left < 0:
                raise Gone("closed")
            shape = (400, 640)
            return {
                "color": FakeImage(np.full((*shape, 3), 7, np.uint8)),
                "depth": FakeImage(np.full(shape, 1500, np.uint16)),
            }

    class Gone(Exception):  # noqa: N818 (depthai's QueueException)
        pass

    class Node:
        def __init__(self, kind: str) -> None:
            self.kind, self.inputs = kind, {name: Port(f"{kind}.{name}") for name in ("color", "depth")}

        def build(self, socket: str) -> "Node":
            self.kind = socket
            return self

        def requestOutput(self, size: tuple[int, int], **_: object) -> Port:  # noqa: N802
            assert size == (640, 400)
            return Port(self.kind)

        def __getattr__(self, name: str) -> Port:
            return Port(f"{self.kind}.{name}")

    calibration = SimpleNamespace(
        getCameraIntrinsics=lambda _socket, width, height: [
            [500, 0, width / 2],
            [0, 501, height / 2],
            [0, 0, 1],
        ]
    )
    device = SimpleNamespace(getPlatform=lambda: "RVC2", readCalibration=lambda: calibration)
    pipeline = SimpleNamespace(create=Node, start=lambda: None, stop=lambda: None)
    module.Device = lambda *_: device  # type: ignore[attr-defined]
    module.DeviceInfo = str  # type: ignore[attr-defined]
    module.Pipeline = lambda _device: pipeline  # type: ignore[attr-defined]
    module.Platform = SimpleNamespace(RVC4="RVC4")  # type: ignore[attr-defined]
    module.CameraBoardSocket = SimpleNamespace(CAM_A="A", CAM_B="B", CAM_C="C")  # type: ignore[attr-defined]
    kinds = ("Camera", "StereoDepth", "Sync", "ImageAlign")
    module.node = SimpleNamespace(**{kind: kind for kind in kinds})  # type: ignore[attr-defined]
    module.MessageQueue = SimpleNamespace(QueueException=Gone)  # type: ignore[attr-defined]
    return module, links


def test_oak_without_stereo_cameras(monkeypatch: pytest.MonkeyPatch) -> None:
    """It proves, on a stand-in for depthai, that a camera with color alone is an error of one line."""
    module, _ = fake_depthai(frames=1)

    def create(kind: str) -> None:
        raise RuntimeError(f"no {kind} at CAM_B")

    pipeline = SimpleNamespace(create=create, stop=lambda: None)
    module.Pipeline = lambda _device: pipeline  # type: ignore[attr-defined]
    monkeypatch.setitem(sys.modules, "depthai", module)
    with pytest.raises(OSError, match="oak:: can't give color and depth"):
        tricue.open_source("oak:")


def test_oak(monkeypatch: pytest.MonkeyPatch) -> None:
    """It proves, on a stand-in for depthai, that color and registered depth come with the color camera."""
    module, links = fake_depthai(frames=10**6)
    monkeypatch.setitem(sys.modules, "depthai", module)
    source = tricue.open_source("oak:")
    frame = next(iter(source))
    assert frame.channels == ("color", "depth")
    assert frame.depth is not None
    assert frame.depth[0, 0] == pytest.approx(1.5)
    assert source.camera == tricue.Intrinsics(500, 501, 320, 200, 640, 400)
    assert set(links) == {
        "B -> StereoDepth.left",
        "C -> StereoDepth.right",
        "A -> StereoDepth.inputAlignTo",
        "A -> Sync.color",
        "StereoDepth.depth -> Sync.depth",
    }
