# SPDX-License-Identifier: MIT
"""Trackers by name: built in, from installed packages, or any class as ``module:Class``."""

import hashlib
import importlib
import inspect
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
    """The names that :func:`create` knows; it also takes ``module:Class``."""
    return *_BUILT_IN, *sorted(_installed_entry_points().keys() - _BUILT_IN.keys())


def tracker_class(name: str) -> Any:
    """The class of a name, imported on demand to keep ``import tricue`` fast.

    A third-party class that has only ``init(frame, box)`` and ``update(frame)`` is wrapped, see
    :func:`tricue.track.base.adapter.adapt_class`. ValueError for an unknown name.
    """
    return adapt_class(_import_class(_location(name)))


def traits(name: str) -> Traits:
    """The inputs and capabilities of the tracker of that name."""
    found: Traits = tracker_class(name).traits
    return found


def code_digest(name: str) -> str:
    """SHA-256 of the source file of a third party's class, which tells its versions apart; "" without one."""
    source = inspect.getsourcefile(_import_class(_location(name)))
    return "" if source is None else hashlib.sha256(Path(source).read_bytes()).hexdigest()


def create(name: str, **params: Any) -> Tracker:
    """A tracker by its name, such as ``create("color-particle", seed=0, particles=300)``.

    name: one of :func:`names`, or ``module:Class``. The keywords are those of the tracker's class.
    ValueError for an unknown name lists the known ones.
    """
    tracker: Tracker = tracker_class(name)(**params)
    return tracker


def _location(name: str) -> str:
    """The ``module:Class`` of a name; ValueError for an unknown one."""
    installed = _installed_entry_points()
    where = _BUILT_IN.get(name) or (installed[name].value if name in installed else name)
    if not isinstance(where, str) or ":" not in where:
        raise ValueError(
            f"name: expected one of {', '.join(map(repr, names()))} or module:Class, got {name!r}"
        )
    return where


@cache
def _installed_entry_points() -> dict[str, EntryPoint]:
    return {each.name: each for each in entry_points(group=GROUP)}


def _import_class(where: str) -> Any:
    """The class at "module:attribute"; ValueError if it doesn't exist or isn't a class."""
    module, _, attribute = where.partition(":")
    try:
        found = importlib.import_module(module)
        for part in attribute.split("."):
            found = getattr(found, part)
    except ModuleNotFoundError as error:
        if error.name is None or not f"{module}.".startswith(f"{error.name}."):
            raise  # of an import inside the module
        raise ValueError(f"{where}: there is no module {error.name}") from None
    except AttributeError:
        raise ValueError(f"{where}: the module {module} has no {attribute}") from None
    if not isinstance(found, type):
        raise ValueError(f"{where}: expected a class with init and update, got {type(found).__name__}")
    return found
