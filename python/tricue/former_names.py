# SPDX-License-Identifier: MIT
"""The former names of modules, from version 0.1.0: they work for one release, with a DeprecationWarning."""

import importlib
import importlib.util
import sys
import warnings
from collections.abc import Callable, Mapping, Sequence
from importlib.abc import InspectLoader
from importlib.machinery import ModuleSpec
from types import CodeType, ModuleType
from typing import Any

MODULES = {
    "camera.box_table": "data.box_table",
    "camera.datasets": "data.datasets",
    "camera.depth_images": "data.depth_images",
    "camera.files": "data.files",
    "camera.calibration": "camera.calibration_formats",
    "camera.intrinsics_files": "camera.read_calibration",
    "camera.kitti": "data.kitti",
    "camera.layouts": "data.layouts",
    "camera.otb": "data.otb",
    "camera.prefetch": "data.prefetch",
    "camera.princeton": "data.princeton",
    "camera.source": "data.source",
    "camera.sources": "data.open_source",
    "camera.streams": "data.streams",
    "camera.summary": "data.summary",
    "camera.truth": "data.truth",
    "camera.tum": "data.tum",
    "camera.vot": "data.vot",
    "draw_flow_depth": "draw.masks",
    "draw_stereo": "draw.stereo",
    "evaluation.entrants": "evaluation.tracker_spec",
    "evaluation.paths": "draw.paths",
    "evaluation.peers": "evaluation.baselines",
    "scenes.everything": "scenes.stress.scene",
    "toml": "camera.toml",
    "toolkits": "evaluation.toolkits",
    "toolkits.got10k": "evaluation.toolkits.got10k",
    "toolkits.trax_server": "evaluation.toolkits.trax_server",
    "toolkits.vot_sequences": "evaluation.toolkits.vot_sequences",
    "toolkits.vot_workspace": "evaluation.toolkits.vot_workspace",
    "track.create": "track.base.registry",
    "track.faces": "track.head_detection.face_detection",
    "track.opencv": "track.base.opencv",
    "track.params": "track.base.params",
    "track.settings": "cli.settings",
    "track.track": "track.base.track",
    "trax": "cli.trax",
}
"""Former and present names, both without "tricue."."""


def attributes(module: str, names: Mapping[str, str]) -> Callable[[str], Any]:
    """The ``__getattr__`` of a module whose names changed; names: former and present ones."""

    def former_attribute(name: str) -> Any:
        if name not in names:
            raise AttributeError(f"module {module!r} has no attribute {name!r}")
        warnings.warn(
            f"{module}.{name} is deprecated: it is {names[name]} now", DeprecationWarning, stacklevel=2
        )
        return getattr(sys.modules[module], names[name])

    return former_attribute


class _Former:
    """Finds a module by its former name, and loads the present one."""

    def find_spec(
        self, name: str, path: Sequence[str] | None = None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        """The spec of a former name; None for any other."""
        former = name.removeprefix("tricue.")
        if former == name or former not in MODULES:
            return None
        return ModuleSpec(name, self)  # type: ignore[arg-type]  # typeshed wants more than is called

    def create_module(self, spec: ModuleSpec) -> ModuleType:
        """The present module."""
        present = _present(spec.name)
        warnings.warn(f"{spec.name} is deprecated: it is {present} now", DeprecationWarning, stacklevel=6)
        module = importlib.import_module(present)
        spec.loader_state = module.__spec__
        return module

    def exec_module(self, module: ModuleType) -> None:
        """It ran under its present name, which it keeps."""
        assert module.__spec__ is not None
        module.__spec__ = module.__spec__.loader_state

    def get_code(self, name: str) -> CodeType | None:
        """For ``python -m``."""
        present = _present(name)
        warnings.warn(f"{name} is deprecated: it is {present} now", DeprecationWarning, stacklevel=2)
        spec = importlib.util.find_spec(present)
        loader = None if spec is None else spec.loader
        assert isinstance(loader, InspectLoader)
        return loader.get_code(present)


def _present(name: str) -> str:
    return f"tricue.{MODULES[name.removeprefix('tricue.')]}"


def install() -> None:
    """Let the former names be imported."""
    if not any(isinstance(finder, _Former) for finder in sys.meta_path):
        sys.meta_path.insert(0, _Former())
