# SPDX-License-Identifier: MIT
"""What the examples run on: programs by name, and a rendered face as a video."""

import importlib.util
from collections.abc import Callable
from pathlib import Path
from types import ModuleType

import pytest
from tricue.draw import OverlayWriter
from tricue.scenes import Scene, face_over_clutter

EXAMPLES = Path(__file__).parents[2] / "examples"


@pytest.fixture
def program() -> Callable[[str], ModuleType]:
    """Loads a program of the folder as a module."""

    def load(name: str) -> ModuleType:
        spec = importlib.util.spec_from_file_location(name, EXAMPLES / f"{name}.py")
        assert spec is not None
        assert spec.loader is not None
        module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
        return module

    return load


@pytest.fixture(scope="session")
def face() -> Scene:
    """A face that moves over clutter."""
    return face_over_clutter(seed=0, frames=25)


@pytest.fixture(scope="session")
def face_video(face: Scene, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """That face as a video."""
    with OverlayWriter(tmp_path_factory.mktemp("face") / "face.avi", 30) as writer:
        for frame in face.frames:
            assert frame.color is not None
            writer.write(frame.color)
    return writer.path


@pytest.fixture(scope="session")
def face_box(face: Scene) -> str:
    """Where it starts, for the command line."""
    return ",".join(map(str, face.boxes[0]))
