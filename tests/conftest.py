# SPDX-License-Identifier: MIT
"""Fixtures that all tests share."""

import functools
import gc
import inspect
import os
import pickle
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import cv2
import hypothesis
import numpy as np
import pytest
from tricue import Box, Frame, Status, Track
from tricue.camera.box import BoxLike, as_box
from tricue.camera.frame import FrameLike, as_frame
from tricue.errors import BoxNeededError
from tricue.kernels import Kernels, load
from tricue.track.base import registry
from tricue.track.base.params import Params, parameter
from tricue.track.base.traits import Channels, Traits

ROOT = Path(__file__).parents[1]

# Sanitizers and busy machines are slow, and no reason to fail. "brief" is for the same tests on other builds.
hypothesis.settings.register_profile("patient", hypothesis.settings.default, deadline=None)
hypothesis.settings.register_profile("brief", hypothesis.settings.default, deadline=None, max_examples=20)
hypothesis.settings.load_profile("patient")


def pytest_collection_finish() -> None:
    """Keep the garbage collector off the collected tests: of 13,000 that saves 3 % of the time."""
    gc.collect()
    gc.freeze()


@pytest.fixture(params=os.environ.get("TRICUE_KERNELS", "native,reference").split(","), scope="session")
def kernels(request: pytest.FixtureRequest) -> Kernels:
    """Both sets of kernels, one after the other: what holds for one must hold for the other.

    TRICUE_KERNELS names them: the sanitizers have nothing to see in NumPy.
    """
    return load(request.param)


@pytest.fixture(scope="session")
def data() -> Path:
    """The folder of real sequences."""
    folder = Path(os.environ.get("TRICUE_DATA", ROOT.parent / "shared" / "data"))
    if not folder.is_dir():
        pytest.skip(f"no real sequences in {folder}; TRICUE_DATA names their folder")
    return folder


@pytest.fixture(scope="session")
def vot_venv() -> Path:
    """The environment with the VOT toolkit; TRICUE_VOT names another than make vot's."""
    folder = Path(os.environ.get("TRICUE_VOT", ROOT / "build" / "vot"))
    if not (folder / "bin" / "vot").is_file():
        pytest.skip(f"no VOT toolkit in {folder}; make vot installs it")
    return folder


@pytest.fixture(scope="session")
def rendered(tmp_path_factory: pytest.TempPathFactory) -> Callable[..., Any]:
    """``rendered(head, 0, kind="ramp")``: the scene, rendered once in a run of the tests and then read by all
    processes; nobody may write into it.
    """
    folder = tmp_path_factory.getbasetemp()
    if "PYTEST_XDIST_WORKER" in os.environ:
        folder = folder.parent  # which all workers share

    @functools.cache
    def make(scene: Callable[..., Any], arguments: tuple[tuple[str, Any], ...]) -> Any:
        path = folder / " ".join((scene.__name__, *(f"{name}={value}" for name, value in arguments)))
        if path.is_file():
            return pickle.loads(path.read_bytes())
        made = scene(**dict(arguments))
        part = path.with_name(f"{path.name} of {os.getpid()}")
        part.write_bytes(pickle.dumps(made))
        part.replace(path)
        return made

    def find(scene: Callable[..., Any], *arguments: Any, **keywords: Any) -> Any:
        bound = inspect.signature(scene).bind(*arguments, **keywords)
        bound.apply_defaults()
        return make(scene, tuple(bound.arguments.items()))

    return find


@dataclass(frozen=True, slots=True, kw_only=True)
class DriftParams(Params):
    step: float = parameter(1.0, unit="px", source="made up")


class Drift:
    """A tracker that moves its box ``step`` to the right a frame; black frames lose it, dim ones hide it."""

    Params = DriftParams
    traits = Traits(channels=(Channels.of("color"),))

    def __init__(self, seed: int = 0, kernels: str = "native", **params: float) -> None:
        self.params = DriftParams(**params)
        self.box = Box(0, 0, 1, 1)

    def init(self, frame: FrameLike, box: BoxLike | None = None) -> Track:
        if box is None:
            raise BoxNeededError("box: expected the target's box, got None")
        self.box = as_box(box)
        return self._track(frame)

    def update(self, frame: FrameLike) -> Track:
        self.box = self.box._replace(x=self.box.x + self.params.step)
        return self._track(frame)

    def _track(self, frame: FrameLike) -> Track:
        color = as_frame(frame).color
        assert color is not None
        score = float(color.mean()) / 255
        return Track(
            self.box, score, (Status.LOST, Status.OCCLUDED, Status.TRACKED)[(score > 0) + (score > 0.2)]
        )


@pytest.fixture
def drift() -> Drift:
    """A tracker that goes 2.5 px to the right a frame."""
    return Drift(step=2.5)


@pytest.fixture
def drift_tracker(monkeypatch: pytest.MonkeyPatch) -> str:
    """The name under which ``create`` now makes that tracker."""
    monkeypatch.setitem(registry._BUILT_IN, "drift", f"{Drift.__module__}:Drift")
    return "drift"


@pytest.fixture(scope="session")
def patrol():
    """A textured red square of 40 px that moves 2 px a frame over dim noise: 20 frames, true boxes."""
    rng = np.random.default_rng(1)
    ground = rng.integers(20, 60, (120, 160, 3), dtype=np.uint8)
    square = cv2.resize(rng.integers(90, 255, (6, 6, 3), dtype=np.uint8), (40, 40)) // [4, 4, 1]
    frames, boxes = [], []
    for index in range(20):
        image = ground.copy()
        x, y = 30 + 2 * index, 40
        image[y : y + 40, x : x + 40] = square
        frames.append(Frame(color=image))
        boxes.append(Box(float(x), float(y), 40.0, 40.0))
    return tuple(frames), tuple(boxes)


@pytest.fixture(scope="session")
def folders(patrol, tmp_path_factory):
    """A data set of three OTB sequences: the patrol, the patrol backward, its begin with a black gap."""
    root = tmp_path_factory.mktemp("sequences")
    frames, boxes = patrol
    dark = [Frame(color=np.zeros_like(frame.color)) for frame in frames]
    write_otb(root / "there", frames, boxes)
    write_otb(root / "back", frames[::-1], boxes[::-1])
    write_otb(root / "gap", (*frames[:6], *dark[6:10], *frames[10:14]), boxes[:14])
    return root


def write_otb(folder, frames, boxes):
    """A sequence as OTB lays it out: pixels counted from 1."""
    (folder / "img").mkdir(parents=True)
    for index, frame in enumerate(frames, 1):
        cv2.imwrite(str(folder / "img" / f"{index:04d}.png"), frame.color)
    lines = [f"{box.x + 1:g},{box.y + 1:g},{box.width:g},{box.height:g}\n" for box in boxes]
    (folder / "groundtruth_rect.txt").write_text("".join(lines))
