# SPDX-License-Identifier: MIT
"""Fixtures that all tests share."""

import os
from dataclasses import dataclass
from pathlib import Path

import hypothesis
import pytest
from tricue import Box, Status, Track
from tricue.camera.box import BoxLike, as_box
from tricue.camera.frame import FrameLike, as_frame
from tricue.kernels import Kernels, load
from tricue.track import create
from tricue.track.params import Params, parameter

ROOT = Path(__file__).parents[1]

# Sanitizers and busy machines are slow, and no reason to fail.
hypothesis.settings.register_profile("patient", hypothesis.settings.default, deadline=None)
hypothesis.settings.load_profile("patient")


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


@dataclass(frozen=True, slots=True, kw_only=True)
class DriftParams(Params):
    step: float = parameter(1.0, unit="px", source="made up")


class Drift:
    """A tracker that moves its box ``step`` to the right a frame; black frames lose it, dim ones hide it."""

    Params = DriftParams

    def __init__(self, seed: int = 0, kernels: str = "native", **params: float) -> None:
        self.params = DriftParams(**params)
        self.box = Box(0, 0, 1, 1)

    def init(self, frame: FrameLike, box: BoxLike | None = None) -> Track:
        if box is None:
            raise ValueError("box: expected the target's box, got None")
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
    monkeypatch.setitem(create._TRACKERS, "drift", f"{Drift.__module__}:Drift")
    return "drift"
