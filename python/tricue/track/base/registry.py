# SPDX-License-Identifier: MIT
"""Trackers by name: built in, from installed packages, or a class given as ``module:Class`` or
``file.py:Class``.
"""

import hashlib
import importlib
import importlib.util
import inspect
import sys
from functools import cache
from importlib.metadata import EntryPoint, entry_points
from pathlib import Path
from typing import Any

from tricue.track.base.adapter import adapt_class
from tricue.track.base.track import Tracker
from tricue.track.base.traits import Traits

GROUP = "tricue.trackers"
"""The group of entry points by which packages add trackers; tricue registers its own there, too."""

_BUILT_IN = {
    "color-particle": "tricue.track.color_particle.tracker:ColorParticleTracker",
    "depth-particle": "tricue.track.depth_particle.tracker:DepthParticleTracker",
    "flow-depth": "tricue.track.flow_depth.tracker:FlowDepthTracker",
    "fused": "tricue.track.fused.tracker:FusedTracker",
    "stereo-head": "tricue.track.stereo_head.tracker:StereoHeadTracker",
}


def names() -> tuple[str, ...]:
    """The names that :func:`create` takes, besides ``module:Class`` and ``path/to/file.py:Class``."""
    return *_BUILT_IN, *sorted(_installed_entry_points().keys() - _BUILT_IN.keys())


def is_built_in(name: str) -> bool:
    """Whether it is one of tricue's own trackers."""
    return name in _BUILT_IN


def tracker_class(name: str) -> Any:
    """The class of a name, imported on demand to keep ``import tricue`` fast.

    A third-party class that has only ``init(image, box)`` and ``update(image)`` is wrapped, see
    :func:`tricue.track.base.adapter.adapt_class`. ValueError for an unknown name.
    """
    return adapt_class(_import_class(location(name)))


def traits(name: str) -> Traits:
    """The inputs and capabilities of the tracker of that name."""
    found: Traits = tracker_class(name).traits
    return found


def code_digest(name: str) -> str:
    """SHA-256 of a third party's source files, which identifies its version; "" if there are none.

    The files are the class's own, and those imported from its package or from the same folder.
    """
    found = _import_class(location(name))
    source = inspect.getsourcefile(inspect.unwrap(found))
    if source is None:
        return ""
    own, package = Path(source).resolve(), found.__module__.partition(".")[0]
    paths = {own} | {
        path
        for each, module in [*sys.modules.items()]
        if (path := _python_file(module)) and (path.parent == own.parent or each.partition(".")[0] == package)
    }
    digest = hashlib.sha256()
    for path in sorted(paths):
        digest.update(path.name.encode() + path.read_bytes())
    return digest.hexdigest()


def create(name: str, **params: Any) -> Tracker:
    """A tracker by its name, such as ``create("color-particle", seed=0, particles=300)``.

    name: one of :func:`names`, ``module:Class`` or ``path/to/file.py:Class``. The keywords are those of the
    tracker's class. ValueError for an unknown name lists the known ones.
    """
    tracker: Tracker = tracker_class(name)(**params)
    return tracker


def location(name: str, argument: str = "name") -> str:
    """The ``module:Class`` or ``file.py:Class`` of a name.

    ValueError for an unknown name; ``argument`` is what the error calls it.
    """
    installed = _installed_entry_points()
    where = _BUILT_IN.get(name) or (installed[name].value if name in installed else name)
    if not isinstance(where, str) or ":" not in where:
        raise ValueError(
            f"{argument}: expected one of {', '.join(map(repr, names()))}, module:Class or file.py:Class, "
            f"got {name!r}"
        )
    return where


@cache
def _installed_entry_points() -> dict[str, EntryPoint]:
    return {each.name: each for each in entry_points(group=GROUP)}


def _import_class(where: str) -> Any:
    """The class, or the function that makes trackers, at "module:attribute" or "file.py:attribute".

    ValueError if it doesn't exist or is neither.
    """
    module, _, attribute = where.rpartition(":")
    if not module or (module.startswith(".") and not module.endswith(".py")):
        raise ValueError(f"{where}: expected module:Class or path/to/file.py:Class")
    try:
        found: Any = _import_file(Path(module)) if module.endswith(".py") else importlib.import_module(module)
        for part in attribute.split("."):
            found = getattr(found, part)
    except ModuleNotFoundError as error:
        if error.name is None or not f"{module}.".startswith(f"{error.name}."):
            raise  # from an import inside the module
        raise ValueError(f"{where}: there is no module {error.name}") from None
    except AttributeError:
        kind = "file" if module.endswith(".py") else "module"
        raise ValueError(f"{where}: the {kind} {module} has no {attribute}") from None
    if not callable(found):
        raise ValueError(f"{where}: expected a class with init and update, got {type(found).__name__}")
    return found


def _import_file(path: Path) -> Any:
    """The module in a file, imported once; it can import files in its folder. FileNotFoundError if there is
    no such file.
    """
    path = path.resolve()
    name = path.stem
    if _python_file(sys.modules.get(name)) == path:
        return sys.modules[name]
    if not path.is_file():
        raise FileNotFoundError(f"{path}: there is no such file")
    if str(path.parent) not in sys.path:
        sys.path.append(str(path.parent))
    if name in sys.modules:  # another module with this name, which must stay
        name = f"{name}_{hashlib.sha256(str(path).encode()).hexdigest()[:8]}"
        if name in sys.modules:
            return sys.modules[name]
    spec = importlib.util.spec_from_file_location(name, path)
    assert spec is not None
    assert spec.loader is not None
    module = sys.modules[name] = importlib.util.module_from_spec(spec)
    try:
        spec.loader.exec_module(module)
    except BaseException:
        del sys.modules[name]
        raise
    return module


def _python_file(module: Any) -> Path | None:
    """The source file of a module; None if it has none."""
    file = getattr(module, "__file__", None)
    return Path(file).resolve() if isinstance(file, str) and file.endswith(".py") else None
